//! How long the compute stages take on the device: all of them, and none of the passes that fill maps.

use std::sync::Arc;
use std::time::Instant;

use contrejour_gpu::{CasterInput, LightHandle, PassTimer, Positions, ShadowOptions, Shadows};
use contrejour_plan::{Light, ShadowSettings, Stage};
use contrejour_render::{
    CastShadowsError, Contestant, DrawError, Gpu, Judge, NewContestantError, PrepareShadowsError, rocked,
};
use glam::DMat4;

use super::super::super::error::RunError;
use super::super::methods::THIN;
use super::LoneMesh;
use super::lone_mesh::MAP_SIZE;

/// Frames that are drawn again because lists had to grow.
const REPEATS_MAX: usize = 8;

/// A mesh whose stages run under a light that moves.
pub(super) struct DeviceStages {
    light: Light,
    clock: Clock,
    frames: usize,
}

enum Clock {
    /// The sum of the stages' timestamps.
    Timestamps(Box<Contestant>),
    /// From submission to completion of a submission that holds nothing but the stages: timestamps of a software device
    /// tell little of compute passes.
    Wall(Box<StagesAlone>),
}

struct StagesAlone {
    gpu: Gpu,
    shadows: Shadows,
    light: LightHandle,
}

impl DeviceStages {
    pub fn new(gpu: &Gpu, mesh: &LoneMesh) -> Result<Self, RunError> {
        let settings = THIN.settings(&mesh.shadow, MAP_SIZE);
        let clock = if has_clock(gpu) {
            let mut scene = mesh.scene.clone();
            scene.resize([16, 16]);
            Clock::Timestamps(Box::new(Judge::new(gpu.clone(), &scene)?.contestant(&settings)?))
        } else {
            Clock::Wall(Box::new(StagesAlone::new(gpu, mesh, &settings)?))
        };
        Ok(Self { light: mesh.light, clock, frames: 0 })
    }

    /// Time of the stages of one more frame. Unit: milliseconds.
    pub fn time_ms(&mut self) -> Result<f64, RunError> {
        let light = rocked(&self.light, self.frames);
        self.frames += 1;
        let time_ms = match &mut self.clock {
            Clock::Timestamps(contestant) => {
                let passes = contestant.draw(&light)?.passes;
                passes.iter().filter(|pass| is_stage(&pass.name)).map(|pass| pass.gpu_ms).reduce(|sum, ms| sum + ms)
            }
            Clock::Wall(stages) => stages.time_ms(&light)?,
        };
        time_ms.ok_or_else(|| RunError::StoodStill { label: "the torus".to_owned() })
    }
}

/// Whether the device's timestamps tell the time of compute passes.
pub(super) fn has_clock(gpu: &Gpu) -> bool {
    !gpu.is_software() && gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY)
}

fn is_stage(name: &str) -> bool {
    Stage::ALL.iter().any(|stage| stage.name() == name)
}

impl StagesAlone {
    fn new(gpu: &Gpu, mesh: &LoneMesh, settings: &ShadowSettings) -> Result<Self, NewContestantError> {
        let options = ShadowOptions { settings: *settings, ..ShadowOptions::default() };
        let mut shadows = Shadows::new(&gpu.device).map_err(CastShadowsError::from)?;
        let handle = shadows.add_mesh(Arc::clone(&mesh.topology)).map_err(CastShadowsError::from)?;
        let caster = CasterInput { mesh: handle, world_from_object: DMat4::IDENTITY, positions: Positions::OfMesh };
        shadows.add_caster(&caster).map_err(CastShadowsError::from)?;
        let light = shadows.add_light(&mesh.light, &options).map_err(CastShadowsError::from)?;
        Ok(Self { gpu: gpu.clone(), shadows, light })
    }

    /// None where there was nothing to do.
    fn time_ms(&mut self, light: &Light) -> Result<Option<f64>, DrawError> {
        let Self { gpu, shadows, light: handle } = self;
        let Gpu { device, queue, .. } = &*gpu;
        for _ in 0..REPEATS_MAX {
            shadows.set_light(*handle, light).map_err(PrepareShadowsError::from)?;
            shadows.prepare(device, queue).map_err(PrepareShadowsError::from)?;
            let mut cut = CutAfterStages { device: device.clone(), stages: None };
            let mut encoder = device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            shadows.encode(&mut encoder, &mut cut);
            let Some(stages) = cut.stages else { return Ok(None) };
            let clock = Instant::now();
            let submission = queue.submit([stages]);
            gpu.wait(Some(submission))?;
            let time_ms = 1000.0 * clock.elapsed().as_secs_f64();

            // The maps, which are not timed, and the counters.
            queue.submit([encoder.finish()]);
            shadows.wait_for_counters(device)?;
            if shadows.is_complete() {
                return Ok(Some(time_ms));
            }
        }
        Err(DrawError::Incomplete)
    }
}

/// Parts a frame's commands where the first pass begins that is no stage.
struct CutAfterStages {
    device: wgpu::Device,
    stages: Option<wgpu::CommandBuffer>,
}

impl PassTimer for CutAfterStages {
    type Query = ();

    fn begin(&mut self, name: &'static str, encoder: &mut wgpu::CommandEncoder) {
        if self.stages.is_none() && !is_stage(name) {
            let rest = self.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
            self.stages = Some(std::mem::replace(encoder, rest).finish());
        }
    }

    fn compute_writes((): &()) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        None
    }

    fn render_writes((): &()) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        None
    }

    fn end(&mut self, (): (), _encoder: &mut wgpu::CommandEncoder) {}
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn stages_are_told_from_passes() {
        assert!(is_stage("classify_faces") && is_stage("write_draw_args"));
        assert!(!is_stage("shadow_map") && !is_stage("smoothie_buffer") && !is_stage("visibility"));
    }
}
