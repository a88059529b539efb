use contrejour_plan::{Pass, TextureKind};

use super::{ClearColor, ColorTarget, Levels, MapPass, SMOOTHIE_DRAWS, SMOOTHIE_WGSL};

/// Nearest smoothie depth and least alpha at once, where the device blends floats of the buffer's size.
pub(super) const SMOOTHIE_BUFFER: MapPass = MapPass {
    pass: Pass::SmoothieBuffer,
    wgsl: SMOOTHIE_WGSL,
    reads: Some(TextureKind::ShadowDepth),
    draws: SMOOTHIE_DRAWS,
    levels: Levels::First,
    color: Some(ColorTarget { texture: TextureKind::SmoothieBuffer, clear: ClearColor::FarDepthAndLit, minimum: true }),
    depth: None,
};
