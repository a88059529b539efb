use contrejour_plan::{Pass, TextureKind};

use super::{DepthKept, DepthTarget, Levels, MapPass, SMOOTHIE_DRAWS, SMOOTHIE_WGSL};

/// Nearest smoothie depth, in a hardware depth buffer.
pub(super) const SMOOTHIE_DEPTH: MapPass = MapPass {
    pass: Pass::SmoothieDepth,
    wgsl: SMOOTHIE_WGSL,
    reads: Some(TextureKind::ShadowDepth),
    draws: SMOOTHIE_DRAWS,
    levels: Levels::First,
    color: None,
    depth: Some(DepthTarget { texture: TextureKind::SmoothieDepth, is_drawn: false, kept: DepthKept::Always }),
};
