//! Counters on their way back to the CPU, without a wait.

use std::sync::{
    Arc,
    atomic::{AtomicU8, Ordering},
};

use contrejour_layout::Counters;
use contrejour_plan::Capacity;

/// Frames whose counters can be under way at once; a frame that finds no free slot sends none back.
const SLOTS: usize = 3;

const BYTES: u64 = size_of::<Counters>() as u64;

/// Bytes of all slots.
pub(crate) const READBACK_BYTES: u64 = SLOTS as u64 * BYTES;

/// A ring of small buffers that the counters are copied to and mapped by the submission that fills them.
#[derive(Debug)]
pub(crate) struct CounterReadback {
    slots: Vec<Slot>,
    next_frame: u64,
}

#[derive(Debug)]
struct Slot {
    buffer: wgpu::Buffer,
    state: Arc<AtomicU8>,
    /// Room that the counted frame had.
    capacity: Capacity,
    /// The counted frame's place among all.
    frame: u64,
}

const FREE: u8 = 0;
const UNDER_WAY: u8 = 1;
const MAPPED: u8 = 2;

/// Frees its slot unless the mapping succeeds, also when the caller drops the encoder without submitting it.
struct Ticket(Arc<AtomicU8>);

impl Drop for Ticket {
    fn drop(&mut self) {
        let _ = self.0.compare_exchange(UNDER_WAY, FREE, Ordering::AcqRel, Ordering::Acquire);
    }
}

/// Counters of a frame, and the room that it had.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CountedFrame {
    pub counters: Counters,
    pub capacity: Capacity,
}

impl CounterReadback {
    pub fn new(device: &wgpu::Device) -> Self {
        let slot = || Slot {
            buffer: device.create_buffer(&wgpu::BufferDescriptor {
                label: Some("contrejour counters readback"),
                size: BYTES,
                usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
                mapped_at_creation: false,
            }),
            state: Arc::new(AtomicU8::new(FREE)),
            capacity: Capacity::default(),
            frame: 0,
        };
        Self { slots: (0..SLOTS).map(|_| slot()).collect(), next_frame: 0 }
    }

    /// Records the copy of a frame's counters, if a slot is free.
    pub fn copy(&mut self, encoder: &mut wgpu::CommandEncoder, counters: &wgpu::Buffer, capacity: Capacity) {
        let free = self.slots.iter_mut().find(|slot| slot.state.load(Ordering::Acquire) == FREE);
        let Some(slot) = free else { return };
        slot.capacity = capacity;
        slot.frame = self.next_frame;
        self.next_frame += 1;
        slot.state.store(UNDER_WAY, Ordering::Release);
        let ticket = Ticket(Arc::clone(&slot.state));
        encoder.copy_buffer_to_buffer(counters, 0, &slot.buffer, 0, BYTES);
        encoder.map_buffer_on_submit(&slot.buffer, wgpu::MapMode::Read, .., move |result| {
            if result.is_ok() {
                ticket.0.store(MAPPED, Ordering::Release);
            }
        });
    }

    /// Takes what has arrived, oldest frame first.
    pub fn arrived(&mut self) -> Vec<CountedFrame> {
        self.slots.sort_by_key(|slot| slot.frame);
        let mut frames = Vec::new();
        for slot in self.slots.iter().filter(|slot| slot.state.load(Ordering::Acquire) == MAPPED) {
            if let Ok(view) = slot.buffer.slice(..).get_mapped_range() {
                let counters = bytemuck::pod_read_unaligned(&view);
                frames.push(CountedFrame { counters, capacity: slot.capacity });
            }
            slot.buffer.unmap();
            slot.state.store(FREE, Ordering::Release);
        }
        frames
    }

    /// Whether counters of an encoded frame are still under way.
    pub fn is_pending(&self) -> bool {
        self.slots.iter().any(|slot| slot.state.load(Ordering::Acquire) == UNDER_WAY)
    }
}
