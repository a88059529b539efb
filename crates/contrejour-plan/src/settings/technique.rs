//! Shadow techniques and what can be set about each.

use core::fmt;
use core::str::FromStr;

/// How a light's shadow is made. Default: smoothies.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Technique {
    /// A plain shadow map: hard shadows, and the cheapest.
    ShadowMap,
    /// Smoothies (Chan and Durand 2003): soft shadows whose outer penumbra grows with the distance from the caster.
    Smoothies(SmoothieSettings),
}

/// A name that no technique has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no technique \"{name}\": give one of {}", Technique::NAMES.join(", "))]
pub struct UnknownTechnique {
    /// The name that was given.
    pub name: String,
}

/// What can be set about smoothies.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SmoothieSettings {
    /// How wide the soft edge is. Default: from the light's size.
    pub width: SmoothieWidth,
    /// Largest width in NDC (the map's side is 2). Range: more than 0, up to 2. Default: 2, which is no limit. Less
    /// bounds the fill cost of a large light near its casters; their penumbra is then too narrow.
    pub width_max_ndc: f32,
    /// Whether the edge hardens towards the contact. Default: it does.
    pub remap: AlphaRemap,
    /// How overlapping smoothies are blended. Default: as well as the device can.
    pub blend: SmoothieBlend,
}

/// How wide a smoothie is.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum SmoothieWidth {
    /// The same everywhere. Unit: NDC (the map's side is 2). Range: more than 0, up to 2; Chan and Durand (2003) show
    /// 0.02 and 0.08.
    Ndc(f32),
    /// As the light's disk asks at each blocker's depth, so that the rim is where the outer penumbra ends.
    FromLightSize,
}

/// What happens to a smoothie's alpha where its receiver is near.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum AlphaRemap {
    /// The penumbra shrinks to nothing where the caster touches its receiver.
    #[default]
    Contact,
    /// The penumbra is as wide at the contact as anywhere: shows what the remap cures.
    Off,
}

/// How the nearest depth and the smallest alpha of overlapping smoothies are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum SmoothieBlend {
    /// In one pass where the device blends 32-bit floats, else in two.
    #[default]
    BestOfDevice,
    /// In two passes on every device: the depth by the hardware's depth test, then the alpha in 16-bit floats.
    TwoPasses,
}

impl Technique {
    /// The names of all techniques.
    pub const NAMES: [&str; 2] = ["shadow-map", "smoothies"];

    /// Its name on the command line and in scene files.
    pub fn name(&self) -> &'static str {
        match self {
            Self::ShadowMap => "shadow-map",
            Self::Smoothies(_) => "smoothies",
        }
    }
}

impl Default for Technique {
    fn default() -> Self {
        Self::Smoothies(SmoothieSettings::DEFAULT)
    }
}

impl fmt::Display for Technique {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(self.name())
    }
}

/// The technique of a name, with its default settings.
impl FromStr for Technique {
    type Err = UnknownTechnique;

    fn from_str(name: &str) -> Result<Self, UnknownTechnique> {
        match name {
            "shadow-map" => Ok(Self::ShadowMap),
            "smoothies" => Ok(Self::Smoothies(SmoothieSettings::DEFAULT)),
            _ => Err(UnknownTechnique { name: name.to_owned() }),
        }
    }
}

impl SmoothieSettings {
    /// The defaults.
    pub const DEFAULT: Self = Self {
        width: SmoothieWidth::FromLightSize,
        width_max_ndc: 2.0,
        remap: AlphaRemap::Contact,
        blend: SmoothieBlend::BestOfDevice,
    };
}

impl Default for SmoothieSettings {
    fn default() -> Self {
        Self::DEFAULT
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_come_back() {
        for name in Technique::NAMES {
            let technique: Technique = name.parse().expect("listed");
            assert_eq!(technique.to_string(), name);
        }
    }

    #[test]
    fn an_unknown_name_is_told_the_known_ones() {
        let error = "smoothie".parse::<Technique>().expect_err("not a name");
        assert_eq!(error.to_string(), "there is no technique \"smoothie\": give one of shadow-map, smoothies");
    }
}
