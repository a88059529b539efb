use contrejour_plan::{BufferKind, Stage};

use super::{ComputeStage, Dispatch};
use crate::wgsl::wgsl;

/// Blocks of all casters to those of the ones that cast: to draw for each view, to test for all together.
pub(super) const LIST_BLOCKS: ComputeStage = ComputeStage {
    stage: Stage::ListBlocks,
    wgsl: wgsl!(
        "compute/list_blocks",
        "topology",
        "light",
        "bundle",
        "invocation",
        "append",
        "append_seats",
        "atomic_counters",
        "atomic_seat_counters"
    ),
    writes: &[BufferKind::FaceItems, BufferKind::FaceTests, BufferKind::EdgeTests, BufferKind::Counters],
    dispatch: Dispatch::Blocks,
};
