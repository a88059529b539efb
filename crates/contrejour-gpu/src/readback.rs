//! Counters of all lights on their way back to the CPU, without a wait.

use std::sync::{
    Arc,
    atomic::{AtomicU8, Ordering},
};

use contrejour_layout::Counters;
use contrejour_plan::Capacity;

use crate::slots::Key;

/// Frames whose counters can be under way at once; a frame that finds no free slot sends none back.
const SLOTS: usize = 4;

/// Bytes of one page's counters.
const PAGE_BYTES: u64 = size_of::<Counters>() as u64;

/// A ring of small buffers that the counters are copied to and mapped by the submission that fills them: one mapping a
/// frame, however many lights it has.
#[derive(Debug)]
pub(crate) struct CounterReadback {
    slots: Vec<Slot>,
    next_frame: u64,
    /// Where a frame's counters lie when they are taken; kept, so that no frame allocates.
    counted: Vec<CountedPage>,
}

#[derive(Debug)]
struct Slot {
    buffer: wgpu::Buffer,
    /// Pages that the buffer has room for.
    room: usize,
    state: Arc<AtomicU8>,
    /// What is counted, in the order of the copies.
    pages: Vec<Page>,
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

/// A page of a light's view, and the room that it had.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Page {
    pub light: Key,
    pub capacity: Capacity,
}

/// A frame whose counters are copied.
#[derive(Debug)]
pub(crate) struct Copying<'a> {
    slot: &'a mut Slot,
}

/// What a page counted.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CountedPage {
    pub page: Page,
    pub counters: Counters,
}

impl CountedPage {
    /// Whether the page had room for everything.
    pub fn is_complete(&self) -> bool {
        self.page.capacity.holds(&self.counters)
    }
}

impl CounterReadback {
    pub fn new(device: &wgpu::Device) -> Self {
        let slot = || Slot {
            buffer: buffer_for(device, 1),
            room: 1,
            state: Arc::new(AtomicU8::new(FREE)),
            pages: Vec::new(),
            frame: 0,
        };
        Self { slots: (0..SLOTS).map(|_| slot()).collect(), next_frame: 0, counted: Vec::new() }
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

    /// Begins to copy the counters of a frame of so many pages, if a slot for so many is free.
    pub fn begin(&mut self, page_count: usize) -> Option<Copying<'_>> {
        let has_room = |slot: &&mut Slot| slot.is_free() && slot.room >= page_count;
        let slot = self.slots.iter_mut().find(has_room)?;
        slot.pages.clear();
        slot.frame = self.next_frame;
        self.next_frame += 1;
        Some(Copying { slot })
    }

    /// Takes what has arrived, oldest frame first; of each frame the pages in the order of their copies.
    pub fn take_arrived(&mut self, mut take: impl FnMut(&[CountedPage])) {
        self.slots.sort_unstable_by_key(|slot| slot.frame);
        for slot in self.slots.iter().filter(|slot| slot.state.load(Ordering::Acquire) == MAPPED) {
            self.counted.clear();
            if let Ok(view) = slot.buffer.slice(..).get_mapped_range() {
                let counters = view.chunks_exact(PAGE_BYTES as usize).map(bytemuck::pod_read_unaligned);
                let pages = slot.pages.iter().zip(counters);
                self.counted.extend(pages.map(|(&page, counters)| CountedPage { page, counters }));
            }
            slot.buffer.unmap();
            slot.state.store(FREE, Ordering::Release);
            take(&self.counted);
        }
    }

    /// Whether counters of an encoded frame are still under way.
    pub fn is_pending(&self) -> bool {
        self.slots.iter().any(|slot| slot.state.load(Ordering::Acquire) == UNDER_WAY)
    }
}

impl Copying<'_> {
    /// Records the copy of a page's counters.
    pub fn copy(&mut self, encoder: &mut wgpu::CommandEncoder, counters: wgpu::BufferSlice<'_>, page: Page) {
        let offset = self.slot.pages.len() as u64 * PAGE_BYTES;
        encoder.copy_buffer_to_buffer(counters.buffer(), counters.offset(), &self.slot.buffer, offset, PAGE_BYTES);
        self.slot.pages.push(page);
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
