use contrejour_plan::{BufferKind, Stage};

use super::{ComputeStage, Dispatch};
use crate::wgsl::wgsl;

/// Faces that planes leave undecided, by positions where the bound allows; the others are listed.
pub(super) const RECHECK_FACES: ComputeStage = ComputeStage {
    stage: Stage::RecheckFaces,
    wgsl: wgsl!(
        "compute/recheck_faces",
        "topology",
        "light",
        "bundle",
        "outline",
        "invocation",
        "facing",
        "atomic_counters",
        "atomic_seat_counters"
    ),
    writes: &[BufferKind::Lit, BufferKind::Undecided, BufferKind::Counters],
    dispatch: Dispatch::Indirect(BufferKind::RecheckArgs, 0),
};
