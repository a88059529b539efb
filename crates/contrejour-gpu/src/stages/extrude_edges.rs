use contrejour_plan::{BufferKind, Stage};

use super::{ComputeStage, Dispatch};
use crate::wgsl::wgsl;

/// Outline edges to quads on the image plane.
pub(super) const EXTRUDE_EDGES: ComputeStage = ComputeStage {
    stage: Stage::ExtrudeEdges,
    wgsl: wgsl!(
        "compute/extrude_edges",
        "topology",
        "light",
        "light_outline",
        "outline",
        "invocation",
        "append",
        "atomic_counters",
        "caster_position",
        "image_plane",
        "edge_image",
        "power_of_two",
        "view_depth"
    ),
    writes: &[BufferKind::Quads, BufferKind::Counters],
    dispatch: Dispatch::Indirect(BufferKind::ExtrudeArgs, 0),
};
