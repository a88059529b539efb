//! Lights as the caller gives them.

mod cascade_settings;
mod error;
mod kind;
mod validate;

pub use cascade_settings::CascadeSettings;
pub use error::LightError;
pub use kind::LightKind;
pub(crate) use validate::{is_normal, not_negative};

/// A light that casts a shadow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Where it is and where it shines.
    pub kind: LightKind,
    /// Linear colour times intensity. Unit: radiance of a white surface that faces it. Range: 0 and up.
    pub color: [f32; 3],
}

impl Light {
    /// Whether the light is a point or a perfectly parallel sun, whose shadows are hard.
    pub fn has_no_size(&self) -> bool {
        match self.kind {
            LightKind::Spot { radius, .. } | LightKind::Point { radius, .. } => radius == 0.0,
            LightKind::Directional { angular_radius, .. } | LightKind::Cascaded { angular_radius, .. } => {
                angular_radius == 0.0
            }
        }
    }
}
