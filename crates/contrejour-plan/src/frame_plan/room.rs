//! Room that buffers keep and gain while a scene changes.

use super::BufferPlan;

/// A buffer for what is needed, where earlier frames made some: one with room for it stays as it is, also where a smaller
/// one would do, since what shrank mostly grows again.
pub(super) fn kept(needed: BufferPlan, made: &[BufferPlan]) -> BufferPlan {
    BufferPlan::new(needed.kind, needed.page, needed.items.max(items_made(&needed, made)))
}

/// The same, where one without room grows to half more than is needed, but not beyond `most`, so that where things come one
/// by one it grows seldom. What was not made, or holds nothing, is as large as needed; so is one that has room for what the
/// scene is `expected` to need: a frame counted more, and that is no reason to expect still more.
pub(super) fn with_room(needed: BufferPlan, expected: u64, made: &[BufferPlan], most: u64) -> BufferPlan {
    let BufferPlan { kind, page, items, .. } = needed;
    let had = items_made(&needed, made);
    if had == 0 || items <= had || expected <= had {
        return kept(needed, made);
    }
    BufferPlan::new(kind, page, (items + items / 2).min(most).max(items))
}

fn items_made(needed: &BufferPlan, made: &[BufferPlan]) -> u64 {
    let is_it = |made: &&BufferPlan| (made.kind, made.page) == (needed.kind, needed.page);
    made.iter().find(is_it).map_or(0, |made| made.items)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BufferKind;

    fn grown(needed: u64, had: Option<u64>) -> u64 {
        let plan = |items| BufferPlan::new(BufferKind::Lit, 0, items);
        let made: Vec<_> = had.map(plan).into_iter().collect();
        with_room(plan(needed), needed, &made, 1000).items
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
        let items = |needed, expected| with_room(plan(needed), expected, &[plan(600)], u64::MAX).items;
        assert_eq!((items(750, 600), items(750, 601)), (750, 1125));
    }

    #[test]
    fn what_fits_is_kept() {
        assert_eq!((grown(601, Some(901)), grown(0, Some(901))), (901, 901));
    }
}
