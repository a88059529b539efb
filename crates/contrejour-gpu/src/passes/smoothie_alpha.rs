use contrejour_plan::{Pass, TextureKind};

use super::{ClearColor, ColorTarget, MapPass, SMOOTHIE_DRAWS, SMOOTHIE_WGSL};

/// Least smoothie alpha, in 16-bit float.
pub(super) const SMOOTHIE_ALPHA: MapPass = MapPass {
    pass: Pass::SmoothieAlpha,
    wgsl: SMOOTHIE_WGSL,
    reads_shadow_depth: true,
    draws: SMOOTHIE_DRAWS,
    color: Some(ColorTarget { texture: TextureKind::SmoothieAlpha, clear: ClearColor::Lit, minimum: true }),
    depth: None,
};
