//! Counters on their way back to the CPU, without a wait.

use std::sync::{
    Arc,
    atomic::{AtomicU8, Ordering},
};

use contrejour_layout::Counters;
use contrejour_plan::Capacity;

/// Frames whose counters can be under way at once; a frame that finds no free slot sends none back.
const SLOTS: usize = 3;

/// Bytes of one page's counters.
const PAGE_BYTES: u64 = size_of::<Counters>() as u64;

/// Bytes of all slots with room for one page.
pub(crate) const READBACK_BYTES: u64 = SLOTS as u64 * PAGE_BYTES;

/// A ring of small buffers that the counters are copied to and mapped by the submission that fills them.
#[derive(Debug)]
pub(crate) struct CounterReadback {
    slots: Vec<Slot>,
    next_frame: u64,
}

#[derive(Debug)]
struct Slot {
    buffer: wgpu::Buffer,
    /// Pages that the buffer has room for.
    room: usize,
    state: Arc<AtomicU8>,
    /// Room that the counted frame had, page by page.
    capacities: Vec<Capacity>,
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

/// Counters of a page, and the room that it had.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CountedPage {
    pub counters: Counters,
    pub capacity: Capacity,
}

impl CounterReadback {
    pub fn new(device: &wgpu::Device) -> Self {
        let slot = || Slot {
            buffer: buffer_for(device, 1),
            room: 1,
            state: Arc::new(AtomicU8::new(FREE)),
            capacities: Vec::new(),
            frame: 0,
        };
        Self { slots: (0..SLOTS).map(|_| slot()).collect(), next_frame: 0 }
    }

    /// Gives the free slots room for so many pages.
    pub fn make_room(&mut self, device: &wgpu::Device, page_count: usize) {
        for slot in self.slots.iter_mut().filter(|slot| slot.is_free() && slot.room < page_count) {
            slot.buffer = buffer_for(device, page_count);
            slot.room = page_count;
        }
    }

    /// Lets the free slots be made anew, where it is not known whether they were made well.
    pub fn drop_room(&mut self) {
        for slot in self.slots.iter_mut().filter(|slot| slot.is_free()) {
            slot.room = 0;
        }
    }

    /// Records the copy of a frame's counters, page by page, if a slot with room for them is free.
    pub fn copy<'a>(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        counters: impl Iterator<Item = &'a wgpu::Buffer>,
        capacities: Vec<Capacity>,
    ) {
        let has_room = |slot: &&mut Slot| slot.is_free() && slot.room >= capacities.len();
        let Some(slot) = self.slots.iter_mut().find(has_room) else { return };
        slot.capacities = capacities;
        slot.frame = self.next_frame;
        self.next_frame += 1;
        slot.state.store(UNDER_WAY, Ordering::Release);
        let ticket = Ticket(Arc::clone(&slot.state));
        for (page, offset) in counters.zip((0..).step_by(PAGE_BYTES as usize)) {
            encoder.copy_buffer_to_buffer(page, 0, &slot.buffer, offset, PAGE_BYTES);
        }
        encoder.map_buffer_on_submit(&slot.buffer, wgpu::MapMode::Read, .., move |result| {
            if result.is_ok() {
                ticket.0.store(MAPPED, Ordering::Release);
            }
        });
    }

    /// Takes what has arrived, oldest frame first; of each frame its pages.
    pub fn arrived(&mut self) -> Vec<Vec<CountedPage>> {
        self.slots.sort_by_key(|slot| slot.frame);
        let mut frames = Vec::new();
        for slot in self.slots.iter().filter(|slot| slot.state.load(Ordering::Acquire) == MAPPED) {
            if let Ok(view) = slot.buffer.slice(..).get_mapped_range() {
                let counters = view.chunks_exact(PAGE_BYTES as usize).map(bytemuck::pod_read_unaligned);
                let pages = counters.zip(&slot.capacities);
                frames.push(pages.map(|(counters, &capacity)| CountedPage { counters, capacity }).collect());
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

impl Slot {
    fn is_free(&self) -> bool {
        self.state.load(Ordering::Acquire) == FREE
    }
}

fn buffer_for(device: &wgpu::Device, page_count: usize) -> wgpu::Buffer {
    device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("contrejour counters readback"),
        size: page_count as u64 * PAGE_BYTES,
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    })
}
