//! Lights as the caller gives them.

use core::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

/// A light that casts a shadow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Where it is and where it shines.
    pub kind: LightKind,
    /// Linear colour times intensity. Unit: radiance of a white surface that faces it. Range: 0 and up.
    pub color: [f32; 3],
}

/// Shape of a light.
///
/// Every number must be finite and fit in an `f32`, except for the length of `towards_light`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// A cone of light from a point or a small disk.
    Spot {
        /// Position, world space.
        position: DVec3,
        /// Point that the axis goes through, world space. Range: anywhere but `position`.
        target: DVec3,
        /// Full opening angle of the cone; the square shadow map just holds the cone. Range: more than 0 and less
        /// than pi.
        cone_angle: f64,
        /// Radius of the disk that shines, parallel to the image plane, world units. Range: 0 and up.
        radius: f64,
        /// Nearest depth that casts, world units. Range: more than 0.
        near: f64,
        /// Farthest depth that casts and receives, world units. Range: more than `near`, up to 8.5e37.
        far: f64,
    },
    /// Parallel light, like a sun.
    Directional {
        /// Direction from the scene towards the light, world space; any length but zero.
        towards_light: DVec3,
        /// Centre of what is to be shadowed, world space.
        center: DVec3,
        /// Half the side of the square that is shadowed around `center`, world units. Range: more than 0.
        half_extent: f64,
        /// Half the depth that is shadowed around `center`, world units; what is nearer to the light casts nothing.
        /// Range: more than 0.
        half_depth: f64,
        /// Angular radius of the disk that shines (the sun's is 0.00465). Range: 0 and up, less than pi / 2.
        angular_radius: f64,
    },
}

/// What is wrong with a light.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LightError {
    /// A number is infinite, NaN or too large.
    #[error("the light's {field} is {value}: give a finite number that fits in 32 bits")]
    NotFinite {
        /// Name of the field.
        field: &'static str,
        /// What it holds.
        value: f64,
    },
    /// A number that must not be negative is.
    #[error("the light's {field} is {value}: give 0 or more")]
    Negative {
        /// Name of the field.
        field: &'static str,
        /// What it holds.
        value: f64,
    },
    /// A number that must be positive is not, or is too small.
    #[error("the light's {field} is {value}: give more than 0 (at least 1.2e-38, the smallest normal 32-bit number)")]
    NotPositive {
        /// Name of the field.
        field: &'static str,
        /// What it holds.
        value: f64,
    },
    /// The spot's target is its position.
    #[error("the spot stands on its target {target}: move the target to where the axis shall go")]
    NoAxis {
        /// Position and target.
        target: DVec3,
    },
    /// The direction is zero.
    #[error("the direction towards the light is zero: give any other vector, its length does not matter")]
    NoDirection,
    /// The cone is closed, or wider than a plane can show.
    #[error("the cone angle is {radians} radians: give more than 0 and less than pi (3.14159), 1 is common")]
    ConeAngle {
        /// Full opening angle.
        radians: f64,
    },
    /// The disk of a directional light covers half the sky.
    #[error("the angular radius is {radians} radians: give 0 or more and less than pi / 2, the sun has 0.00465")]
    AngularRadius {
        /// Angular radius.
        radians: f64,
    },
    /// One over the farthest depth is no normal 32-bit number.
    #[error("the spot's far is {far}: give at most 8.5e37, since shaders reckon with one over depth")]
    TooFar {
        /// Farthest depth.
        far: f64,
    },
    /// There is no depth between near and far.
    #[error("near is {near} and far is {far}: give a far that is clearly more than near")]
    DepthRange {
        /// Nearest depth.
        near: f64,
        /// Farthest depth.
        far: f64,
    },
}

impl Light {
    /// Whether the light is a point or a perfectly parallel sun, whose shadows are hard.
    pub fn has_no_size(&self) -> bool {
        match self.kind {
            LightKind::Spot { radius, .. } => radius == 0.0,
            LightKind::Directional { angular_radius, .. } => angular_radius == 0.0,
        }
    }

    /// Checks every field against its range.
    ///
    /// # Errors
    ///
    /// The first field that is out of its range.
    pub fn validate(&self) -> Result<(), LightError> {
        for value in self.color {
            not_negative("color", value.into())?;
        }
        match self.kind {
            LightKind::Spot { position, target, cone_angle, radius, near, far } => {
                finite_point("position", position)?;
                finite_point("target", target)?;
                if position == target {
                    return Err(LightError::NoAxis { target });
                }
                if !(cone_angle > 0.0 && cone_angle < PI && is_normal((cone_angle / 2.0).tan())) {
                    return Err(LightError::ConeAngle { radians: cone_angle });
                }
                not_negative("radius", radius)?;
                not_negative("radius over the tangent of half the cone", radius / (cone_angle / 2.0).tan())?;
                positive("near", near)?;
                positive("far", far)?;
                // Devices may take smaller numbers for zero, and one over that is infinite.
                if !is_normal(far.recip()) {
                    return Err(LightError::TooFar { far });
                }
                // Compared as the shaders get them, so that `near < far` holds there too.
                if (near as f32) < (far as f32) { Ok(()) } else { Err(LightError::DepthRange { near, far }) }
            }
            LightKind::Directional { towards_light, center, half_extent, half_depth, angular_radius } => {
                for value in towards_light.to_array() {
                    if !value.is_finite() {
                        return Err(LightError::NotFinite { field: "direction towards the light", value });
                    }
                }
                if towards_light == DVec3::ZERO {
                    return Err(LightError::NoDirection);
                }
                finite_point("center", center)?;
                positive("half extent", half_extent)?;
                positive("half depth", half_depth)?;
                positive("depth range", 2.0 * half_depth)?;
                if !(0.0..FRAC_PI_2).contains(&angular_radius) {
                    return Err(LightError::AngularRadius { radians: angular_radius });
                }
                not_negative("angular radius' tangent over the half extent", angular_radius.tan() / half_extent)
            }
        }
    }
}

fn is_normal(value: f64) -> bool {
    (value as f32).is_normal()
}

fn finite(field: &'static str, value: f64) -> Result<(), LightError> {
    if (value as f32).is_finite() { Ok(()) } else { Err(LightError::NotFinite { field, value }) }
}

fn finite_point(field: &'static str, point: DVec3) -> Result<(), LightError> {
    point.to_array().into_iter().try_for_each(|value| finite(field, value))
}

fn not_negative(field: &'static str, value: f64) -> Result<(), LightError> {
    finite(field, value)?;
    if value >= 0.0 { Ok(()) } else { Err(LightError::Negative { field, value }) }
}

fn positive(field: &'static str, value: f64) -> Result<(), LightError> {
    finite(field, value)?;
    if value > 0.0 && is_normal(value) { Ok(()) } else { Err(LightError::NotPositive { field, value }) }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spot(change: impl FnOnce(&mut [f64; 4])) -> Result<(), LightError> {
        let mut numbers = [1.0, 0.1, 0.5, 20.0];
        change(&mut numbers);
        let [cone_angle, radius, near, far] = numbers;
        let (position, target) = (DVec3::new(0.0, 5.0, 0.0), DVec3::ZERO);
        Light { kind: LightKind::Spot { position, target, cone_angle, radius, near, far }, color: [1.0; 3] }.validate()
    }

    fn sun(towards_light: DVec3, change: impl FnOnce(&mut [f64; 3])) -> Result<(), LightError> {
        let mut numbers = [4.0, 6.0, 0.01];
        change(&mut numbers);
        let [half_extent, half_depth, angular_radius] = numbers;
        let center = DVec3::ZERO;
        let kind = LightKind::Directional { towards_light, center, half_extent, half_depth, angular_radius };
        Light { kind, color: [1.0; 3] }.validate()
    }

    #[test]
    fn good_lights_pass() {
        assert_eq!(spot(|_| ()), Ok(()));
        assert_eq!(spot(|n| n[1] = 0.0), Ok(()));
        assert_eq!(sun(DVec3::Y, |_| ()), Ok(()));
        assert_eq!(sun(DVec3::splat(1e-200), |_| ()), Ok(()), "only the direction counts");
    }

    #[test]
    fn each_bad_field_has_its_error() {
        assert_eq!(spot(|n| n[0] = 0.0), Err(LightError::ConeAngle { radians: 0.0 }));
        assert_eq!(spot(|n| n[0] = PI), Err(LightError::ConeAngle { radians: PI }));
        assert!(matches!(spot(|n| n[0] = f64::NAN), Err(LightError::ConeAngle { .. })));
        assert_eq!(spot(|n| n[1] = -1.0), Err(LightError::Negative { field: "radius", value: -1.0 }));
        assert_eq!(spot(|n| n[2] = 0.0), Err(LightError::NotPositive { field: "near", value: 0.0 }));
        assert_eq!(spot(|n| n[2] = 1e-50), Err(LightError::NotPositive { field: "near", value: 1e-50 }));
        assert_eq!(spot(|n| n[3] = 0.5), Err(LightError::DepthRange { near: 0.5, far: 0.5 }));
        assert_eq!(spot(|n| n[3] = 0.5 + 1e-12), Err(LightError::DepthRange { near: 0.5, far: 0.5 + 1e-12 }));
        assert_eq!(spot(|n| n[3] = 8.5e37), Ok(()));
        assert_eq!(spot(|n| n[3] = 1e38), Err(LightError::TooFar { far: 1e38 }));
        assert_eq!(spot(|n| n[3] = 1e40), Err(LightError::NotFinite { field: "far", value: 1e40 }));
        assert_eq!(sun(DVec3::ZERO, |_| ()), Err(LightError::NoDirection));
        assert!(matches!(sun(DVec3::new(0.0, f64::INFINITY, 0.0), |_| ()), Err(LightError::NotFinite { .. })));
        assert_eq!(sun(DVec3::Y, |n| n[0] = 0.0), Err(LightError::NotPositive { field: "half extent", value: 0.0 }));
        assert_eq!(sun(DVec3::Y, |n| n[1] = -2.0), Err(LightError::NotPositive { field: "half depth", value: -2.0 }));
        assert_eq!(sun(DVec3::Y, |n| n[2] = FRAC_PI_2), Err(LightError::AngularRadius { radians: FRAC_PI_2 }));
    }

    #[test]
    fn a_spot_on_its_target_has_no_axis() {
        let target = DVec3::ONE;
        let kind = LightKind::Spot { position: target, target, cone_angle: 1.0, radius: 0.0, near: 0.1, far: 1.0 };
        assert_eq!(Light { kind, color: [1.0; 3] }.validate(), Err(LightError::NoAxis { target }));
    }

    #[test]
    fn colors_must_be_light() {
        let kind = LightKind::Spot {
            position: DVec3::ZERO,
            target: DVec3::X,
            cone_angle: 1.0,
            radius: 0.0,
            near: 0.1,
            far: 1.0,
        };
        let error = Light { kind, color: [1.0, -0.5, 1.0] }.validate();
        assert_eq!(error, Err(LightError::Negative { field: "color", value: -0.5 }));
    }
}
