use contrejour_plan::{Pass, TextureKind};

use super::{ClearColor, ColorTarget, DepthKept, DepthTarget, DrawCount, Levels, MASKED_SHADOW_MAP_WGSL, MapPass};

/// Linear depth of the faces that a mask cuts, over that of all others.
pub(super) const MASKED_SHADOW_MAP: MapPass = MapPass {
    pass: Pass::MaskedShadowMap,
    wgsl: MASKED_SHADOW_MAP_WGSL,
    reads: None,
    draws: &[DrawCount::Indirect(3)],
    levels: Levels::First,
    color: Some(ColorTarget { texture: TextureKind::ShadowDepth, clear: ClearColor::Drawn, minimum: false }),
    depth: Some(DepthTarget { texture: TextureKind::ShadowHardwareDepth, is_drawn: true, kept: DepthKept::Never }),
};
