use contrejour_plan::{BufferKind, Stage};

use super::{ComputeStage, Dispatch};
use crate::wgsl::wgsl;

/// Undecided faces by short integers.
pub(super) const REFINE_FACES: ComputeStage = ComputeStage {
    stage: Stage::RefineFaces,
    wgsl: wgsl!(
        "compute/refine_faces",
        "topology",
        "light",
        "bundle",
        "outline",
        "args",
        "seat_counters",
        "invocation",
        "facing",
        "wide_integer"
    ),
    writes: &[BufferKind::Lit],
    dispatch: Dispatch::Indirect(BufferKind::RefineArgs, 0),
};
