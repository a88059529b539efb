use contrejour_plan::{BufferKind, Stage};

use super::{ComputeStage, Dispatch};
use crate::wgsl::wgsl;

/// Undecided faces by full integers.
pub(super) const RESOLVE_FACES: ComputeStage = ComputeStage {
    stage: Stage::ResolveFaces,
    wgsl: wgsl!(
        "compute/resolve_faces",
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
    dispatch: Dispatch::Indirect(BufferKind::RefineArgs, 1),
};
