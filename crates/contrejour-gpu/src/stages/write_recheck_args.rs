use contrejour_plan::{BufferKind, Stage};

use super::{ComputeStage, Dispatch};
use crate::wgsl::wgsl;

/// Words with faces to recheck to workgroups over those faces.
pub(super) const WRITE_RECHECK_ARGS: ComputeStage = ComputeStage {
    stage: Stage::WriteRecheckArgs,
    wgsl: wgsl!(
        "compute/write_recheck_args",
        "topology",
        "light",
        "bundle",
        "args",
        "seat_counters",
        "invocation",
        "group_args"
    ),
    writes: &[BufferKind::RecheckArgs],
    dispatch: Dispatch::Once,
};
