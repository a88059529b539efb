//! How the eye's view is cut into slices, and the sphere around each.

use glam::DVec3;

use super::Eye;

/// Depths at which the eye's view from `near` to `far` is cut into `count` slices: `count + 1` depths, the first `near`
/// and the last `far`. World units.
///
/// The practical split scheme, C_i = l n (f / n)^(i / m) + (1 - l) (n + (f - n) i / m) (Zhang, Sun, Xu and Lun 2006,
/// "Parallel-split shadow maps for large-scale virtual environments"): l is `logarithmic_share`, 0 to 1.
pub fn split_depths(near: f64, far: f64, count: u32, logarithmic_share: f64) -> Vec<f64> {
    let depth = |i: u32| {
        let share = f64::from(i) / f64::from(count);
        let logarithmic = near * (far / near).powf(share);
        let even = near + (far - near) * share;
        logarithmic_share * logarithmic + (1.0 - logarithmic_share) * even
    };
    let between = (1..count).map(depth);
    core::iter::once(near).chain(between).chain(core::iter::once(far)).collect()
}

/// A sphere in world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Sphere {
    pub center_world: DVec3,
    pub radius: f64,
}

impl Sphere {
    /// The smallest sphere around what an eye sees between two depths. Its radius depends on nothing but these and the
    /// eye's opening, so it stays the same to the bit wherever the eye is and looks.
    pub fn around_slice(eye: &Eye, [begin, end]: [f64; 2]) -> Self {
        let squared = eye.half_diagonal() * eye.half_diagonal();
        // As far from the corners at the begin as from those at the end; a wide slice has its middle at the end.
        let depth = (0.5 * (begin + end) * (1.0 + squared)).min(end);
        let radius = (end - depth).hypot(end * eye.half_diagonal());
        Self { center_world: eye.position + depth * eye.axis_world(), radius }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn splits_follow_the_scheme() {
        let close = |found: &[f64], expected: &[f64]| {
            assert_eq!(found.len(), expected.len());
            assert!(found.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-9), "{found:?} {expected:?}");
        };
        close(&split_depths(1.0, 81.0, 4, 0.0), &[1.0, 21.0, 41.0, 61.0, 81.0]);
        close(&split_depths(1.0, 81.0, 4, 1.0), &[1.0, 3.0, 9.0, 27.0, 81.0]);
        close(&split_depths(1.0, 81.0, 4, 0.5), &[1.0, 12.0, 25.0, 44.0, 81.0]);
        assert_eq!(split_depths(0.3, 70.0, 1, 0.7), [0.3, 70.0]);
        let eight = split_depths(0.1, 1000.0, 8, 0.75);
        assert!(eight.is_sorted_by(|a, b| a < b) && eight[0] == 0.1 && eight[8] == 1000.0, "{eight:?}");
    }

    #[test]
    fn spheres_just_hold_their_slices() {
        for (fov_y, aspect) in [(0.1, 1.0), (0.8, 1.8), (1.6, 0.5), (2.8, 2.0)] {
            let eye = Eye { position: DVec3::X, forward: DVec3::NEG_Z, fov_y, aspect, near: 0.1, far: 100.0 };
            for [begin, end] in [[0.1, 1.0], [1.0, 30.0], [30.0, 31.0]] {
                let sphere = Sphere::around_slice(&eye, [begin, end]);
                let farthest = [begin, end]
                    .map(|depth| {
                        let y = (0.5 * fov_y).tan() * depth;
                        sphere.center_world.distance(DVec3::new(1.0 + aspect * y, y, -depth))
                    })
                    .into_iter()
                    .fold(0.0, f64::max);
                assert!((farthest / sphere.radius - 1.0).abs() < 1e-12, "{farthest} {sphere:?}");
            }
        }
    }
}
