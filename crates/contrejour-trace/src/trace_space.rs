//! Where rays are traced.

use glam::DVec3;

/// Half the side of the cube that holds all faces. The tree's boxes and rays are in `f32`: at this size their rounding
/// stays below [`BOX_MARGIN`].
pub(crate) const HALF_SIDE: f64 = 1024.0;

/// The faces' boxes are larger by at least this on each side, so that no box that holds a hit is missed. A ray enters
/// the cube at most 3548 from where it leaves it. Over that way the box test is off by less than 0.0015: 3e-4 for the
/// rounding of origin and corners (2^-24 of 2048 each), 8e-4 for that of differences, inverse and products, 4e-4 for
/// obvhs' least direction component (2^-23).
pub(crate) const BOX_MARGIN: f64 = 1.0 / 256.0;

/// The world, moved so that the middle of all faces is the origin, and scaled by a power of two so that the cube of
/// half side [`HALF_SIDE`] just holds them. So coordinates from 1e-3 to 1e6 meet the same arithmetic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct TraceSpace {
    middle_world: DVec3,
    scale: f64,
    /// Largest coordinate of a face, in the world or here, in units of this space: rounding is relative to it.
    pub largest_coordinate: f64,
}

impl TraceSpace {
    /// Around all points.
    pub fn around(points_world: impl Iterator<Item = DVec3> + Clone) -> Self {
        let Some(first) = points_world.clone().next() else {
            return Self { middle_world: DVec3::ZERO, scale: 1.0, largest_coordinate: 0.0 };
        };
        let (low, high) = points_world.fold((first, first), |(low, high), point| (low.min(point), high.max(point)));
        // Halved first, so that nothing overflows.
        let middle_world = high / 2.0 + low / 2.0;
        let half = (high / 2.0 - low / 2.0).max_element();
        let scale = if half > 0.0 { (HALF_SIDE / half).log2().floor().clamp(-900.0, 900.0).exp2() } else { 1.0 };
        let largest_world = low.abs().max(high.abs()).max_element();
        Self { middle_world, scale, largest_coordinate: largest_world.max(half) * scale }
    }

    /// A point of the world, here.
    pub fn point_from_world(&self, point_world: DVec3) -> DVec3 {
        (point_world - self.middle_world) * self.scale
    }

    /// An offset of the world, here.
    pub fn vector_from_world(&self, vector_world: DVec3) -> DVec3 {
        vector_world * self.scale
    }

    /// A length of the world, here.
    pub fn length_from_world(&self, length_world: f64) -> f64 {
        length_world * self.scale
    }

    /// A length of this space, in the world.
    pub fn world_from_length(&self, length: f64) -> f64 {
        length / self.scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_sizes_fill_the_cube() {
        for size in [1e-30, 1e-3, 1.0, 1e6, 1e30] {
            for offset in [0.0, 1e3] {
                let points = [DVec3::splat(-size), DVec3::new(size, 0.0, 0.5 * size)].map(|p| p + offset * size);
                let space = TraceSpace::around(points.into_iter());
                let half = points.map(|point| space.point_from_world(point).abs().max_element());
                assert!(half.iter().all(|half| (HALF_SIDE / 2.0..=HALF_SIDE).contains(half)), "{size}: {half:?}");
            }
        }
    }

    #[test]
    fn one_point_and_none_are_spaces_too() {
        assert_eq!(TraceSpace::around([DVec3::ONE].into_iter()).point_from_world(DVec3::ONE), DVec3::ZERO);
        assert_eq!(TraceSpace::around([].into_iter()).point_from_world(DVec3::ONE), DVec3::ONE);
    }
}
