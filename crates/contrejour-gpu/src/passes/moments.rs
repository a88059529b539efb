use contrejour_plan::{Pass, TextureKind};

use super::{ClearColor, ColorTarget, DrawCount, Levels, MapPass};
use crate::wgsl::wgsl;

/// Moments of the shadow map's depth: the first level.
pub(super) const MOMENTS: MapPass = MapPass {
    pass: Pass::Moments,
    wgsl: wgsl!("raster/moments", "light", "warp", "full_screen"),
    reads: Some(TextureKind::ShadowDepth),
    draws: &[DrawCount::FullScreen],
    levels: Levels::First,
    color: Some(ColorTarget { texture: TextureKind::Moments, clear: ClearColor::Nothing, minimum: false }),
    depth: None,
};
