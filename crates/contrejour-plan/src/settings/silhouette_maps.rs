//! What can be set about silhouette maps.

use core::f32::consts::SQRT_2;

/// What can be set about silhouette maps (Valient and Bujnak 2005): a shadow map with a second one beside it, which holds
/// for each texel near a silhouette the signed distance to it and its depth.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SilhouetteMapSettings {
    /// Who finds the silhouettes. Default: the compute stages.
    pub source: SilhouetteSource,
    /// How wide the hardest edge is, from dark to lit. Unit: texels. Range: more than 0, up to 4. Default: 0.5. Less shows
    /// stairs of the picture's own pixels.
    pub edge_texels: f32,
    /// Largest half width of a penumbra in NDC (the map's side is 2). Range: more than 0, up to 2. Default: 0.1. As far on
    /// both sides of a silhouette distances are drawn, so less bounds the fill cost of a large light near its casters;
    /// their penumbra is then too narrow.
    pub width_max_ndc: f32,
    /// Places around a receiver at which a soft edge is looked up. Range: 1 to 1024. Default: 8. Valient and Bujnak take four
    /// and say that more lower the errors. One is exact where a straight edge is alone in reach, and knows one edge of what
    /// is thinner than its penumbra. A light without size asks for one.
    pub samples: u32,
    /// How a soft edge goes from dark to lit. Default: as a disk of light does behind a straight edge.
    pub profile: EdgeProfile,
    /// How the nearest of the silhouettes around a texel wins. Default: by depth that fragments write.
    pub winner: SilhouetteWinner,
}

/// Who finds the silhouettes of a silhouette map.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum SilhouetteSource {
    /// The compute stages, exactly; a quad around each outline edge is drawn.
    #[default]
    Stages,
    /// The vertex stage, as topology-aware meshes do it: each face asks its neighbours, and one with an outline edge is
    /// drawn larger.
    Faces,
    /// The vertex stage too, from a stream that holds the normals across the edges of each face at rest: that of Valient and
    /// Bujnak (2005). Casters that bring positions of their own, such as skins and morphs, are in the shadow map alone, and
    /// edges of more than two faces may be drawn without being an outline.
    Stream(StreamPrecision),
}

/// The floats of a topology-aware stream.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum StreamPrecision {
    /// 32 bits: 72 bytes a face.
    #[default]
    Bits32,
    /// 16 bits: 36 bytes a face. Coordinates are off by up to 1/2048 of themselves, from the mesh's origin or, where that is
    /// far away, from its middle. Small faces turn with them, so both faces at an edge draw it, in case that one of them
    /// misses it. Needs a device that unpacks 16-bit floats: all but old OpenGL do.
    Bits16,
}

impl StreamPrecision {
    /// Both.
    pub const ALL: [Self; 2] = [Self::Bits16, Self::Bits32];

    /// How many bits a float has.
    pub const fn bits(self) -> u8 {
        match self {
            Self::Bits16 => 16,
            Self::Bits32 => 32,
        }
    }
}

impl SilhouetteSource {
    /// All of them.
    pub const ALL: [Self; 4] =
        [Self::Stages, Self::Faces, Self::Stream(StreamPrecision::Bits32), Self::Stream(StreamPrecision::Bits16)];
}

/// How the nearest of the silhouettes around a texel wins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum SilhouetteWinner {
    /// Fragments write how far the silhouette is as their depth, and the depth test keeps the nearest one's distance and
    /// depth. No fragment can be dropped before it ran.
    #[default]
    ByDepth,
    /// Blending keeps the least distance and the least depth, each for itself: of another silhouette the depth may be, and no
    /// sign is kept. There is no depth buffer. Needs a device that blends 32-bit floats, or depth in 16 bits; else it is
    /// as by depth.
    ByBlending,
}

/// How a soft edge goes from dark to lit across a penumbra.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum EdgeProfile {
    /// By the same amount everywhere.
    Linear,
    /// By the part of a disk that a straight edge leaves free: slowly, fast, and slowly again, nearly like a cosine.
    #[default]
    Disk,
}

impl SilhouetteMapSettings {
    /// The defaults of `silhouette-map`.
    pub const DEFAULT: Self = Self {
        source: SilhouetteSource::Stages,
        edge_texels: 0.5,
        width_max_ndc: 0.1,
        samples: 8,
        profile: EdgeProfile::Disk,
        winner: SilhouetteWinner::ByDepth,
    };

    /// The defaults of `silhouette-map-tam`.
    pub const TAM: Self = Self { source: SilhouetteSource::Faces, ..Self::DEFAULT };

    /// The defaults of `silhouette-map-stream`.
    pub const STREAM: Self = Self { source: SilhouetteSource::Stream(StreamPrecision::Bits32), ..Self::DEFAULT };

    /// How far from a silhouette distances are drawn at least, in texels: half the hardest edge and a texel's diagonal, so
    /// that all four texels around a place on that edge hold one (Valient and Bujnak 2005, `w_sc`).
    pub(crate) fn least_reach_texels(&self) -> f32 {
        0.5 * self.edge_texels + SQRT_2
    }
}

impl Default for SilhouetteMapSettings {
    fn default() -> Self {
        Self::DEFAULT
    }
}
