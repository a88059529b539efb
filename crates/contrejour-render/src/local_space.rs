//! The world, moved and scaled so that what the camera looks at lies near 1.

use contrejour_plan::{Light, LightKind};
use contrejour_scene::Camera;
use glam::{DMat4, DVec3};

/// World space moved so that the camera's target is its origin, and scaled by a power of two that brings the distance
/// from eye to target near 1.
///
/// Everything that goes to the device is in this space, so that scenes of any size and far from the origin lose
/// nothing in `f32`. Angles, smoothie widths in NDC and biases in texels do not change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LocalSpace {
    origin_world: DVec3,
    local_per_world: f64,
}

impl LocalSpace {
    /// The space around what a camera looks at.
    pub fn around(camera: &Camera) -> Self {
        let distance = camera.eye.distance(camera.target);
        let exponent = -distance.log2().round();
        let local_per_world = if exponent.is_finite() { exponent.exp2() } else { 1.0 };
        Self { origin_world: camera.target, local_per_world }
    }

    /// Local space from world space.
    pub fn local_from_world(&self) -> DMat4 {
        DMat4::from_scale(DVec3::splat(self.local_per_world)) * DMat4::from_translation(-self.origin_world)
    }

    /// A point of the world in local space.
    pub fn point(&self, point_world: DVec3) -> DVec3 {
        self.local_per_world * (point_world - self.origin_world)
    }

    /// A point of local space in the world.
    pub fn point_world(&self, point: DVec3) -> DVec3 {
        point / self.local_per_world + self.origin_world
    }

    /// A length of the world in local space.
    pub fn length(&self, length_world: f64) -> f64 {
        self.local_per_world * length_world
    }

    /// A length of local space in the world.
    pub fn length_world(&self, length: f64) -> f64 {
        length / self.local_per_world
    }

    /// A camera of the world in local space.
    pub fn camera(&self, camera: &Camera) -> Camera {
        Camera {
            eye: self.point(camera.eye),
            target: self.point(camera.target),
            near: self.length(camera.near),
            far: self.length(camera.far),
            ..*camera
        }
    }

    /// A light of the world in local space.
    pub fn light(&self, light: &Light) -> Light {
        let mut local = *light;
        match &mut local.kind {
            LightKind::Spot { position, target, radius, near, far, .. } => {
                *position = self.point(*position);
                *target = self.point(*target);
                *radius = self.length(*radius);
                *near = self.length(*near);
                *far = self.length(*far);
            }
            LightKind::Point { position, radius, near, far } => {
                *position = self.point(*position);
                *radius = self.length(*radius);
                *near = self.length(*near);
                *far = self.length(*far);
            }
            LightKind::Directional { center, half_extent, half_depth, .. } => {
                *center = self.point(*center);
                *half_extent = self.length(*half_extent);
                *half_depth = self.length(*half_depth);
            }
            // Cascades are told in shares of what the eye sees.
            LightKind::Cascaded { .. } => {}
        }
        local
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn camera(scale: f64, offset: DVec3) -> Camera {
        Camera {
            eye: offset + scale * DVec3::new(0.0, 1.0, 3.0),
            target: offset,
            up: DVec3::Y,
            fov_y: 0.8,
            near: 0.1 * scale,
            far: 20.0 * scale,
        }
    }

    #[test]
    fn scenes_of_any_size_and_place_become_the_same() {
        let here = LocalSpace::around(&camera(1.0, DVec3::ZERO)).camera(&camera(1.0, DVec3::ZERO));
        for exponent in [-20, 20] {
            let scale = 2f64.powi(exponent);
            let there = camera(scale, DVec3::splat(1024.0 * scale));
            let local = LocalSpace::around(&there);
            assert_eq!(local.camera(&there), here);
            assert_eq!(local.length_world(local.length(0.3)), 0.3);
        }
    }

    #[test]
    fn matrix_and_point_agree() {
        let local = LocalSpace::around(&camera(3.0, DVec3::new(5.0, -7.0, 2.0)));
        let point = DVec3::new(1.0, 2.0, 3.0);
        assert!(local.local_from_world().transform_point3(point).abs_diff_eq(local.point(point), 1e-12));
        assert!(local.point_world(local.point(point)).abs_diff_eq(point, 1e-12));
    }

    #[test]
    fn an_eye_on_its_target_keeps_the_scale() {
        let mut camera = camera(1.0, DVec3::ONE);
        camera.eye = camera.target;
        assert_eq!(LocalSpace::around(&camera).length(2.0), 2.0);
    }
}
