//! Silhouette edges, found on the device or on the CPU.

use std::sync::Arc;

use contrejour_gpu::{CasterInput, FrameInput, Positions, ShadowOptions, Shadows, Untimed};
use contrejour_layout::SilhouetteEdge;
use contrejour_plan::{Light, Outputs};
use contrejour_render::{Gpu, read_silhouettes};

use super::found::PlacedMesh;
use crate::failure::Failure;
use crate::output::warn;

/// Runs the compute stages, and nothing else, on the device.
pub fn on_gpu(placed: &[PlacedMesh<'_>], light: &Light) -> Result<Vec<SilhouetteEdge>, Failure> {
    let gpu = Gpu::open()?;
    let options = ShadowOptions { outputs: Outputs::Silhouettes, ..ShadowOptions::default() };
    let mut shadows = Shadows::new(&gpu.device, &options)?;
    let mut casters = Vec::new();
    for placed in placed {
        casters.push(CasterInput {
            mesh: shadows.add_mesh(Arc::clone(&placed.topology))?,
            world_from_object: placed.world_from_object,
            positions: Positions::OfMesh,
        });
    }
    shadows.prepare(&gpu.device, &gpu.queue, &FrameInput { light, casters: &casters })?;
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    shadows.encode(&mut encoder, &mut Untimed);
    gpu.queue.submit([encoder.finish()]);
    warn_of_singular_casters(shadows.stats().singular_casters);
    Ok(read_silhouettes(&gpu, &shadows)?)
}

fn warn_of_singular_casters(count: u32) {
    if count > 0 {
        warn(&format!("{count} nodes have a matrix without an inverse for this light, so they have no silhouette"));
    }
}
