use contrejour_plan::{Pass, TextureKind};

use super::{ClearColor, ColorTarget, MapPass, SMOOTHIE_DRAWS, SMOOTHIE_WGSL};

/// Nearest smoothie depth and least alpha at once, where the device blends 32-bit floats.
pub(super) const SMOOTHIE_BUFFER: MapPass = MapPass {
    pass: Pass::SmoothieBuffer,
    wgsl: SMOOTHIE_WGSL,
    reads_shadow_depth: true,
    draws: SMOOTHIE_DRAWS,
    color: Some(ColorTarget { texture: TextureKind::SmoothieBuffer, clear: ClearColor::FarDepthAndLit, minimum: true }),
    depth: None,
};
