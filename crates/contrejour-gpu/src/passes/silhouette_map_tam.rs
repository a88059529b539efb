use contrejour_plan::{Pass, TextureKind};

use super::{ClearColor, ColorTarget, DepthKept, DepthTarget, DrawCount, Levels, MapPass, blended};

/// The text of a pass that draws faces which bring their outline edges, with what reads those.
macro_rules! silhouette_faces_wgsl {
    ($file:literal, $reader:literal) => {
        $crate::wgsl::wgsl!(
            $file,
            $reader,
            "topology",
            "light",
            "light_outline",
            "image_plane",
            "edge_image",
            "power_of_two",
            "view_depth",
            "nowhere",
            "silhouette_point",
            "silhouette_face"
        )
    };
}
pub(super) use silhouette_faces_wgsl;

/// Signed distance to silhouettes and their depth, from faces that the vertex stage finds to have outline edges.
pub(super) const SILHOUETTE_MAP_TAM: MapPass = MapPass {
    pass: Pass::SilhouetteMapTam,
    wgsl: silhouette_faces_wgsl!("raster/silhouette_map_tam", "caster_position"),
    reads: Some(TextureKind::ShadowDepth),
    draws: &[DrawCount::Indirect(0)],
    levels: Levels::First,
    color: Some(ColorTarget { texture: TextureKind::SilhouetteMap, clear: ClearColor::FarDepth, minimum: false }),
    depth: Some(DepthTarget { texture: TextureKind::SilhouetteOrder, is_drawn: false, kept: DepthKept::Never }),
};

/// Least distance to silhouettes and their least depth, from faces that the vertex stage finds to have outline edges.
pub(super) const BLENDED_SILHOUETTE_MAP_TAM: MapPass = blended(Pass::BlendedSilhouetteMapTam, SILHOUETTE_MAP_TAM);
