//! What the caller can set about a light's shadow.

mod bias;
mod shadow_settings;
mod technique;

pub use bias::DepthBias;
pub use shadow_settings::{PRESETS, Preset, SettingsError, ShadowSettings};
pub use technique::{AlphaRemap, SmoothieBlend, SmoothieSettings, SmoothieWidth, Technique, UnknownTechnique};
