use contrejour_plan::{BufferKind, Stage};

use super::{ComputeStage, Dispatch};
use crate::wgsl::wgsl;

/// One lit bit for each face, by floats where their bound allows; the others are listed.
pub(super) const CLASSIFY_FACES: ComputeStage = ComputeStage {
    stage: Stage::ClassifyFaces,
    wgsl: wgsl!("compute/classify_faces", "topology", "light", "outline", "invocation", "facing", "atomic_counters"),
    writes: &[BufferKind::Lit, BufferKind::Undecided, BufferKind::Counters],
    dispatch: Dispatch::Items(BufferKind::FaceItems),
};
