use contrejour_plan::{Pass, TextureKind};

use super::{ClearColor, ColorTarget, DepthTarget, DrawCount, MapPass};
use crate::wgsl::wgsl;

/// Hardware depth and linear depth of every caster.
pub(super) const SHADOW_MAP: MapPass = MapPass {
    pass: Pass::ShadowMap,
    wgsl: wgsl!("raster/shadow_map", "topology", "light", "caster_position", "view_depth"),
    reads_shadow_depth: false,
    draws: &[DrawCount::FaceItems],
    color: Some(ColorTarget { texture: TextureKind::ShadowDepth, clear: ClearColor::FarDepth, minimum: false }),
    depth: Some(DepthTarget { texture: TextureKind::ShadowHardwareDepth, is_kept: false }),
};
