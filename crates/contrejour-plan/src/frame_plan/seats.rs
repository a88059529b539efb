//! How many views are tested together.

use contrejour_layout::MAX_SEATS;

use super::size_buffers::allowed;
use super::{BufferPlan, DeviceFacts, PlanInput, Seating};

/// What the lists of views that are tested together may take, all of them. Unit: bytes.
///
/// A face with its edges takes some 33 bytes for each view, so eight views are tested together in scenes of up to some
/// 300 thousand faces that cast, and one view alone in those of more than a million, which costs what it must.
const MOST_BYTES: u64 = 80 << 20;

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

fn have_room(buffers: &[BufferPlan], seats: u32, device: &DeviceFacts) -> bool {
    let seated = || {
        let shared = buffers.iter().filter(|buffer| buffer.kind.seating() != Seating::None);
        shared.map(|buffer| buffer.with_seats(seats))
    };
    let bytes = seated().fold(0, |bytes: u64, buffer| bytes.saturating_add(buffer.bytes));
    bytes <= MOST_BYTES && seated().all(|buffer| allowed(buffer, device).is_ok())
}
