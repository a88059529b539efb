use contrejour_plan::{BufferKind, Stage};

use super::{ComputeStage, Dispatch};
use crate::wgsl::wgsl;

/// One lit bit for each face and view, by its stored plane where the bound allows; the others are listed by words.
pub(super) const CLASSIFY_FACES: ComputeStage = ComputeStage {
    stage: Stage::ClassifyFaces,
    wgsl: wgsl!(
        "compute/classify_faces",
        "topology",
        "light",
        "bundle",
        "outline",
        "invocation",
        "atomic_counters",
        "atomic_seat_counters"
    ),
    writes: &[BufferKind::Lit, BufferKind::RecheckWords, BufferKind::Counters],
    dispatch: Dispatch::Indirect(BufferKind::ItemArgs, 0),
};
