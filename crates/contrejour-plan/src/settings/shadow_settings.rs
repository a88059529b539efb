//! Everything that can be set about one light's shadow, and presets.

use super::{
    AlphaRemap, DepthBias, ParameterRange, SmoothieBlend, SmoothieSettings, SmoothieWidth, Technique, VarianceSettings,
};
use crate::DeviceFacts;

/// What can be set about one light's shadow. Default: the preset `medium`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ShadowSettings {
    /// How the shadow is made. Default: smoothies as wide as the light's size asks.
    pub technique: Technique,
    /// Texels along a side of the square maps. Range: 1 to the device's largest texture. Default: 1024. Twice as
    /// many cost four times the memory and fill, and halve the steps of the hard edge.
    pub map_size: u32,
    /// Depth bias.
    pub bias: DepthBias,
    /// How exactly the maps keep linear depth and its moments, where the technique has any. Default: 32 bits.
    pub depth_precision: DepthPrecision,
}

/// How exactly linear depth is kept.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum DepthPrecision {
    /// 32-bit floats.
    #[default]
    Bits32,
    /// 16-bit floats, as a share of the view's farthest depth: half the memory and bandwidth; depth is off by up to
    /// 1 / 2048 of itself, which a bias of a texel hides on maps of up to some 1000 texels.
    Bits16,
}

/// Settings with a name.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// `low`, `medium`, `high` or `ultra`.
    pub name: &'static str,
    /// The settings.
    pub settings: ShadowSettings,
}

/// Presets from the cheapest to the best. They differ in the size of the maps and in how wide a smoothie may be,
/// which together bound the fill cost.
pub const PRESETS: [Preset; 4] =
    [preset("low", 512, 0.1), preset("medium", 1024, 0.25), preset("high", 2048, 0.5), preset("ultra", 4096, 2.0)];

const fn preset(name: &'static str, map_size: u32, width_max_ndc: f32) -> Preset {
    let technique = Technique::Smoothies(SmoothieSettings {
        width: SmoothieWidth::FromLightSize,
        width_max_ndc,
        remap: AlphaRemap::Contact,
        blend: SmoothieBlend::BestOfDevice,
    });
    let settings =
        ShadowSettings { technique, map_size, bias: DepthBias::DEFAULT, depth_precision: DepthPrecision::Bits32 };
    Preset { name, settings }
}

/// What is wrong with shadow settings.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SettingsError {
    /// The maps have no texels.
    #[error("the map size is 0: give at least 1 texel, 1024 is common")]
    NoTexels,
    /// A parameter of the technique is not in its range.
    #[error("{name} is {value}: give {range}")]
    Parameter {
        /// Its name.
        name: &'static str,
        /// What it holds.
        value: f64,
        /// What it may hold.
        range: ParameterRange,
    },
    /// The technique has no such parameter.
    #[error("the technique {technique} has no parameter \"{name}\": {}", known_ones(known))]
    UnknownParameter {
        /// The technique.
        technique: &'static str,
        /// The name that was given.
        name: String,
        /// The names that it has.
        known: Vec<&'static str>,
    },
    /// A bias is not in its range.
    #[error("the {field} is {value} texels: give a finite number of 0 or more")]
    Bias {
        /// Which bias.
        field: &'static str,
        /// What it holds.
        value: f32,
    },
    /// No preset has this name.
    #[error("there is no preset \"{name}\": give one of {}", PRESETS.map(|preset| preset.name).join(", "))]
    UnknownPreset {
        /// The name that was given.
        name: String,
    },
}

impl ShadowSettings {
    /// The preset of a name.
    ///
    /// # Errors
    ///
    /// No preset has the name.
    pub fn preset(name: &str) -> Result<Self, SettingsError> {
        let found = PRESETS.iter().find(|preset| preset.name == name);
        found.map(|preset| preset.settings).ok_or_else(|| SettingsError::UnknownPreset { name: name.to_owned() })
    }

    /// Checks every field against its range.
    ///
    /// # Errors
    ///
    /// The first field that is out of its range.
    pub fn validate(&self) -> Result<(), SettingsError> {
        if self.map_size == 0 {
            return Err(SettingsError::NoTexels);
        }
        for parameter in self.technique.parameters() {
            if let Some(value) = parameter.value.filter(|value| !parameter.range.contains(*value)) {
                return Err(SettingsError::Parameter { name: parameter.name, value, range: parameter.range });
            }
        }
        for (field, value) in self.bias.named_values() {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(SettingsError::Bias { field, value });
            }
        }
        Ok(())
    }

    /// The same as far as a device can do it: moments of 16 bits hold the warp only up to
    /// [`VarianceSettings::MAX_EXPONENT_OF_HALVES`].
    pub fn on_device(&self, device: &DeviceFacts) -> Self {
        let mut settings = *self;
        if let Technique::Variance(variance) = &mut settings.technique
            && !self.moments_have_32_bits(device)
        {
            variance.warp_exponent = variance.warp_exponent.min(VarianceSettings::MAX_EXPONENT_OF_HALVES);
        }
        settings
    }

    /// Whether moments are 32-bit floats: where they are asked for and samplers weigh them.
    pub(crate) fn moments_have_32_bits(&self, device: &DeviceFacts) -> bool {
        self.depth_precision == DepthPrecision::Bits32 && device.float32_filterable
    }
}

impl Default for ShadowSettings {
    fn default() -> Self {
        PRESETS[1].settings
    }
}

fn known_ones(known: &[&str]) -> String {
    if known.is_empty() { "it has none".to_owned() } else { format!("give one of {}", known.join(", ")) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn presets_are_good_and_found_by_name() {
        let mut sizes = Vec::new();
        for preset in PRESETS {
            assert_eq!(preset.settings.validate(), Ok(()));
            assert_eq!(ShadowSettings::preset(preset.name), Ok(preset.settings));
            sizes.push(preset.settings.map_size);
        }
        assert_eq!(sizes, [512, 1024, 2048, 4096]);
        assert_eq!(ShadowSettings::default(), ShadowSettings::preset("medium").expect("listed"));
        let error = ShadowSettings::preset("best").expect_err("not listed");
        assert_eq!(error.to_string(), "there is no preset \"best\": give one of low, medium, high, ultra");
    }

    #[test]
    fn each_bad_field_has_its_error() {
        let good = ShadowSettings::default();
        assert_eq!(ShadowSettings { map_size: 0, ..good }.validate(), Err(SettingsError::NoTexels));
        for value in [0.0, -0.1, 2.5, f32::INFINITY] {
            let width = SmoothieWidth::Ndc(value);
            let technique = Technique::Smoothies(SmoothieSettings { width, ..SmoothieSettings::default() });
            let error = ShadowSettings { technique, ..good }.validate().expect_err("out of range");
            assert!(matches!(error, SettingsError::Parameter { name: "width_ndc", .. }), "{error}");
        }
        let technique = Technique::Variance(VarianceSettings { warp_exponent: f32::NAN, ..VarianceSettings::EVSM });
        let error = ShadowSettings { technique, ..good }.validate();
        assert!(matches!(error, Err(SettingsError::Parameter { name: "warp_exponent", .. })));
        let bias = DepthBias { slope_texels: -1.0, ..DepthBias::default() };
        let error = SettingsError::Bias { field: "slope bias", value: -1.0 };
        assert_eq!(ShadowSettings { bias, ..good }.validate(), Err(error));
        let bias = DepthBias { constant_texels: f32::NAN, ..DepthBias::default() };
        assert!(matches!(ShadowSettings { bias, ..good }.validate(), Err(SettingsError::Bias { .. })));
    }
    #[test]
    fn halves_hold_less_warp() {
        let technique = Technique::Variance(VarianceSettings { warp_exponent: 40.0, ..VarianceSettings::EVSM });
        let settings = ShadowSettings { technique, ..ShadowSettings::default() };
        let able = DeviceFacts { float32_filterable: true, ..DeviceFacts::default() };
        assert_eq!(settings.on_device(&able), settings);
        let Technique::Variance(weak) = settings.on_device(&DeviceFacts::default()).technique else {
            panic!("it stays what it is")
        };
        assert_eq!(weak.warp_exponent, VarianceSettings::MAX_EXPONENT_OF_HALVES);
        assert!((2.0 * weak.warp_exponent).exp() < 65504.0);
    }
}
