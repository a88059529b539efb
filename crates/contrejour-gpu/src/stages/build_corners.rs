use contrejour_plan::{BufferKind, Stage};

use super::{ComputeStage, Dispatch};
use crate::wgsl::wgsl;

/// Ends of quads to the wedges between them.
pub(super) const BUILD_CORNERS: ComputeStage = ComputeStage {
    stage: Stage::BuildCorners,
    wgsl: wgsl!(
        "compute/build_corners",
        "topology",
        "light",
        "outline",
        "invocation",
        "append",
        "atomic_counters",
        "caster_position",
        "image_plane",
        "outline_end",
        "power_of_two",
        "view_depth"
    ),
    writes: &[BufferKind::Corners, BufferKind::Counters],
    dispatch: Dispatch::Indirect(BufferKind::ExtrudeArgs, 1),
};
