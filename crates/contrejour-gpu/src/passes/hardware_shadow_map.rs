use contrejour_plan::{Pass, TextureKind};

use super::{DepthKept, DepthTarget, DrawCount, Levels, MapPass, SHADOW_MAP_WGSL};

/// Hardware depth of every caster, where nobody reads linear depth.
pub(super) const HARDWARE_SHADOW_MAP: MapPass = MapPass {
    pass: Pass::HardwareShadowMap,
    wgsl: SHADOW_MAP_WGSL,
    reads: None,
    draws: &[DrawCount::Indirect(0)],
    levels: Levels::First,
    color: None,
    depth: Some(DepthTarget { texture: TextureKind::ShadowHardwareDepth, is_drawn: false, kept: DepthKept::Always }),
};
