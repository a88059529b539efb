use contrejour_plan::{Pass, TextureKind};

use super::{DepthKept, DepthTarget, DrawCount, Levels, MASKED_SHADOW_MAP_WGSL, MapPass};

/// Hardware depth of the faces that a mask cuts, over that of all others.
pub(super) const MASKED_HARDWARE_SHADOW_MAP: MapPass = MapPass {
    pass: Pass::MaskedHardwareShadowMap,
    wgsl: MASKED_SHADOW_MAP_WGSL,
    reads: None,
    draws: &[DrawCount::Indirect(3)],
    levels: Levels::First,
    color: None,
    depth: Some(DepthTarget { texture: TextureKind::ShadowHardwareDepth, is_drawn: true, kept: DepthKept::Always }),
};
