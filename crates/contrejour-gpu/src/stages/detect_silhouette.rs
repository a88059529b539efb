use contrejour_plan::{BufferKind, Stage};

use super::{ComputeStage, Dispatch};
use crate::wgsl::wgsl;

/// Lit bits to the lists of silhouette edges.
pub(super) const DETECT_SILHOUETTE: ComputeStage = ComputeStage {
    stage: Stage::DetectSilhouette,
    wgsl: wgsl!(
        "compute/detect_silhouette",
        "topology",
        "light",
        "bundle",
        "outline",
        "invocation",
        "append_seats",
        "atomic_counters",
        "atomic_seat_counters"
    ),
    writes: &[BufferKind::Silhouettes, BufferKind::OutlineSides, BufferKind::Counters],
    dispatch: Dispatch::Indirect(BufferKind::ItemArgs, 1),
};
