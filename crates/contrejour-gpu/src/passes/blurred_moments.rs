use contrejour_plan::{Pass, TextureKind};

use super::{ClearColor, ColorTarget, DrawCount, Levels, MapPass};
use crate::wgsl::wgsl;

/// Moments, blurred and halved level by level: reads the level before the one that it fills.
pub(super) const BLURRED_MOMENTS: MapPass = MapPass {
    pass: Pass::BlurredMoments,
    wgsl: wgsl!("raster/blurred_moments", "full_screen"),
    reads: Some(TextureKind::Moments),
    draws: &[DrawCount::FullScreen],
    levels: Levels::AllButFirst,
    color: Some(ColorTarget { texture: TextureKind::Moments, clear: ClearColor::Nothing, minimum: false }),
    depth: None,
};
