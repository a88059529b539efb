use contrejour_plan::{BufferKind, Stage};

use super::{ComputeStage, Dispatch};
use crate::wgsl::wgsl;

/// Work items to the dispatches and the draw over them.
pub(super) const WRITE_ITEM_ARGS: ComputeStage = ComputeStage {
    stage: Stage::WriteItemArgs,
    wgsl: wgsl!("compute/write_item_args", "topology", "light", "args", "invocation", "group_args"),
    writes: &[BufferKind::ItemArgs, BufferKind::DrawArgs],
    dispatch: Dispatch::Once,
};
