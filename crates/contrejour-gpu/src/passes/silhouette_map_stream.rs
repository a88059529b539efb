use contrejour_plan::Pass;

use super::silhouette_map_tam::SILHOUETTE_MAP_TAM;
use super::{MapPass, blended};
use crate::wgsl::wgsl;

/// The text with a way to read faces.
macro_rules! stream_wgsl {
    ($stream_face:literal) => {
        wgsl!(
            "raster/silhouette_map_stream",
            $stream_face,
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

/// Signed distance to silhouettes and their depth, from a stream of faces that brings the normals of their neighbours.
pub(super) const SILHOUETTE_MAP_STREAM: MapPass =
    MapPass { pass: Pass::SilhouetteMapStream, wgsl: stream_wgsl!("stream_face"), ..SILHOUETTE_MAP_TAM };

/// The same, from a stream of 16-bit floats.
pub(super) const SILHOUETTE_MAP_HALF_STREAM: MapPass =
    MapPass { pass: Pass::SilhouetteMapHalfStream, wgsl: stream_wgsl!("half_stream_face"), ..SILHOUETTE_MAP_TAM };

/// Least distance to silhouettes and their least depth, from such a stream.
pub(super) const BLENDED_SILHOUETTE_MAP_STREAM: MapPass =
    blended(Pass::BlendedSilhouetteMapStream, SILHOUETTE_MAP_STREAM);

/// The same, from a stream of 16-bit floats.
pub(super) const BLENDED_SILHOUETTE_MAP_HALF_STREAM: MapPass =
    blended(Pass::BlendedSilhouetteMapHalfStream, SILHOUETTE_MAP_HALF_STREAM);
