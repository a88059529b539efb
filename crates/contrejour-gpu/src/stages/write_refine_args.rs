use contrejour_plan::{BufferKind, Stage};

use super::{ComputeStage, Dispatch};
use crate::wgsl::wgsl;

/// Undecided faces to workgroups of the two exact tiers.
pub(super) const WRITE_REFINE_ARGS: ComputeStage = ComputeStage {
    stage: Stage::WriteRefineArgs,
    wgsl: wgsl!(
        "compute/write_refine_args",
        "topology",
        "light",
        "bundle",
        "args",
        "seat_counters",
        "invocation",
        "group_args"
    ),
    writes: &[BufferKind::RefineArgs],
    dispatch: Dispatch::Once,
};
