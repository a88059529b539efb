//! The raster passes.

use super::BufferKind::{self, *};
use super::TextureKind;

/// A raster pass, named for what it fills.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Pass {
    /// Hardware depth of every caster, where nobody reads linear depth.
    HardwareShadowMap,
    /// Linear depth of every caster, by the hardware's depth test.
    ShadowMap,
    /// Hardware depth of the faces that a mask cuts, over that of all others.
    MaskedHardwareShadowMap,
    /// Linear depth of the faces that a mask cuts, over that of all others.
    MaskedShadowMap,
    /// Moments of the shadow map's depth: the first level.
    Moments,
    /// Moments, blurred and halved level by level.
    BlurredMoments,
    /// Nearest smoothie depth, by the hardware's depth test. The first of two.
    SmoothieDepth,
    /// Least smoothie alpha, in 16-bit floats. The second of two.
    SmoothieAlpha,
    /// Nearest smoothie depth and least alpha at once, where the device blends 32-bit floats.
    SmoothieBuffer,
    /// Signed distance to silhouettes and their depth, from quads.
    SilhouetteMap,
    /// The same, from faces that the vertex stage finds to have outline edges.
    SilhouetteMapTam,
    /// The same, from a stream of faces that brings the normals of their neighbours.
    SilhouetteMapStream,
    /// The same, from a stream of 16-bit floats.
    SilhouetteMapHalfStream,
    /// Least distance to silhouettes and their least depth, from quads.
    BlendedSilhouetteMap,
    /// The same, from faces that the vertex stage finds to have outline edges.
    BlendedSilhouetteMapTam,
    /// The same, from a stream of faces that brings the normals of their neighbours.
    BlendedSilhouetteMapStream,
    /// The same, from a stream of 16-bit floats.
    BlendedSilhouetteMapHalfStream,
    /// Visibility of each pixel of the caller's depth buffer, in a target of the caller's.
    Visibility,
}

impl Pass {
    /// All passes in the order in which a frame runs them.
    pub const ALL: [Self; 18] = [
        Self::HardwareShadowMap,
        Self::ShadowMap,
        Self::MaskedHardwareShadowMap,
        Self::MaskedShadowMap,
        Self::Moments,
        Self::BlurredMoments,
        Self::SmoothieDepth,
        Self::SmoothieAlpha,
        Self::SmoothieBuffer,
        Self::SilhouetteMap,
        Self::SilhouetteMapTam,
        Self::SilhouetteMapStream,
        Self::SilhouetteMapHalfStream,
        Self::BlendedSilhouetteMap,
        Self::BlendedSilhouetteMapTam,
        Self::BlendedSilhouetteMapStream,
        Self::BlendedSilhouetteMapHalfStream,
        Self::Visibility,
    ];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::HardwareShadowMap => "hardware_shadow_map",
            Self::ShadowMap => "shadow_map",
            Self::MaskedHardwareShadowMap => "masked_hardware_shadow_map",
            Self::MaskedShadowMap => "masked_shadow_map",
            Self::Moments => "moments",
            Self::BlurredMoments => "blurred_moments",
            Self::SmoothieDepth => "smoothie_depth",
            Self::SmoothieAlpha => "smoothie_alpha",
            Self::SmoothieBuffer => "smoothie_buffer",
            Self::SilhouetteMap => "silhouette_map",
            Self::SilhouetteMapTam => "silhouette_map_tam",
            Self::SilhouetteMapStream => "silhouette_map_stream",
            Self::SilhouetteMapHalfStream => "silhouette_map_half_stream",
            Self::BlendedSilhouetteMap => "blended_silhouette_map",
            Self::BlendedSilhouetteMapTam => "blended_silhouette_map_tam",
            Self::BlendedSilhouetteMapStream => "blended_silhouette_map_stream",
            Self::BlendedSilhouetteMapHalfStream => "blended_silhouette_map_half_stream",
            Self::Visibility => "visibility",
        }
    }

    /// The buffers that its shaders bind, and the draw arguments.
    pub const fn buffers(self) -> &'static [BufferKind] {
        match self {
            Self::HardwareShadowMap | Self::ShadowMap => {
                &[LightView, FaceItems, Casters, CasterLights, Faces, Positions, DrawArgs]
            }
            Self::MaskedHardwareShadowMap | Self::MaskedShadowMap => {
                &[LightView, FaceItems, Casters, CasterLights, Faces, Positions, Masks, MaskWords, DrawArgs]
            }
            Self::Moments => &[LightView],
            Self::BlurredMoments => &[],
            Self::SmoothieDepth | Self::SmoothieAlpha | Self::SmoothieBuffer => &[LightView, Quads, Corners, DrawArgs],
            Self::SilhouetteMap | Self::BlendedSilhouetteMap => {
                &[LightView, Quads, Casters, CasterLights, Positions, OutlineSides, VertexEdges, DrawArgs]
            }
            Self::SilhouetteMapTam | Self::BlendedSilhouetteMapTam => {
                &[LightView, FaceItems, Casters, CasterLights, Faces, FaceNeighbours, EdgeFans, Positions, DrawArgs]
            }
            Self::SilhouetteMapStream | Self::BlendedSilhouetteMapStream => {
                &[LightView, FaceItems, Casters, CasterLights, StreamFaces, DrawArgs]
            }
            Self::SilhouetteMapHalfStream | Self::BlendedSilhouetteMapHalfStream => {
                &[LightView, FaceItems, Casters, CasterLights, HalfStreamFaces, DrawArgs]
            }
            Self::Visibility => &[ReceiverView],
        }
    }

    /// The textures of the light view that it fills.
    pub const fn fills(self) -> &'static [TextureKind] {
        match self {
            Self::HardwareShadowMap => &[TextureKind::ShadowHardwareDepth],
            Self::ShadowMap => &[TextureKind::ShadowDepth, TextureKind::ShadowHardwareDepth],
            Self::Moments => &[TextureKind::Moments],
            Self::SmoothieDepth => &[TextureKind::SmoothieDepth],
            Self::SmoothieAlpha => &[TextureKind::SmoothieAlpha],
            Self::SmoothieBuffer => &[TextureKind::SmoothieBuffer],
            Self::SilhouetteMap
            | Self::SilhouetteMapTam
            | Self::SilhouetteMapStream
            | Self::SilhouetteMapHalfStream => &[TextureKind::SilhouetteMap, TextureKind::SilhouetteOrder],
            Self::BlendedSilhouetteMap
            | Self::BlendedSilhouetteMapTam
            | Self::BlendedSilhouetteMapStream
            | Self::BlendedSilhouetteMapHalfStream => &[TextureKind::SilhouetteMap],
            // Its levels are those of the texture that the pass before made.
            Self::BlurredMoments | Self::Visibility => &[],
            // They draw over what the pass before made.
            Self::MaskedHardwareShadowMap | Self::MaskedShadowMap => &[],
        }
    }

    /// Whether it draws the casters that no mask cuts.
    pub const fn fills_shadow_map(self) -> bool {
        matches!(self, Self::HardwareShadowMap | Self::ShadowMap)
    }

    /// Whether it fills the silhouette map.
    pub fn fills_silhouette_map(self) -> bool {
        self.fills().contains(&TextureKind::SilhouetteMap)
    }

    /// Whether it draws quads and corners.
    pub const fn draws_smoothies(self) -> bool {
        matches!(self, Self::SmoothieDepth | Self::SmoothieAlpha | Self::SmoothieBuffer)
    }
}
