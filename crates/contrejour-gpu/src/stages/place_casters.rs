use contrejour_plan::{BufferKind, Stage};

use super::{ComputeStage, Dispatch};
use crate::wgsl::wgsl;

/// Where casters stand to the lights as each sees them.
pub(super) const PLACE_CASTERS: ComputeStage = ComputeStage {
    stage: Stage::PlaceCasters,
    wgsl: wgsl!(
        "compute/place_casters",
        "topology",
        "light",
        "bundle",
        "place",
        "invocation",
        "atomic_counters",
        "atomic_seat_counters",
        "float64",
        "wide_integer"
    ),
    writes: &[BufferKind::CasterLights, BufferKind::Counters],
    dispatch: Dispatch::Casters,
};
