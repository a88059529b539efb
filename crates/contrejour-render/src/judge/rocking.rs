//! Lights that are never still.

use contrejour_plan::{Light, LightKind};
use glam::DVec3;

/// How far a rocked light moves, relative to its distance from its target, 2^-18: some 32 steps of an `f32`, so that the
/// device's records change, and a small part of a texel of any map.
const HAIR: f64 = 1.0 / 262_144.0;

/// The light itself in even frames, and in odd ones the light moved sideways by a hair: by 2^-18 of its distance from its
/// target, by 2^-18 of its farthest depth where it has no target, or turned by 2^-18 radians.
///
/// Shadows that are asked for the same light again have nothing to do. Frames of a rocked light do all the work of a
/// light that moves, and all do the same, so they are what a run time is measured with.
pub fn rocked(light: &Light, frame: usize) -> Light {
    let mut rocked = *light;
    if frame.is_multiple_of(2) {
        return rocked;
    }
    match &mut rocked.kind {
        LightKind::Spot { position, target, .. } => *position += sideways(*position - *target),
        LightKind::Point { position, far, .. } => position.x += HAIR * *far,
        LightKind::Directional { towards_light, .. } | LightKind::Cascaded { towards_light, .. } => {
            *towards_light += sideways(*towards_light);
        }
    }
    rocked
}

/// A hair's part of the vector, at a right angle to it.
fn sideways(vector: DVec3) -> DVec3 {
    // Its square may not fit.
    let largest = vector.abs().max_element();
    let scaled = vector / largest;
    // What has no direction is no light, and is told so where it is used.
    let unit = scaled.try_normalize();
    unit.map_or(DVec3::ZERO, |unit| HAIR * largest * scaled.length() * unit.any_orthonormal_vector())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spot(position: DVec3) -> Light {
        let kind = LightKind::Spot { position, target: DVec3::ZERO, cone_angle: 1.0, radius: 0.1, near: 0.1, far: 9.0 };
        Light { kind, color: [1.0; 3] }
    }

    fn lamp(position: DVec3) -> Light {
        Light { kind: LightKind::Point { position, radius: 0.1, near: 0.1, far: 9.0 }, color: [1.0; 3] }
    }

    fn sun(towards_light: DVec3) -> Light {
        let kind = LightKind::Directional {
            towards_light,
            center: DVec3::ZERO,
            half_extent: 1.0,
            half_depth: 1.0,
            angular_radius: 0.005,
        };
        Light { kind, color: [1.0; 3] }
    }

    #[test]
    fn odd_frames_have_other_records_and_even_ones_the_same() {
        let record =
            |light: &Light| contrejour_plan::views(light).expect("a good light")[0].receiver_view(&Default::default());
        for direction in [DVec3::X, DVec3::Y, -DVec3::Z, DVec3::new(0.3, 5.0, -2.0), DVec3::splat(1e-200)] {
            let position = 4.0 * direction.normalize_or(DVec3::ONE);
            for light in [spot(position), lamp(position), sun(direction)] {
                assert_eq!(rocked(&light, 0), light);
                assert_eq!(rocked(&light, 6), light);
                assert_ne!(record(&rocked(&light, 1)).light_world, record(&light).light_world, "{light:?}");
                assert_eq!(rocked(&light, 7), rocked(&light, 1));
            }
        }
    }

    #[test]
    fn a_light_without_a_direction_stays_as_it_is() {
        for light in [spot(DVec3::ZERO), sun(DVec3::ZERO)] {
            assert_eq!(rocked(&light, 1), light);
        }
    }
}
