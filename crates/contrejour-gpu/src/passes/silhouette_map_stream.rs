use contrejour_plan::Pass;

use super::silhouette_map_tam::{SILHOUETTE_MAP_TAM, silhouette_faces_wgsl};
use super::{MapPass, blended};

/// Signed distance to silhouettes and their depth, from a stream of faces that brings the normals of their neighbours.
pub(super) const SILHOUETTE_MAP_STREAM: MapPass = MapPass {
    pass: Pass::SilhouetteMapStream,
    wgsl: silhouette_faces_wgsl!("raster/silhouette_map_stream", "stream_face"),
    ..SILHOUETTE_MAP_TAM
};

/// The same, from a stream of 16-bit floats.
pub(super) const SILHOUETTE_MAP_HALF_STREAM: MapPass = MapPass {
    pass: Pass::SilhouetteMapHalfStream,
    wgsl: silhouette_faces_wgsl!("raster/silhouette_map_stream", "half_stream_face"),
    ..SILHOUETTE_MAP_TAM
};

/// Least distance to silhouettes and their least depth, from such a stream.
pub(super) const BLENDED_SILHOUETTE_MAP_STREAM: MapPass =
    blended(Pass::BlendedSilhouetteMapStream, SILHOUETTE_MAP_STREAM);

/// The same, from a stream of 16-bit floats.
pub(super) const BLENDED_SILHOUETTE_MAP_HALF_STREAM: MapPass =
    blended(Pass::BlendedSilhouetteMapHalfStream, SILHOUETTE_MAP_HALF_STREAM);
