//! What shines.

use contrejour_plan::{Light, LightError, LightKind};
use glam::DVec3;

use crate::TraceError;

/// An area light in the world of the receivers. It shines to both sides and blocks nothing. Of size 0 it is a point or
/// a direction, and its shadows are hard.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightShape {
    /// A disk.
    Disk {
        /// Its centre.
        center: DVec3,
        /// What it is perpendicular to; any length but zero.
        normal: DVec3,
        /// Unit: world. Range: 0 and up.
        radius: f64,
    },
    /// A sphere that is equally bright all over, so its visibility counts by solid angle: what matters on a surface.
    ///
    /// A point at the distance d from the centre of a sphere of radius R sees no more of it than the disk inside its
    /// silhouette, which faces the point at the distance d - R^2 / d and has the radius R sqrt(1 - R^2 / d^2). By that
    /// disk's area the answer would be almost the same: up to R = 0.4 d, a half plane hides parts of the two that are
    /// apart by less than 0.06 (R / d)^2.
    Sphere {
        /// Its centre.
        center: DVec3,
        /// Unit: world. Range: 0 and up.
        radius: f64,
    },
    /// A parallelogram with the corners `center` plus and minus `half_u` plus and minus `half_v`.
    Rectangle {
        /// Its centre.
        center: DVec3,
        /// From the centre to the middle of a side.
        half_u: DVec3,
        /// From the centre to the middle of a neighbouring side.
        half_v: DVec3,
    },
    /// A disk so far away that all receivers see it in the same directions: those of a disk at distance 1 that is
    /// perpendicular to its axis.
    Sun {
        /// Towards its centre; any length but zero.
        towards_light: DVec3,
        /// Angle between the directions of its centre and its rim, radians. Range: 0 and up, less than pi / 2.
        angular_radius: f64,
    },
}

impl LightShape {
    /// The light that the shadow techniques mean: a disk parallel to the light's image plane, or the sphere of a point
    /// light.
    ///
    /// # Errors
    ///
    /// The first field of the light that is out of its range.
    pub fn of(light: &Light) -> Result<Self, LightError> {
        light.validate()?;
        Ok(match light.kind {
            LightKind::Spot { position, target, radius, .. } => {
                Self::Disk { center: position, normal: target - position, radius }
            }
            LightKind::Point { position, radius, .. } => Self::Sphere { center: position, radius },
            LightKind::Directional { towards_light, angular_radius, .. }
            | LightKind::Cascaded { towards_light, angular_radius, .. } => Self::Sun { towards_light, angular_radius },
        })
    }

    pub(crate) fn validate(&self) -> Result<(), TraceError> {
        const FINITE: &str = "finite numbers";
        const AXIS: &str = "a finite vector other than zero";
        const SIZE: &str = "a finite number, 0 or more";
        let require = |holds: bool, field, value, range| match holds {
            true => Ok(()),
            false => Err(TraceError::Light { field, value, range }),
        };
        let finite = |field, point: DVec3| require(point.is_finite(), field, odd_one(point), FINITE);
        let axis = |field, axis: DVec3| require(axis.is_finite() && axis != DVec3::ZERO, field, odd_one(axis), AXIS);
        let size = |field, size: f64| require((0.0..f64::INFINITY).contains(&size), field, size, SIZE);
        match *self {
            Self::Disk { center, normal, radius } => {
                finite("center", center)?;
                axis("normal", normal)?;
                size("radius", radius)
            }
            Self::Sphere { center, radius } => {
                finite("center", center)?;
                size("radius", radius)
            }
            Self::Rectangle { center, half_u, half_v } => {
                finite("center", center)?;
                finite("half_u", half_u)?;
                finite("half_v", half_v)
            }
            Self::Sun { towards_light, angular_radius } => {
                axis("direction towards the light", towards_light)?;
                let is_less_than_half_the_sky = (0.0..core::f64::consts::FRAC_PI_2).contains(&angular_radius);
                require(is_less_than_half_the_sky, "angular radius", angular_radius, "0 or more and less than pi / 2")
            }
        }
    }
}

/// The component that is not finite, or else the largest.
fn odd_one(vector: DVec3) -> f64 {
    let components = vector.to_array();
    components.into_iter().find(|value| !value.is_finite()).unwrap_or(vector.max_element())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lights_of_the_plan_are_disks_and_spheres() {
        let (position, target) = (DVec3::new(0.0, 5.0, 0.0), DVec3::new(0.0, 1.0, 3.0));
        let kind = LightKind::Spot { position, target, cone_angle: 1.0, radius: 0.3, near: 0.1, far: 9.0 };
        let disk = LightShape::Disk { center: position, normal: target - position, radius: 0.3 };
        assert_eq!(LightShape::of(&Light { kind, color: [1.0; 3] }), Ok(disk));

        let kind = LightKind::Point { position, radius: 0.3, near: 0.1, far: 9.0 };
        let sphere = LightShape::Sphere { center: position, radius: 0.3 };
        assert_eq!(LightShape::of(&Light { kind, color: [1.0; 3] }), Ok(sphere));

        let towards_light = DVec3::new(1.0, 2.0, 3.0);
        let kind = LightKind::Directional {
            towards_light,
            center: DVec3::ZERO,
            half_extent: 4.0,
            half_depth: 6.0,
            angular_radius: 0.02,
        };
        let sun = LightShape::Sun { towards_light, angular_radius: 0.02 };
        assert_eq!(LightShape::of(&Light { kind, color: [1.0; 3] }), Ok(sun));

        let kind = LightKind::Spot { position, target: position, cone_angle: 1.0, radius: 0.3, near: 0.1, far: 9.0 };
        assert_eq!(LightShape::of(&Light { kind, color: [1.0; 3] }), Err(LightError::NoAxis { target: position }));
    }

    #[test]
    fn each_bad_field_has_its_error() {
        let (center, normal, radius) = (DVec3::ZERO, DVec3::Y, 1.0);
        let (half_u, half_v) = (DVec3::X, DVec3::Z);
        let nowhere = DVec3::new(0.0, f64::NAN, 0.0);
        let bad = [
            ("center", LightShape::Disk { center: nowhere, normal, radius }),
            ("normal", LightShape::Disk { center, normal: DVec3::ZERO, radius }),
            ("radius", LightShape::Disk { center, normal, radius: -1.0 }),
            ("center", LightShape::Sphere { center: nowhere, radius }),
            ("radius", LightShape::Sphere { center, radius: f64::INFINITY }),
            ("center", LightShape::Rectangle { center: nowhere, half_u, half_v }),
            ("half_u", LightShape::Rectangle { center, half_u: nowhere, half_v }),
            ("half_v", LightShape::Rectangle { center, half_u, half_v: nowhere }),
            ("direction towards the light", LightShape::Sun { towards_light: DVec3::ZERO, angular_radius: 0.0 }),
            ("angular radius", LightShape::Sun { towards_light: DVec3::Y, angular_radius: 1.6 }),
        ];
        for (name, light) in bad {
            let error = light.validate();
            assert!(matches!(error, Err(TraceError::Light { field, .. }) if field == name), "{light:?}: {error:?}");
        }
    }
}
