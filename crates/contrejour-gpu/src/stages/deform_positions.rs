use contrejour_plan::SceneStage;

use super::SceneComputeStage;
use crate::wgsl::wgsl;

/// Rest vertices, joints and weights to positions.
pub(super) const DEFORM_POSITIONS: SceneComputeStage = SceneComputeStage {
    stage: SceneStage::DeformPositions,
    wgsl: wgsl!("compute/deform_positions", "deform", "invocation"),
};
