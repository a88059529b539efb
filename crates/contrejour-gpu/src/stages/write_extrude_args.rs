use contrejour_plan::{BufferKind, Stage};

use super::{ComputeStage, Dispatch};
use crate::wgsl::wgsl;

/// Silhouette edges to workgroups of the stages that extrude them.
pub(super) const WRITE_EXTRUDE_ARGS: ComputeStage = ComputeStage {
    stage: Stage::WriteExtrudeArgs,
    wgsl: wgsl!("compute/write_extrude_args", "light", "args", "invocation", "group_args"),
    writes: &[BufferKind::ExtrudeArgs],
    dispatch: Dispatch::Once,
};
