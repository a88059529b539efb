use contrejour_plan::{BufferKind, Stage};

use super::{ComputeStage, Dispatch};
use crate::wgsl::wgsl;

/// Listed blocks to the dispatches and the draws over them.
pub(super) const WRITE_ITEM_ARGS: ComputeStage = ComputeStage {
    stage: Stage::WriteItemArgs,
    wgsl: wgsl!(
        "compute/write_item_args",
        "topology",
        "light",
        "bundle",
        "args",
        "seat_counters",
        "invocation",
        "group_args"
    ),
    writes: &[BufferKind::ItemArgs, BufferKind::DrawArgs],
    dispatch: Dispatch::Once,
};
