use contrejour_plan::{Pass, TextureKind};

use super::{ClearColor, ColorTarget, Levels, MapPass, SMOOTHIE_DRAWS, SMOOTHIE_WGSL};

/// Least smoothie alpha, in 16-bit float.
pub(super) const SMOOTHIE_ALPHA: MapPass = MapPass {
    pass: Pass::SmoothieAlpha,
    wgsl: SMOOTHIE_WGSL,
    reads: Some(TextureKind::ShadowDepth),
    draws: SMOOTHIE_DRAWS,
    levels: Levels::First,
    color: Some(ColorTarget { texture: TextureKind::SmoothieAlpha, clear: ClearColor::Lit, minimum: true }),
    depth: None,
};
