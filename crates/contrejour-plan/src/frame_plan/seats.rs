//! How many views are tested together.

use contrejour_layout::MAX_SEATS;

use super::size_buffers::{allowed, most_items};
use super::{BufferPlan, DeviceFacts, PlanInput, Seating};

/// What the lists of views that are tested together may take, all of them. Unit: bytes.
///
/// A face takes some 9 bytes for each view, 11 where casters have a thousand faces, so eight views are tested together in
/// scenes of up to some two million faces that cast. That is as far as the largest list, of 8 bytes a face, goes in what
/// WebGPU lets bind at least.
const MOST_BYTES: u64 = 192 << 20;

/// What lists may grow to is a multiple of so many records, so that no rounding to whole bindings makes it more.
const GRANULE: u64 = 256;

/// Seats for all views of a scene, at most eight: a power of two, as many as the lists have room for. Those that were made
/// are kept, also where less would do.
pub(super) fn seats(input: &PlanInput<'_>, buffers: &[BufferPlan]) -> u32 {
    let mut seats = wanted_seats(input);
    while seats > 1 && !have_room(buffers, seats, input.device) {
        seats /= 2;
    }
    seats
}

/// As many as there are views, or were.
pub(super) fn wanted_seats(input: &PlanInput<'_>) -> u32 {
    let made = input.made.iter().map(|made| made.seats).max().unwrap_or(1);
    let views = input.all_views.max(input.views.len()).clamp(1, MAX_SEATS as usize) as u32;
    views.next_power_of_two().max(made)
}

/// Records that one of these buffers may grow to, where all of them grow alike, without that there is room for fewer seats.
pub(super) fn most_items_with(seats: u32, buffers: &[BufferPlan], buffer: &BufferPlan, device: &DeviceFacts) -> u64 {
    let most = most_items(buffer.kind, device);
    if seats == 1 || buffer.kind.seating() == Seating::None {
        return most;
    }
    let share = buffer.items.saturating_mul(MOST_BYTES) / bytes_with(seats, buffers).max(1);
    let most = share.min(most / u64::from(seats));
    most - most % GRANULE
}

fn have_room(buffers: &[BufferPlan], seats: u32, device: &DeviceFacts) -> bool {
    bytes_with(seats, buffers) <= MOST_BYTES && seated(buffers, seats).all(|buffer| allowed(buffer, device).is_ok())
}

fn bytes_with(seats: u32, buffers: &[BufferPlan]) -> u64 {
    seated(buffers, seats).fold(0, |bytes, buffer| bytes.saturating_add(buffer.bytes))
}

/// Those that have seats, with so many.
fn seated(buffers: &[BufferPlan], seats: u32) -> impl Iterator<Item = BufferPlan> {
    let shared = buffers.iter().filter(|buffer| buffer.kind.seating() != Seating::None);
    shared.map(move |buffer| buffer.with_seats(seats))
}
