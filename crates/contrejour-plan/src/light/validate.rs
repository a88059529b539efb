//! Whether a light's fields are in their ranges.

use core::f64::consts::{FRAC_PI_2, PI};

use glam::DVec3;

use super::{CascadeSettings, Light, LightError, LightKind};

impl Light {
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
                depth_range(near, far)
            }
            LightKind::Point { position, radius, near, far } => {
                finite_point("position", position)?;
                not_negative("radius", radius)?;
                depth_range(near, far)
            }
            LightKind::Directional { towards_light, center, half_extent, half_depth, angular_radius } => {
                direction(towards_light)?;
                finite_point("center", center)?;
                positive("half extent", half_extent)?;
                positive("half depth", half_depth)?;
                positive("depth range", 2.0 * half_depth)?;
                less_than_half_the_sky(angular_radius)?;
                not_negative("angular radius' tangent over the half extent", angular_radius.tan() / half_extent)
            }
            LightKind::Cascaded { towards_light, angular_radius, cascades } => {
                direction(towards_light)?;
                less_than_half_the_sky(angular_radius)?;
                cascades.validate()
            }
        }
    }
}

impl CascadeSettings {
    fn validate(&self) -> Result<(), LightError> {
        if !(1..=Self::MAX_COUNT).contains(&self.count) {
            return Err(LightError::CascadeCount { count: self.count });
        }
        let share = |field, value: f64, most| match (0.0..=most).contains(&value) {
            true => Ok(()),
            false => Err(LightError::CascadeShare { field, value, most }),
        };
        share("logarithmic share", self.logarithmic_share, 1.0)?;
        share("border share", self.border_share, Self::MAX_BORDER_SHARE)?;
        share("caster margin", self.caster_margin, Self::MAX_CASTER_MARGIN)
    }
}

/// A direction towards a light, of any length.
fn direction(towards_light: DVec3) -> Result<(), LightError> {
    for value in towards_light.to_array() {
        if !value.is_finite() {
            return Err(LightError::NotFinite { field: "direction towards the light", value });
        }
    }
    if towards_light == DVec3::ZERO { Err(LightError::NoDirection) } else { Ok(()) }
}

fn less_than_half_the_sky(angular_radius: f64) -> Result<(), LightError> {
    let is_less = (0.0..FRAC_PI_2).contains(&angular_radius);
    if is_less { Ok(()) } else { Err(LightError::AngularRadius { radians: angular_radius }) }
}

/// Depths of a perspective view.
fn depth_range(near: f64, far: f64) -> Result<(), LightError> {
    positive("near", near)?;
    positive("far", far)?;
    // Devices may take smaller numbers for zero, and one over that is infinite.
    if !is_normal(far.recip()) {
        return Err(LightError::TooFar { far });
    }
    // Compared as the shaders get them, so that `near < far` holds there too.
    if (near as f32) < (far as f32) { Ok(()) } else { Err(LightError::DepthRange { near, far }) }
}

/// Whether it is a normal number of 32 bits.
pub(crate) fn is_normal(value: f64) -> bool {
    (value as f32).is_normal()
}

fn finite(field: &'static str, value: f64) -> Result<(), LightError> {
    if (value as f32).is_finite() { Ok(()) } else { Err(LightError::NotFinite { field, value }) }
}

fn finite_point(field: &'static str, point: DVec3) -> Result<(), LightError> {
    point.to_array().into_iter().try_for_each(|value| finite(field, value))
}

pub(crate) fn not_negative(field: &'static str, value: f64) -> Result<(), LightError> {
    finite(field, value)?;
    if value >= 0.0 { Ok(()) } else { Err(LightError::Negative { field, value }) }
}

fn positive(field: &'static str, value: f64) -> Result<(), LightError> {
    finite(field, value)?;
    if value > 0.0 && is_normal(value) { Ok(()) } else { Err(LightError::NotPositive { field, value }) }
}

#[cfg(test)]
mod tests;
