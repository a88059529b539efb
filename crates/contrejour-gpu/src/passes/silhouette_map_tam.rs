use contrejour_plan::{Pass, TextureKind};

use super::{ClearColor, ColorTarget, DepthKept, DepthTarget, DrawCount, Levels, MapPass, blended};
use crate::wgsl::wgsl;

/// Signed distance to silhouettes and their depth, from faces that the vertex stage finds to have outline edges.
pub(super) const SILHOUETTE_MAP_TAM: MapPass = MapPass {
    pass: Pass::SilhouetteMapTam,
    wgsl: wgsl!(
        "raster/silhouette_map_tam",
        "topology",
        "light",
        "light_outline",
        "caster_position",
        "image_plane",
        "edge_image",
        "power_of_two",
        "view_depth",
        "nowhere",
        "silhouette_point",
        "silhouette_face"
    ),
    reads: Some(TextureKind::ShadowDepth),
    draws: &[DrawCount::Indirect(0)],
    levels: Levels::First,
    color: Some(ColorTarget { texture: TextureKind::SilhouetteMap, clear: ClearColor::FarDepth, minimum: false }),
    depth: Some(DepthTarget { texture: TextureKind::SilhouetteOrder, is_drawn: false, kept: DepthKept::Never }),
};

/// Least distance to silhouettes and their least depth, from faces that the vertex stage finds to have outline edges.
pub(super) const BLENDED_SILHOUETTE_MAP_TAM: MapPass = blended(Pass::BlendedSilhouetteMapTam, SILHOUETTE_MAP_TAM);
