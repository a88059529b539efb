use contrejour_plan::{Pass, TextureKind};

use super::{DepthTarget, MapPass, SMOOTHIE_DRAWS, SMOOTHIE_WGSL};

/// Nearest smoothie depth, in a hardware depth buffer.
pub(super) const SMOOTHIE_DEPTH: MapPass = MapPass {
    pass: Pass::SmoothieDepth,
    wgsl: SMOOTHIE_WGSL,
    reads_shadow_depth: true,
    draws: SMOOTHIE_DRAWS,
    color: None,
    depth: Some(DepthTarget { texture: TextureKind::SmoothieDepth, is_kept: true }),
};
