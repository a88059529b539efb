//! The picture of a mask: alpha alone.

use super::levels::{MaskLevel, mask_level_sizes};
use crate::{TextureFilter, TextureWrap};

/// Alpha of a picture, and how it is looked up.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MaskImage {
    size: [u32; 2],
    alphas: Vec<u8>,
    wrap: [TextureWrap; 2],
    filter: TextureFilter,
}

/// Why a picture is none.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("a mask of {width} x {height} texels with {alphas} alphas: give 1 to {most} texels each way, and each one alpha", most = MaskImage::MAX_SIDE)]
pub struct MaskImageError {
    /// Texels from left to right.
    pub width: u32,
    /// Texels from top to bottom.
    pub height: u32,
    /// How many alphas there are.
    pub alphas: usize,
}

impl MaskImage {
    /// Most texels along a side: as many as a texture of WebGPU's defaults has.
    pub const MAX_SIDE: u32 = 8192;

    /// A picture of so many texels from left to right and from top to bottom, rows from the top; 255 is opaque.
    ///
    /// # Errors
    ///
    /// [`MaskImageError`] when there is no texel, there are too many along a side, or not one alpha for each.
    pub fn new(
        size: [u32; 2],
        alphas: Vec<u8>,
        wrap: [TextureWrap; 2],
        filter: TextureFilter,
    ) -> Result<Self, MaskImageError> {
        let [width, height] = size;
        let is_allowed = size.iter().all(|side| (1..=Self::MAX_SIDE).contains(side));
        if !is_allowed || alphas.len() as u64 != u64::from(width) * u64::from(height) {
            return Err(MaskImageError { width, height, alphas: alphas.len() });
        }
        Ok(Self { size, alphas, wrap, filter })
    }

    /// One opaque texel: for masks that are alpha of vertices alone.
    pub fn opaque() -> Self {
        Self { size: [1, 1], alphas: vec![255], wrap: Default::default(), filter: TextureFilter::Nearest }
    }

    /// Texels from left to right and from top to bottom.
    pub const fn size(&self) -> [u32; 2] {
        self.size
    }

    /// What is beyond its edges: left and right, above and below.
    pub const fn wrap(&self) -> [TextureWrap; 2] {
        self.wrap
    }

    /// What is between its texels.
    pub const fn filter(&self) -> TextureFilter {
        self.filter
    }

    /// How many levels it has: itself and [smaller ones](mask_level_sizes).
    pub fn level_count(&self) -> u32 {
        mask_level_sizes(self.size).count() as u32
    }

    /// Bytes of all levels together, each from a multiple of 4 on.
    pub fn level_bytes(&self) -> u64 {
        mask_level_sizes(self.size).map(|[width, height]| u64::from(width * height).next_multiple_of(4)).sum()
    }

    /// The picture and its smaller levels, of which a cutoff leaves as large a share as of itself.
    pub(super) fn levels(&self, cutoff: f32) -> Vec<MaskLevel> {
        MaskLevel { size: self.size, alphas: self.alphas.clone() }.with_smaller(cutoff)
    }

    /// Alpha at a point of the first level, from 0 to 1.
    pub(super) fn alpha_at(&self, coordinates: [f64; 2]) -> f64 {
        let mut places = [0.0; 2];
        for axis in 0..2 {
            let wrapped = match self.wrap[axis] {
                TextureWrap::Repeat => coordinates[axis] - coordinates[axis].floor(),
                TextureWrap::Mirror => {
                    let pair = coordinates[axis] - 2.0 * (0.5 * coordinates[axis]).floor();
                    pair.min(2.0 - pair)
                }
                TextureWrap::Clamp => coordinates[axis].clamp(0.0, 1.0),
            };
            places[axis] = wrapped * f64::from(self.size[axis]);
        }
        if self.filter == TextureFilter::Nearest {
            return self.texel(places.map(|place| place as i64));
        }
        let [x, y] = places.map(|place| place - 0.5);
        let [left, top] = [x.floor(), y.floor()];
        let row = |down: i64| {
            let [at_left, at_right] = [0, 1].map(|across| self.texel([left as i64 + across, top as i64 + down]));
            at_left + (x - left) * (at_right - at_left)
        };
        row(0) + (y - top) * (row(1) - row(0))
    }

    /// A texel at most one beyond the edges.
    fn texel(&self, place: [i64; 2]) -> f64 {
        let mut inside = [0; 2];
        for axis in 0..2 {
            let side = i64::from(self.size[axis]);
            inside[axis] = match self.wrap[axis] {
                TextureWrap::Repeat => place[axis].rem_euclid(side),
                TextureWrap::Mirror | TextureWrap::Clamp => place[axis].clamp(0, side - 1),
            };
        }
        let [x, y] = inside;
        f64::from(self.alphas[(y * i64::from(self.size[0]) + x) as usize]) / 255.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn two(wrap: TextureWrap, filter: TextureFilter) -> MaskImage {
        MaskImage::new([2, 1], vec![0, 255], [wrap; 2], filter).expect("it is good")
    }

    #[test]
    fn texels_beyond_the_edges_are_as_the_wrap_says() {
        let at = |wrap, u| two(wrap, TextureFilter::Nearest).alpha_at([u, 0.5]);
        use TextureWrap::{Clamp, Mirror, Repeat};
        let found = [Repeat, Mirror, Clamp].map(|wrap| [-0.25, 0.25, 0.75, 1.25, 1.75].map(|u| at(wrap, u)));
        assert_eq!(found[0], [1.0, 0.0, 1.0, 0.0, 1.0]);
        assert_eq!(found[1], [0.0, 0.0, 1.0, 1.0, 0.0]);
        assert_eq!(found[2], [0.0, 0.0, 1.0, 1.0, 1.0]);
    }

    #[test]
    fn texels_are_weighed() {
        let at = |wrap, u| two(wrap, TextureFilter::Linear).alpha_at([u, 0.5]);
        assert_eq!([0.25, 0.375, 0.5, 0.75].map(|u| at(TextureWrap::Clamp, u)), [0.0, 0.25, 0.5, 1.0]);
        // Over the edge half of the neighbour comes in.
        assert_eq!(at(TextureWrap::Repeat, 0.0), 0.5);
        assert_eq!(at(TextureWrap::Mirror, 0.0), 0.0);
    }

    #[test]
    fn smaller_levels_keep_what_the_cutoff_leaves() {
        // Leaves: a fifth of the texels, scattered.
        let alphas: Vec<u8> = (0..64 * 48_u32).map(|texel| if texel * 7 % 5 == 0 { 230 } else { 0 }).collect();
        let image = MaskImage::new([64, 48], alphas, Default::default(), TextureFilter::Linear).expect("it is good");
        let levels = image.levels(0.5);
        assert_eq!(levels.iter().map(|level| level.size).collect::<Vec<_>>(), [[64, 48], [32, 24], [16, 12]]);
        assert_eq!(levels.len() as u32, image.level_count());
        let bytes: usize = levels.iter().map(|level| level.alphas.len().next_multiple_of(4)).sum();
        assert_eq!(bytes as u64, image.level_bytes());
        let share = levels[0].share_kept(0.5);
        for level in &levels {
            let found = level.share_kept(0.5);
            assert!((found - share).abs() < 0.1, "{:?}: {found}, not {share}", level.size);
        }
    }

    #[test]
    fn pictures_without_texels_or_with_too_many_are_refused() {
        for (size, count) in [([0, 1], 0), ([8193, 1], 8193), ([2, 2], 3)] {
            let refused = MaskImage::new(size, vec![0; count], Default::default(), TextureFilter::Linear);
            let told = refused.expect_err("it must be refused").to_string();
            assert!(told.contains(&format!("{} x {}", size[0], size[1])), "{told}");
        }
    }
}
