//! Smaller levels of pictures, and how much of them a cutoff leaves.

use rayon::prelude::*;

/// A picture of alpha: a mask, or one of its smaller levels.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MaskLevel {
    /// Texels from left to right and from top to bottom.
    pub size: [u32; 2],
    /// Rows from the top.
    pub alphas: Vec<u8>,
}

/// Fewer texels than these are all left by a cutoff, or none of them, too often: no level has fewer but a picture itself.
const LEAST_TEXELS: u32 = 64;

/// The size of a mask and those of its smaller levels, each half of the one before.
pub fn mask_level_sizes(size: [u32; 2]) -> impl Iterator<Item = [u32; 2]> {
    let smaller = |size: &[u32; 2]| {
        let half = size.map(|side| (side / 2).max(1));
        (half != *size && half[0] * half[1] >= LEAST_TEXELS).then_some(half)
    };
    std::iter::successors(Some(size), smaller)
}

/// How far from what was asked for a level's share may be, where its alphas are means.
const MEANS_OFF_BY: f64 = 0.05;

impl MaskLevel {
    /// This picture and its smaller levels, of [these sizes](mask_level_sizes). Of each level a cutoff leaves as large a share
    /// of the area as of the first.
    ///
    /// Alphas are means that are scaled until it does (Castaño 2010, "Computing Alpha Mipmaps"): means alone would let leaves
    /// vanish with distance. Where no scale does it, as where the means of a lattice are all alike, each texel has the alpha
    /// of one that it covers, whichever chance takes; the choice is the same in every run.
    pub fn with_smaller(self, cutoff: f32) -> Vec<Self> {
        let share = self.share_kept(cutoff);
        let mut means: Vec<f32> = self.alphas.iter().map(|alpha| f32::from(*alpha)).collect();
        let mut size = self.size;
        let mut levels = vec![self];
        for next in mask_level_sizes(size).skip(1) {
            let [columns, rows] = size.map(halved);
            let mean = |row: &[(u32, f32)], column: &[(u32, f32)]| {
                let mut sum = 0.0;
                for &(y, high) in row {
                    for &(x, wide) in column {
                        sum += high * wide * means[(y * size[0] + x) as usize];
                    }
                }
                sum
            };
            let row_of = |row: &Vec<(u32, f32)>| columns.iter().map(|column| mean(row, column)).collect::<Vec<_>>();
            means = rows.par_iter().flat_map_iter(row_of).collect();
            size = next;
            let mut level = Self { size, alphas: means.iter().map(|mean| mean.round() as u8).collect() };
            level.keep_coverage(cutoff, share);
            if (level.share_kept(cutoff) - share).abs() > MEANS_OFF_BY {
                level.alphas = levels[0].chosen_by_chance(size);
                level.keep_coverage(cutoff, share);
            }
            levels.push(level);
        }
        levels
    }

    /// The share of its area that a cutoff leaves where texels are interpolated: four points a texel are asked.
    pub fn share_kept(&self, cutoff: f32) -> f64 {
        self.share_kept_of(cutoff, |alpha| alpha)
    }

    /// Scales its alphas so that a cutoff leaves as near this share of its area as it can.
    fn keep_coverage(&mut self, cutoff: f32, share: f64) {
        let off_by = |exponent: f32| self.share_kept_of(cutoff, |alpha| scaled(alpha, exponent)) - share;
        let mut best = (0.0, off_by(0.0));
        // More is left by a larger scale.
        let (mut low, mut high) = (-8.0, 8.0);
        for _ in 0..12 {
            let middle = 0.5 * (low + high);
            let off = off_by(middle);
            if off < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
            if off.abs() < best.1.abs() {
                best = (middle, off);
            }
        }
        self.alphas.iter_mut().for_each(|alpha| *alpha = scaled(*alpha, best.0));
    }

    fn share_kept_of(&self, cutoff: f32, change: impl Fn(u8) -> u8) -> f64 {
        let changed: Vec<u32> = (0..=255).map(|alpha| change(alpha).into()).collect();
        // A point a quarter of a texel off its middle has 9, 3, 3 and 1 sixteenths of the four texels about it.
        let least = (f64::from(cutoff) * 255.0 * 16.0).ceil().clamp(0.0, f64::from(u32::MAX)) as u32;
        let [width, height] = self.size.map(|side| side as usize);
        let row = |y: usize| &self.alphas[y * width..(y + 1) * width];
        let kept_in_row = |y: usize| {
            let (above, own, below) = (row(y.saturating_sub(1)), row(y), row((y + 1).min(height - 1)));
            let mut kept = 0;
            for x in 0..width {
                let [left, right] = [x.saturating_sub(1), (x + 1).min(width - 1)];
                let at = |row: &[u8], x: usize| changed[usize::from(row[x])];
                let middle = 9 * at(own, x);
                for beside in [above, below] {
                    let vertical = middle + 3 * at(beside, x);
                    kept += u64::from(vertical + 3 * at(own, left) + at(beside, left) >= least);
                    kept += u64::from(vertical + 3 * at(own, right) + at(beside, right) >= least);
                }
            }
            kept
        };
        (0..height).into_par_iter().map(kept_in_row).sum::<u64>() as f64 / (4 * width * height) as f64
    }

    /// For each texel of a smaller level, the alpha of one that it covers.
    fn chosen_by_chance(&self, size: [u32; 2]) -> Vec<u8> {
        let texel = |index: u32| {
            let place = [index % size[0], index / size[0]];
            let mut chance = (index ^ (size[0] << 16)).wrapping_mul(0x9e37_79b9);
            let chosen = [0, 1].map(|axis| {
                chance = (chance ^ (chance >> 15)).wrapping_mul(0x85eb_ca6b);
                chance ^= chance >> 13;
                let [side, of_level] = [self.size[axis], size[axis]].map(u64::from);
                let [start, end] = [0, 1].map(|step| (u64::from(place[axis]) + step) * side / of_level);
                start + u64::from(chance) % (end - start).max(1)
            });
            self.alphas[(chosen[1] * u64::from(self.size[0]) + chosen[0]) as usize]
        };
        (0..size[0] * size[1]).map(texel).collect()
    }
}

/// An alpha times a power of two.
fn scaled(alpha: u8, exponent: f32) -> u8 {
    (f32::from(alpha) * exponent.exp2()).round().min(255.0) as u8
}

/// For each of half as many texels along a side, at least one, those that it covers and how much of it each of them is.
pub fn halved(texels: u32) -> Vec<Vec<(u32, f32)>> {
    let halved = (texels / 2).max(1);
    let length = f64::from(texels) / f64::from(halved);
    let of_texel = |index: u32| {
        let (start, end) = (f64::from(index) * length, f64::from(index + 1) * length);
        let covered = |texel: u32| f64::from(texel + 1).min(end) - f64::from(texel).max(start);
        let texels = start as u32..(end.ceil() as u32).min(texels);
        texels.map(|texel| (texel, (covered(texel) / length) as f32)).collect()
    };
    (0..halved).map(of_texel).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ramp, so that every share is left by some cutoff.
    fn ramp() -> MaskLevel {
        MaskLevel { size: [16, 16], alphas: (0..=255).map(|texel: u8| texel / 2).collect() }
    }

    #[test]
    fn the_share_that_is_asked_for_stays() {
        for share in [0.1, 0.25, 0.5, 0.9] {
            for cutoff in [0.1, 0.5, 0.9] {
                let mut level = ramp();
                level.keep_coverage(cutoff, share);
                let found = level.share_kept(cutoff);
                assert!((found - share).abs() < 0.04, "{share} at {cutoff}: {found}");
            }
        }
    }

    #[test]
    fn what_any_scale_leaves_stays_as_it_is() {
        for (cutoff, share) in [(0.0, 1.0), (0.0, 0.5), (1.5, 0.0), (f32::INFINITY, 0.0)] {
            let mut level = ramp();
            level.keep_coverage(cutoff, share);
            assert_eq!(level, ramp(), "{cutoff}");
        }
    }

    #[test]
    fn levels_of_lattices_and_of_odd_sizes_keep_what_the_first_leaves() {
        let picture = |size: [u32; 2], is_there: &dyn Fn(u32, u32) -> bool| {
            let alphas =
                (0..size[0] * size[1]).map(|texel| if is_there(texel % size[0], texel / size[0]) { 255 } else { 0 });
            MaskLevel { size, alphas: alphas.collect() }
        };
        let lattices = [
            ("fence", picture([64, 64], &|x, _| x % 4 == 0)),
            ("fine fence", picture([128, 64], &|x, _| x % 2 == 0)),
            ("chequers", picture([64, 64], &|x, y| (x + y) % 2 == 0)),
            ("leaf", picture([97, 61], &|x, y| (x / 7 + y / 5) % 3 == 0)),
        ];
        for (name, first) in lattices {
            let share = first.share_kept(0.5);
            assert!((0.1..0.7).contains(&share), "{name}: {share}");
            for level in first.with_smaller(0.5) {
                let found = level.share_kept(0.5);
                assert!((found - share).abs() < 0.12, "{name}, {:?}: {found}, not {share}", level.size);
            }
        }
    }

    #[test]
    fn levels_end_before_they_have_a_handful_of_texels() {
        let sizes = |size| mask_level_sizes(size).collect::<Vec<_>>();
        assert_eq!(sizes([32, 16]), [[32, 16], [16, 8]]);
        assert_eq!(sizes([200, 1]), [[200, 1], [100, 1]]);
        assert_eq!(sizes([7, 9]), [[7, 9]]);
        assert_eq!(sizes([1, 1]), [[1, 1]]);
    }

    #[test]
    fn half_of_a_step_is_left() {
        let level = MaskLevel { size: [4, 2], alphas: vec![0, 0, 255, 255, 0, 0, 255, 255] };
        assert_eq!(level.share_kept(0.5), 0.5);
        // Beside the step a quarter of the neighbour comes in.
        assert_eq!(level.share_kept(0.75), 0.5);
        assert_eq!(level.share_kept(0.76), 0.375);
        assert_eq!(level.share_kept(0.25), 0.625);
    }

    #[test]
    fn odd_sides_are_shared_out() {
        assert_eq!(halved(1), [vec![(0, 1.0)]]);
        assert_eq!(halved(4), [vec![(0, 0.5), (1, 0.5)], vec![(2, 0.5), (3, 0.5)]]);
        let three = halved(3);
        assert_eq!(three.len(), 1);
        assert!(three[0].iter().all(|(_, share)| (share - 1.0 / 3.0).abs() < 1e-6));
    }
}
