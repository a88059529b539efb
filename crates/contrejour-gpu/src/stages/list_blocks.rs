use contrejour_plan::{BufferKind, Stage};

use super::{ComputeStage, Dispatch};
use crate::wgsl::wgsl;

/// Blocks of all casters to work items of those that cast.
pub(super) const LIST_BLOCKS: ComputeStage = ComputeStage {
    stage: Stage::ListBlocks,
    wgsl: wgsl!("compute/list_blocks", "topology", "light", "invocation", "append", "atomic_counters"),
    writes: &[BufferKind::FaceItems, BufferKind::EdgeItems, BufferKind::Counters],
    dispatch: Dispatch::Blocks,
};
