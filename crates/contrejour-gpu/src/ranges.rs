//! Where things lie in a pool: what stays keeps its place, what goes leaves a hole, what comes fills a hole.

use std::collections::{BTreeMap, BTreeSet};

/// The places of a pool, in records or words. What comes gets the smallest hole that holds it, the first among equals, else
/// it lies behind all others. Holes that touch are one.
#[derive(Clone, Debug, Default)]
pub(crate) struct Ranges {
    end: u64,
    /// Length of each hole, by where it begins. None is empty, touches another or ends the pool.
    holes: BTreeMap<u64, u64>,
    /// Length and beginning of each.
    by_length: BTreeSet<(u64, u64)>,
}

impl Ranges {
    /// Takes a place of this length; returns where it begins.
    pub fn take(&mut self, length: u64) -> u64 {
        let Some(&(hole, start)) = self.by_length.range((length, 0)..).next() else {
            self.end += length;
            return self.end - length;
        };
        if length > 0 {
            self.remove_hole(start);
            self.add_hole(start + length, hole - length);
        }
        start
    }

    /// Where the last place would end with one more of this length.
    pub fn end_with(&self, length: u64) -> u64 {
        let fills_a_hole = self.by_length.range((length, 0)..).next().is_some();
        if fills_a_hole { self.end } else { self.end.saturating_add(length) }
    }

    /// Gives a place back.
    pub fn give_back(&mut self, start: u64, length: u64) {
        if length == 0 {
            return;
        }
        let before = self.holes.range(..start).next_back().map(|(&start, &length)| (start, length));
        let before = before.filter(|(first, length)| first + length == start);
        let (mut first, mut end) = (start, start + length);
        if let Some((hole, _)) = before {
            self.remove_hole(hole);
            first = hole;
        }
        if let Some(behind) = self.holes.get(&end).copied() {
            self.remove_hole(end);
            end += behind;
        }
        if end == self.end {
            self.end = first;
        } else {
            self.add_hole(first, end - first);
        }
    }

    /// Where the last place ends.
    pub fn end(&self) -> u64 {
        self.end
    }

    /// What is free before that.
    pub fn free(&self) -> u64 {
        self.holes.values().sum()
    }

    /// What is taken.
    pub fn used(&self) -> u64 {
        self.end - self.free()
    }

    fn add_hole(&mut self, start: u64, length: u64) {
        if length > 0 {
            self.holes.insert(start, length);
            self.by_length.insert((length, start));
        }
    }

    fn remove_hole(&mut self, start: u64) {
        if let Some(length) = self.holes.remove(&start) {
            self.by_length.remove(&(length, start));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_comes_first_lies_side_by_side() {
        let mut ranges = Ranges::default();
        assert_eq!([3, 0, 5, 1].map(|length| ranges.take(length)), [0, 3, 3, 8]);
        assert_eq!((ranges.end(), ranges.free()), (9, 0));
    }

    #[test]
    fn the_hole_that_fits_best_is_filled() {
        let mut ranges = Ranges::default();
        let starts = [6, 1, 3, 1, 4, 1, 3, 1].map(|length| ranges.take(length));
        for (start, length) in [(starts[0], 6), (starts[2], 3), (starts[4], 4), (starts[6], 3)] {
            ranges.give_back(start, length);
        }
        assert_eq!([3, 4, 2, 2].map(|length| ranges.take(length)), [starts[2], starts[4], starts[6], starts[0]]);
        assert_eq!((ranges.end(), ranges.free()), (20, 1 + 4));
    }

    #[test]
    fn holes_that_touch_are_one_and_the_last_one_is_none() {
        let mut ranges = Ranges::default();
        let [a, b, c, d] = [2, 3, 4, 5].map(|length| ranges.take(length));
        ranges.give_back(a, 2);
        ranges.give_back(c, 4);
        assert_eq!(ranges.holes.len(), 2);
        ranges.give_back(b, 3);
        assert_eq!((ranges.holes.len(), ranges.free()), (1, 9));
        ranges.give_back(d, 5);
        assert_eq!((ranges.end(), ranges.free(), ranges.by_length.len()), (0, 0, 0));
    }

    /// Against a pool of which each record says whose it is.
    #[test]
    fn no_place_is_two_things_at_once() {
        let mut seed = 1_u64;
        let mut random = |below: u64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (seed >> 33) % below
        };
        let mut ranges = Ranges::default();
        let mut owners: Vec<Option<u64>> = Vec::new();
        let mut things: Vec<(u64, u64, u64)> = Vec::new();
        let (mut live, mut most_live, mut longest) = (0, 0, 0);
        for id in 0..20_000 {
            if things.len() < 40 || things.len() < 200 && random(2) == 0 {
                let length = if random(8) == 0 { random(300) } else { random(12) };
                let start = ranges.take(length);
                owners.resize(owners.len().max((start + length) as usize), None);
                for owner in &mut owners[start as usize..(start + length) as usize] {
                    assert_eq!(owner.replace(id), None, "it was free");
                }
                things.push((id, start, length));
                live += length;
            } else {
                let (id, start, length) = things.swap_remove(random(things.len() as u64) as usize);
                for owner in &mut owners[start as usize..(start + length) as usize] {
                    assert_eq!(owner.take(), Some(id), "it kept its place");
                }
                ranges.give_back(start, length);
                live -= length;
            }
            assert_eq!(ranges.end() - ranges.free(), live);
            assert_eq!(
                owners.iter().rposition(|owner| owner.is_some()).map_or(0, |last| last as u64 + 1),
                ranges.end()
            );
            (most_live, longest) = (live.max(most_live), longest.max(ranges.end()));
        }
        assert!(longest * 2 < most_live * 3, "{longest} for {most_live}");
    }
}
