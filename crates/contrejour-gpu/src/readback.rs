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

/// A ring of small buffers that the counters are copied to and mapped by the submission that fills them.
#[derive(Debug)]
pub(crate) struct CounterReadback {
    slots: Vec<Slot>,
    next_frame: u64,
}

#[derive(Debug)]
struct Slot {
    buffer: wgpu::Buffer,
    /// Pages of all views that the buffer has room for.
    room: usize,
    state: Arc<AtomicU8>,
    /// Room that the counted frame had, view by view and page by page.
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

/// A frame whose counters are copied.
#[derive(Debug)]
pub(crate) struct Copying<'a> {
    slot: &'a mut Slot,
    offset: u64,
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

    /// Begins to copy the counters of a frame whose pages have this room, view by view, if a slot for so many is free.
    pub fn begin(&mut self, capacities: Vec<Capacity>) -> Option<Copying<'_>> {
        let has_room = |slot: &&mut Slot| slot.is_free() && slot.room >= capacities.len();
        let slot = self.slots.iter_mut().find(has_room)?;
        slot.capacities = capacities;
        slot.frame = self.next_frame;
        self.next_frame += 1;
        Some(Copying { slot, offset: 0 })
    }

    /// Takes what has arrived, oldest frame first; of each frame the pages of its views.
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

impl Copying<'_> {
    /// Records the copies of a view's counters, page by page.
    pub fn copy<'a>(&mut self, encoder: &mut wgpu::CommandEncoder, counters: impl Iterator<Item = &'a wgpu::Buffer>) {
        for page in counters {
            encoder.copy_buffer_to_buffer(page, 0, &self.slot.buffer, self.offset, PAGE_BYTES);
            self.offset += PAGE_BYTES;
        }
    }

    /// Sends them back.
    pub fn finish(self, encoder: &mut wgpu::CommandEncoder) {
        self.slot.state.store(UNDER_WAY, Ordering::Release);
        let ticket = Ticket(Arc::clone(&self.slot.state));
        encoder.map_buffer_on_submit(&self.slot.buffer, wgpu::MapMode::Read, .., move |result| {
            if result.is_ok() {
                ticket.0.store(MAPPED, Ordering::Release);
            }
        });
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
