//! Which casters a view can see.

use glam::{DMat4, DVec3, DVec4};

use super::{CastersInFront, View};

/// Room for rounding of the depth, in NDC: `f32` matrices are off by less.
const DEPTH_GUARD_NDC: f64 = 1e-5;

/// A box around a mesh in its object space, and where the mesh stands.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ObjectBox {
    /// Smallest corner, object space.
    pub min: [f32; 3],
    /// Largest corner, object space.
    pub max: [f32; 3],
    /// World space from object space.
    pub world_from_object: DMat4,
}

impl View {
    /// Whether any of the box may be in the view's frustum, each side of which is moved outwards by `guard_ndc` (the
    /// smoothie width and filter texels). Conservative: a box near a frustum's edge counts as seen.
    pub fn can_see(&self, bounds: &ObjectBox, guard_ndc: f64) -> bool {
        let clip_from_object = self.light_clip_from_world * bounds.world_from_object;
        let corners = core::array::from_fn::<DVec4, 8, _>(|corner| {
            let pick =
                |axis: usize| f64::from(if corner >> axis & 1 == 0 { bounds.min[axis] } else { bounds.max[axis] });
            clip_from_object * DVec3::new(pick(0), pick(1), pick(2)).extend(1.0)
        });
        let front = match self.casters_in_front {
            CastersInFront::Clipped => DVec4::new(0.0, 0.0, 1.0, DEPTH_GUARD_NDC),
            // Beyond no plane at all.
            CastersInFront::Pancaked => DVec4::W,
        };
        // What is beyond a plane is linear in clip space, so corners decide for the box, also behind the light.
        let side = 1.0 + guard_ndc;
        let planes = [
            DVec4::new(1.0, 0.0, 0.0, side),
            DVec4::new(-1.0, 0.0, 0.0, side),
            DVec4::new(0.0, 1.0, 0.0, side),
            DVec4::new(0.0, -1.0, 0.0, side),
            front,
            DVec4::new(0.0, 0.0, -1.0, 1.0 + DEPTH_GUARD_NDC),
        ];
        !planes.into_iter().any(|plane| corners.into_iter().all(|corner| plane.dot(corner) < 0.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Light, LightKind, views};

    fn cube_at(center: DVec3) -> ObjectBox {
        let world_from_object = DMat4::from_translation(center);
        ObjectBox { min: [-0.5; 3], max: [0.5; 3], world_from_object }
    }

    /// Looks along -z from the origin with sides of 45 degrees.
    fn spot() -> View {
        let kind = LightKind::Spot {
            position: DVec3::ZERO,
            target: DVec3::NEG_Z,
            cone_angle: core::f64::consts::FRAC_PI_2,
            radius: 0.1,
            near: 1.0,
            far: 10.0,
        };
        views(&Light { kind, color: [1.0; 3] }).expect("a good spot")[0]
    }

    #[test]
    fn boxes_inside_and_across_are_seen() {
        for center in [[0.0, 0.0, -5.0], [5.4, 0.0, -5.0], [0.0, 0.0, -0.6], [0.0, 0.0, -10.4], [4.0, -4.0, -5.0]] {
            assert!(spot().can_see(&cube_at(DVec3::from_array(center)), 0.0), "{center:?}");
        }
        let around = ObjectBox { min: [-100.0; 3], max: [100.0; 3], world_from_object: DMat4::IDENTITY };
        assert!(spot().can_see(&around, 0.0), "a box with the light inside");
    }

    #[test]
    fn boxes_beyond_a_side_are_not_seen() {
        for center in
            [[7.0, 0.0, -5.0], [-7.0, 0.0, -5.0], [0.0, 7.0, -5.0], [0.0, 0.0, -11.0], [0.0, 0.0, 0.0], [0.0, 0.0, 5.0]]
        {
            assert!(!spot().can_see(&cube_at(DVec3::from_array(center)), 0.0), "{center:?}");
        }
    }

    #[test]
    fn the_guard_widens_the_sides() {
        // The nearest corner is at x / depth = 6.5 / 5.5.
        let bounds = cube_at(DVec3::new(7.0, 0.0, -5.0));
        assert!(!spot().can_see(&bounds, 0.18));
        assert!(spot().can_see(&bounds, 0.19));
    }

    #[test]
    fn suns_have_boxes() {
        let kind = LightKind::Directional {
            towards_light: DVec3::Y,
            center: DVec3::ZERO,
            half_extent: 3.0,
            half_depth: 2.0,
            angular_radius: 0.0,
        };
        let view = views(&Light { kind, color: [1.0; 3] }).expect("a good sun")[0];
        assert!(view.can_see(&cube_at(DVec3::new(3.2, 0.0, 0.0)), 0.0));
        assert!(!view.can_see(&cube_at(DVec3::new(3.6, 0.0, 0.0)), 0.0));
        assert!(!view.can_see(&cube_at(DVec3::new(0.0, 2.6, 0.0)), 0.0));
        assert!(!view.can_see(&cube_at(DVec3::new(0.0, -2.6, 0.0)), 0.0));
    }
}
