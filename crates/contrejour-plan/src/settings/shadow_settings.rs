//! Everything that can be set about one light's shadow, and presets.

use super::{AlphaRemap, DepthBias, SmoothieBlend, SmoothieSettings, SmoothieWidth, Technique};

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
    Preset { name, settings: ShadowSettings { technique, map_size, bias: DepthBias::DEFAULT } }
}

/// What is wrong with shadow settings.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SettingsError {
    /// The maps have no texels.
    #[error("the map size is 0: give at least 1 texel, 1024 is common")]
    NoTexels,
    /// A width is not in its range.
    #[error("the smoothie {field} is {value}: give more than 0 and at most 2, which is the whole map")]
    Width {
        /// Which width.
        field: &'static str,
        /// What it holds.
        value: f32,
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
        if let Technique::Smoothies(smoothies) = &self.technique {
            if let SmoothieWidth::Ndc(width) = smoothies.width {
                check_width("width", width)?;
            }
            check_width("largest width", smoothies.width_max_ndc)?;
        }
        for (field, value) in self.bias.named_values() {
            if !(value >= 0.0 && value.is_finite()) {
                return Err(SettingsError::Bias { field, value });
            }
        }
        Ok(())
    }
}

impl Default for ShadowSettings {
    fn default() -> Self {
        PRESETS[1].settings
    }
}

fn check_width(field: &'static str, value: f32) -> Result<(), SettingsError> {
    if value > 0.0 && value <= 2.0 { Ok(()) } else { Err(SettingsError::Width { field, value }) }
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
        for value in [0.0, -0.1, 2.1, f32::INFINITY] {
            let technique = Technique::Smoothies(SmoothieSettings {
                width: SmoothieWidth::Ndc(value),
                ..SmoothieSettings::default()
            });
            let error = SettingsError::Width { field: "width", value };
            assert_eq!(ShadowSettings { technique, ..good }.validate(), Err(error));
            let technique =
                Technique::Smoothies(SmoothieSettings { width_max_ndc: value, ..SmoothieSettings::default() });
            let error = SettingsError::Width { field: "largest width", value };
            assert_eq!(ShadowSettings { technique, ..good }.validate(), Err(error));
        }
        let bias = DepthBias { slope_texels: -1.0, ..DepthBias::default() };
        let error = SettingsError::Bias { field: "slope bias", value: -1.0 };
        assert_eq!(ShadowSettings { bias, ..good }.validate(), Err(error));
        let bias = DepthBias { constant_texels: f32::NAN, ..DepthBias::default() };
        assert!(matches!(ShadowSettings { bias, ..good }.validate(), Err(SettingsError::Bias { .. })));
    }
}
