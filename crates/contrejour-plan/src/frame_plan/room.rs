//! Room that buffers keep and gain while a scene changes.

use super::size_buffers::most_items;
use super::{BufferPlan, DeviceFacts};

/// A buffer for what is needed, where earlier frames made some: one with room for it stays as it is, also where a smaller
/// one would do, since what shrank mostly grows again. One without grows to half more than is needed, as far as the device
/// allows, so that where things come one by one it grows seldom. What was not made, or holds nothing, is as large as needed;
/// so is one that has room for what the scene is `expected` to need: a frame counted more, and that is no reason to expect
/// still more.
pub(super) fn with_room(needed: BufferPlan, expected: u64, made: &[BufferPlan], device: &DeviceFacts) -> BufferPlan {
    let BufferPlan { kind, page, items, .. } = needed;
    let had = made.iter().find(|made| (made.kind, made.page) == (kind, page)).map_or(0, |made| made.items);
    let grown = match had {
        0 => items,
        _ if items <= had => had,
        _ if expected <= had => items,
        _ => (items + items / 2).min(most_items(kind, device)).max(items),
    };
    BufferPlan::new(kind, page, grown)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BufferKind;

    fn grown(needed: u64, had: Option<u64>) -> u64 {
        let plan = |items| BufferPlan::new(BufferKind::Lit, 0, items);
        let made: Vec<_> = had.map(plan).into_iter().collect();
        let device = DeviceFacts { max_storage_buffer_binding_size: 4000, ..DeviceFacts::default() };
        with_room(plan(needed), needed, &made, &device).items
    }

    #[test]
    fn what_comes_first_fits_exactly() {
        assert_eq!((grown(700, None), grown(700, Some(0)), grown(700, Some(700))), (700, 700, 700));
    }

    #[test]
    fn what_does_not_fit_grows_by_half_and_as_far_as_it_may() {
        assert_eq!((grown(601, Some(600)), grown(701, Some(700)), grown(1200, Some(1))), (901, 1000, 1200));
    }

    #[test]
    fn what_was_counted_fits_exactly() {
        let plan = |items| BufferPlan::new(BufferKind::Quads, 0, items);
        let items = |needed, expected| with_room(plan(needed), expected, &[plan(600)], &DeviceFacts::default()).items;
        assert_eq!((items(750, 600), items(750, 601)), (750, 1125));
    }

    #[test]
    fn what_fits_is_kept() {
        assert_eq!((grown(601, Some(901)), grown(0, Some(901))), (901, 901));
    }
}
