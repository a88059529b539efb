//! What the caller can set about a light's shadow.

mod bias;
mod parameters;
mod percentage_closer;
mod shadow_settings;
mod silhouette_maps;
mod smoothies;
mod technique;
mod variance;

pub use bias::DepthBias;
pub use parameters::{Parameter, ParameterRange};
pub use percentage_closer::{GaussianKernel, GaussianPcfSettings, PcssSettings};
pub use shadow_settings::{DepthPrecision, PRESETS, Preset, SettingsError, ShadowSettings};
pub use silhouette_maps::{EdgeProfile, SilhouetteMapSettings, SilhouetteSource, SilhouetteWinner, StreamPrecision};
pub use smoothies::{AlphaRemap, SmoothieBlend, SmoothieSettings, SmoothieWidth};
pub use technique::{Technique, UnknownTechnique};
pub use variance::{VarianceSettings, VarianceSoftness};
