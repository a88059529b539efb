use contrejour_plan::{BufferKind, Stage};

use super::{ComputeStage, Dispatch};
use crate::wgsl::wgsl;

/// Counts to indirect draws.
pub(super) const WRITE_DRAW_ARGS: ComputeStage = ComputeStage {
    stage: Stage::WriteDrawArgs,
    wgsl: wgsl!("compute/write_draw_args", "light", "args"),
    writes: &[BufferKind::DrawArgs],
    dispatch: Dispatch::Once,
};
