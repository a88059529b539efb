//! Shadow techniques.

use core::fmt;
use core::str::FromStr;

use super::{
    GaussianPcfSettings, PcssSettings, SilhouetteMapSettings, SilhouetteSource, SmoothieSettings, VarianceSettings,
    VarianceSoftness,
};

/// How a light's shadow is made. Default: smoothies.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
#[non_exhaustive]
pub enum Technique {
    /// One comparison with the nearest texel of a shadow map (Williams 1978), by the hardware: hard shadows with steps,
    /// and the cheapest.
    ShadowMap,
    /// Percentage-closer filtering (Reeves, Salesin and Cook 1987) over the four nearest texels, by the hardware's
    /// comparison sampler: hard shadows with smooth edges.
    Pcf,
    /// Percentage-closer filtering with a bell-shaped kernel, in few look-ups of four texels each (Castano 2013,
    /// "Shadow Mapping Summary"): soft edges of the same width everywhere.
    GaussianPcf(GaussianPcfSettings),
    /// Percentage-closer filtering with the cubic B-spline over 16 texels, which Chan and Durand (2003) compare with.
    BicubicPcf,
    /// Percentage-closer soft shadows (Fernando 2005): the mean blocker's depth sets the filter's radius.
    Pcss(PcssSettings),
    /// Variance shadow maps (Donnelly and Lauritzen 2006), plain or exponentially warped (Lauritzen and McCool 2008),
    /// blurred evenly or as the blockers' depth asks.
    Variance(VarianceSettings),
    /// Smoothies (Chan and Durand 2003): soft shadows whose outer penumbra grows with the distance from the caster.
    Smoothies(SmoothieSettings),
    /// Silhouette maps (Valient and Bujnak 2005): signed distances to silhouettes beside the depths, for exact hard shadows
    /// and for soft ones in few look-ups.
    SilhouetteMap(SilhouetteMapSettings),
}

/// A name that no technique has.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no technique \"{name}\": give one of {}", Technique::NAMES.join(", "))]
pub struct UnknownTechnique {
    /// The name that was given.
    pub name: String,
}

impl Technique {
    /// The names of all techniques.
    pub const NAMES: [&str; 13] = [
        "shadow-map",
        "pcf",
        "gaussian-pcf",
        "bicubic-pcf",
        "pcss",
        "vsm",
        "evsm",
        "vsm-pcss",
        "evsm-pcss",
        "smoothies",
        "silhouette-map",
        "silhouette-map-tam",
        "silhouette-map-stream",
    ];

    /// Whether it reads moments of warped depth.
    pub(crate) fn is_warped(&self) -> bool {
        matches!(self, Self::Variance(variance) if variance.is_warped())
    }

    /// Its name on the command line and in scene files.
    pub fn name(&self) -> &'static str {
        match self {
            Self::ShadowMap => "shadow-map",
            Self::Pcf => "pcf",
            Self::GaussianPcf(_) => "gaussian-pcf",
            Self::BicubicPcf => "bicubic-pcf",
            Self::Pcss(_) => "pcss",
            Self::Variance(variance) => match (variance.is_warped(), variance.softness) {
                (false, VarianceSoftness::Texels(_)) => "vsm",
                (true, VarianceSoftness::Texels(_)) => "evsm",
                (false, VarianceSoftness::FromLightSize { .. }) => "vsm-pcss",
                (true, VarianceSoftness::FromLightSize { .. }) => "evsm-pcss",
            },
            Self::Smoothies(_) => "smoothies",
            Self::SilhouetteMap(SilhouetteMapSettings { source, .. }) => match source {
                SilhouetteSource::Stages => "silhouette-map",
                SilhouetteSource::Faces => "silhouette-map-tam",
                SilhouetteSource::Stream(_) => "silhouette-map-stream",
            },
        }
    }

    /// The technique of a name: itself where that is its own, else with default settings. All sources of a silhouette map
    /// are tuned alike, so from one to the other its settings stay.
    ///
    /// # Errors
    ///
    /// There is no such technique.
    pub fn named(self, name: &str) -> Result<Self, UnknownTechnique> {
        Ok(match (self, name.parse()?) {
            _ if name == self.name() => self,
            (Self::SilhouetteMap(tuned), Self::SilhouetteMap(named)) => {
                Self::SilhouetteMap(SilhouetteMapSettings { source: named.source, ..tuned })
            }
            (_, named) => named,
        })
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
        Ok(match name {
            "shadow-map" => Self::ShadowMap,
            "pcf" => Self::Pcf,
            "gaussian-pcf" => Self::GaussianPcf(GaussianPcfSettings::DEFAULT),
            "bicubic-pcf" => Self::BicubicPcf,
            "pcss" => Self::Pcss(PcssSettings::DEFAULT),
            "vsm" => Self::Variance(VarianceSettings::VSM),
            "evsm" => Self::Variance(VarianceSettings::EVSM),
            "vsm-pcss" => Self::Variance(VarianceSettings::VSM_PCSS),
            "evsm-pcss" => Self::Variance(VarianceSettings::EVSM_PCSS),
            "smoothies" => Self::Smoothies(SmoothieSettings::DEFAULT),
            "silhouette-map" => Self::SilhouetteMap(SilhouetteMapSettings::DEFAULT),
            "silhouette-map-tam" => Self::SilhouetteMap(SilhouetteMapSettings::TAM),
            "silhouette-map-stream" => Self::SilhouetteMap(SilhouetteMapSettings::STREAM),
            _ => return Err(UnknownTechnique { name: name.to_owned() }),
        })
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
    fn naming_keeps_settings_of_the_same_kind() {
        let tuned = SilhouetteMapSettings { samples: 3, ..SilhouetteMapSettings::DEFAULT };
        let from_faces = SilhouetteMapSettings { source: SilhouetteSource::Faces, ..tuned };
        let named = |technique: Technique, name| technique.named(name).expect("listed");
        assert_eq!(named(Technique::SilhouetteMap(tuned), "silhouette-map"), Technique::SilhouetteMap(tuned));
        assert_eq!(named(Technique::SilhouetteMap(tuned), "silhouette-map-tam"), Technique::SilhouetteMap(from_faces));
        assert_eq!(named(Technique::SilhouetteMap(tuned), "smoothies"), Technique::default());
        assert!(Technique::Pcf.named("smoothie").is_err());
    }

    #[test]
    fn an_unknown_name_is_told_the_known_ones() {
        let error = "smoothie".parse::<Technique>().expect_err("not a name");
        assert!(error.to_string().starts_with("there is no technique \"smoothie\": give one of shadow-map, pcf, "));
    }
}
