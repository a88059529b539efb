//! Maps against those of a scene that knows nothing of the frames before.

use contrejour_gpu::{LightHandle, Shadows};
use contrejour_render::{Gpu, read_rows};

use super::Verifier;
use crate::stress::error::StressError;
use crate::stress::run::settle;
use crate::stress::world::Placed;

impl Verifier<'_> {
    /// Holds the maps of each light against those drawn from scratch.
    pub(super) fn check_maps(&mut self, gpu: &Gpu, placed: &Placed, frame: u64) -> Result<(), StressError> {
        let mut scratch = self.world.place(gpu, frame)?;
        settle(gpu, &mut scratch)?;
        for (index, (light, anew)) in placed.lights.iter().zip(&scratch.lights).enumerate() {
            if maps(gpu, &placed.shadows, *light)? != maps(gpu, &scratch.shadows, *anew)? {
                self.differ(&format!("frame {frame}, light {index}: its maps are not those drawn from scratch"));
            }
        }
        Ok(())
    }
}

/// All texels that receivers look up.
fn maps(gpu: &Gpu, shadows: &Shadows, light: LightHandle) -> Result<Vec<u8>, StressError> {
    let maps = shadows.maps(light);
    let kinds = shadows.plan(light).and_then(|plan| plan.visibility).map_or(&[][..], |kind| kind.textures());
    let mut bytes = Vec::new();
    for kind in kinds {
        let map = maps.of(*kind).ok_or(StressError::NoMap { map: kind.name() })?;
        let aspect = map.format().has_depth_aspect().then_some(wgpu::TextureAspect::DepthOnly);
        let texel = map.format().block_copy_size(aspect).unwrap_or(4);
        for layer in 0..map.depth_or_array_layers() {
            read_rows(gpu, map, [layer, 0], texel, |row| bytes.extend_from_slice(row))?;
        }
    }
    Ok(bytes)
}
