use contrejour_plan::{Pass, TextureKind};

use super::{ClearColor, ColorTarget, DepthKept, DepthTarget, DrawCount, Levels, MapPass, blended};
use crate::wgsl::wgsl;

/// Signed distance to silhouettes and their depth, from quads.
pub(super) const SILHOUETTE_MAP: MapPass = MapPass {
    pass: Pass::SilhouetteMap,
    wgsl: wgsl!(
        "raster/silhouette_map",
        "topology",
        "light",
        "light_outline",
        "args",
        "outline",
        "quad_corner",
        "caster_position",
        "image_plane",
        "outline_end",
        "power_of_two",
        "view_depth",
        "nowhere",
        "silhouette_point"
    ),
    reads: Some(TextureKind::ShadowDepth),
    draws: &[DrawCount::Indirect(1)],
    levels: Levels::First,
    color: Some(ColorTarget { texture: TextureKind::SilhouetteMap, clear: ClearColor::FarDepth, minimum: false }),
    depth: Some(DepthTarget { texture: TextureKind::SilhouetteOrder, is_drawn: false, kept: DepthKept::Never }),
};

/// Least distance to silhouettes and their least depth, from quads.
pub(super) const BLENDED_SILHOUETTE_MAP: MapPass = blended(Pass::BlendedSilhouetteMap, SILHOUETTE_MAP);
