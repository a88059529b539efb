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

impl MaskLevel {
    /// The share of its area that a cutoff leaves where texels are interpolated: four points a texel are asked.
    pub fn share_kept(&self, cutoff: f32) -> f64 {
        self.share_kept_of(cutoff, |alpha| alpha)
    }

    /// Scales its alphas so that a cutoff leaves as near this share of its area as it can.
    pub fn keep_coverage(&mut self, cutoff: f32, share: f64) {
        let off_by = |exponent: f32| self.share_kept_of(cutoff, |alpha| scaled(alpha, exponent)) - share;
        // More is left by a larger scale.
        let (mut low, mut high) = (-8.0, 8.0);
        for _ in 0..12 {
            let middle = 0.5 * (low + high);
            if off_by(middle) < 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        // Where all of it or nothing is left by any scale, its own does.
        let best = [0.0, low, high].into_iter().min_by(|a, b| off_by(*a).abs().total_cmp(&off_by(*b).abs()));
        let exponent = best.unwrap_or_default();
        self.alphas.iter_mut().for_each(|alpha| *alpha = scaled(*alpha, exponent));
    }

    fn share_kept_of(&self, cutoff: f32, change: impl Fn(u8) -> u8) -> f64 {
        let changed: Vec<u32> = (0..=255).map(|alpha| change(alpha).into()).collect();
        // A point a quarter of a texel off its middle has 9, 3, 3 and 1 sixteenths of the four texels about it.
        let least = f64::from(cutoff) * 255.0 * 16.0;
        let [width, height] = self.size.map(|side| side as usize);
        let texel = |x: usize, y: usize| changed[usize::from(self.alphas[y * width + x])];
        let kept_in_row = |y: usize| {
            let rows = [y.saturating_sub(1), (y + 1).min(height - 1)];
            let kept_at = |x: usize| {
                let columns = [x.saturating_sub(1), (x + 1).min(width - 1)];
                let own = 9 * texel(x, y);
                let points = rows.into_iter().flat_map(|row| columns.map(|column| (row, column)));
                let alphas =
                    points.map(|(row, column)| own + 3 * (texel(column, y) + texel(x, row)) + texel(column, row));
                alphas.filter(|alpha| f64::from(*alpha) >= least).count()
            };
            (0..width).map(kept_at).sum::<usize>()
        };
        (0..height).into_par_iter().map(kept_in_row).sum::<usize>() as f64 / (4 * width * height) as f64
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
