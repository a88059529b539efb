use contrejour_plan::{Pass, TextureKind};

use super::{ClearColor, ColorTarget, DepthKept, DepthTarget, DrawCount, Levels, MapPass, SHADOW_MAP_WGSL};

/// Linear depth of every caster, by the hardware's depth test.
pub(super) const SHADOW_MAP: MapPass = MapPass {
    pass: Pass::ShadowMap,
    wgsl: SHADOW_MAP_WGSL,
    reads: None,
    draws: &[DrawCount::Indirect(0)],
    levels: Levels::First,
    color: Some(ColorTarget { texture: TextureKind::ShadowDepth, clear: ClearColor::FarDepth, minimum: false }),
    depth: Some(DepthTarget {
        texture: TextureKind::ShadowHardwareDepth,
        is_drawn: false,
        kept: DepthKept::Before(Pass::MaskedShadowMap),
    }),
};
