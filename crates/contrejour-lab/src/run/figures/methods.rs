//! The techniques that the papers' figures compare.

use contrejour_plan::{
    ShadowSettings, SilhouetteMapSettings, SilhouetteSource, SilhouetteWinner, SmoothieSettings, SmoothieWidth,
    StreamPrecision, Technique,
};

/// A technique and what a figure calls it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Method {
    /// Its name in tables, legends and captions.
    pub label: &'static str,
    /// As a part of file names.
    pub file: &'static str,
    technique: Technique,
}

/// What everything is compared with.
pub(super) const SHADOW_MAP: Method =
    Method { label: "shadow map", file: "shadow-map", technique: Technique::ShadowMap };

/// The filter that Chan and Durand (2003) compare with.
pub(super) const BICUBIC: Method =
    Method { label: "bicubic filter", file: "bicubic", technique: Technique::BicubicPcf };

/// The thinner of the two widths that Chan and Durand (2003) show.
pub(super) const THIN: Method =
    Method { label: "smoothies, t = 0.02", file: "thin", technique: Technique::Smoothies(of_width(0.02)) };

/// The thicker one.
pub(super) const THICK: Method =
    Method { label: "smoothies, t = 0.08", file: "thick", technique: Technique::Smoothies(of_width(0.08)) };

/// Smoothies whose rim is where the true outer penumbra ends.
pub(super) const BY_LIGHT_SIZE: Method = Method {
    label: "smoothies, light's size",
    file: "by-light-size",
    technique: Technique::Smoothies(SmoothieSettings::DEFAULT),
};

/// Percentage-closer filtering of the four nearest texels.
pub(super) const TWO_BY_TWO: Method = Method { label: "2x2 filter", file: "2x2", technique: Technique::Pcf };

/// Silhouettes from the compute stages.
pub(super) const SILHOUETTE_MAP: Method = Method {
    label: "silhouette map",
    file: "silhouette-map",
    technique: Technique::SilhouetteMap(SilhouetteMapSettings::DEFAULT),
};

/// Silhouettes from the vertex stage, as Valient and Bujnak (2005) find them.
pub(super) const SILHOUETTE_MAP_TAM: Method = Method {
    label: "silhouette map, TAM",
    file: "silhouette-map-tam",
    technique: Technique::SilhouetteMap(SilhouetteMapSettings::TAM),
};

/// The same from the stream that Valient and Bujnak (2005) have.
pub(super) const SILHOUETTE_MAP_STREAM: Method = Method {
    label: "silhouette map, stream",
    file: "silhouette-map-stream",
    technique: Technique::SilhouetteMap(SilhouetteMapSettings::STREAM),
};

/// The same from their stream of 16-bit floats.
pub(super) const SILHOUETTE_MAP_HALF_STREAM: Method = Method {
    label: "silhouette map, half stream",
    file: "silhouette-map-half-stream",
    technique: Technique::SilhouetteMap(SilhouetteMapSettings {
        source: SilhouetteSource::Stream(StreamPrecision::Bits16),
        ..SilhouetteMapSettings::STREAM
    }),
};

/// Silhouettes from the compute stages, without depth that fragments write.
pub(super) const BLENDED_SILHOUETTE_MAP: Method = Method {
    label: "silhouette map, blended",
    file: "blended-silhouette-map",
    technique: Technique::SilhouetteMap(blended(SilhouetteMapSettings::DEFAULT)),
};

/// The same without depth that fragments write, with silhouettes from the vertex stage.
pub(super) const BLENDED_SILHOUETTE_MAP_TAM: Method = Method {
    label: "silhouette map, TAM, blended",
    file: "blended-silhouette-map-tam",
    technique: Technique::SilhouetteMap(blended(SilhouetteMapSettings::TAM)),
};

const fn blended(silhouettes: SilhouetteMapSettings) -> SilhouetteMapSettings {
    SilhouetteMapSettings { winner: SilhouetteWinner::ByBlending, ..silhouettes }
}

const fn of_width(width_ndc: f32) -> SmoothieSettings {
    SmoothieSettings { width: SmoothieWidth::Ndc(width_ndc), ..SmoothieSettings::DEFAULT }
}

impl Method {
    /// Whether the vertex stage of a pass finds silhouettes.
    pub fn finds_in_vertex_stage(&self) -> bool {
        let from_stages = |silhouettes: &SilhouetteMapSettings| silhouettes.source == SilhouetteSource::Stages;
        matches!(&self.technique, Technique::SilhouetteMap(silhouettes) if !from_stages(silhouettes))
    }

    /// A scene's settings with this technique.
    pub fn settings(&self, scene: &ShadowSettings, map_size: u32) -> ShadowSettings {
        ShadowSettings { technique: self.technique, map_size, ..*scene }
    }
}
