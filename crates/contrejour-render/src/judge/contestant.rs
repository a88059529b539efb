//! A technique that takes part.

use std::sync::Arc;
use std::time::Instant;

use contrejour_gpu::{LightHandle, Maps, PassTimer, Shadows, Untimed};
use contrejour_plan::{FramePlan, Light, ShadowSettings};
use cpu_time::ThreadTime;

use super::JudgedScene;
use super::error::NewContestantError;
use super::visibility_pass::{VISIBILITY_FORMAT, VisibilityPass};
use crate::casters::CastShadows;
use crate::error::{DrawError, MAX_REPEATS};
use crate::filled_views::TriangleCounter;
use crate::readback::{ReadError, read_texture};
use crate::stage_timer::{FrameTime, PassTime, StageTimer};
use crate::targets::target_texture;

/// Shadows of a judged scene with settings of their own, and the visibility that they give its receivers.
#[derive(Debug)]
pub struct Contestant {
    scene: Arc<JudgedScene>,
    cast: CastShadows,
    light: LightHandle,
    pass: VisibilityPass,
    target: wgpu::Texture,
    target_view: wgpu::TextureView,
    timer: StageTimer,
}

/// What a frame cost: light and casters to the device, the stages, the maps, and the visibility of all receivers.
/// Nothing is shaded.
#[derive(Clone, Debug, PartialEq)]
pub struct FrameCost {
    /// CPU time of the thread that prepares, records and submits the frame. Unit: milliseconds.
    pub cpu_ms: f64,
    /// Time on the wall from the begin of the submission until the device is done, which no other frame shares. On a
    /// [software device](crate::Gpu::is_software) this is what tells techniques apart. Unit: milliseconds.
    pub wall_ms: f64,
    /// Time on the device from the begin of the first stage to the end of the last pass, what lies between them
    /// included; `None` where the device has no timestamps. Unit: milliseconds.
    pub gpu_ms: Option<f64>,
    /// Time of each stage and pass on the device, in their order; the last is `visibility`. Empty where the device has
    /// no timestamps.
    pub passes: Vec<PassTime>,
    /// Whether the frame was like the one before, so that its maps stood and nothing but visibility was asked for: no
    /// time of the technique. [`rocked`](super::rocked) moves the light by a hair against that.
    pub is_unchanged: bool,
    /// How often the frame was drawn before, because its lists were too short; only the last time was measured.
    pub repeats: usize,
}

impl Contestant {
    pub(super) fn new(scene: Arc<JudgedScene>, settings: &ShadowSettings) -> Result<Self, NewContestantError> {
        let JudgedScene { gpu, local, casters, receivers, light, eye_local, .. } = &*scene;
        let light_local = local.light(&light.light);
        let mut cast = CastShadows::new(gpu, casters)?;
        let handle = cast.add_light(&light_local, settings)?;
        cast.prepare(gpu, casters, [(handle, &light_local)], eye_local)?;
        let pass = VisibilityPass::new(gpu, &cast, handle, receivers);
        let usage = wgpu::TextureUsages::COPY_SRC;
        let target = target_texture(gpu, "judged visibility", receivers.size(), 1, VISIBILITY_FORMAT, usage);
        let target_view = target.create_view(&wgpu::TextureViewDescriptor::default());
        let timer = StageTimer::new(gpu)?;
        gpu.check()?;
        Ok(Self { scene, cast, light: handle, pass, target, target_view, timer })
    }

    /// Draws a frame until its lists held everything, and waits for the device each time; returns the cost of the last.
    ///
    /// The first frames also compile and grow what later ones reuse: leave them out of what you report.
    ///
    /// # Errors
    ///
    /// [`DrawError`] when the light is no light or the device fails.
    pub fn draw(&mut self, light: &Light) -> Result<FrameCost, DrawError> {
        let light_local = self.scene.local.light(light);
        for repeats in 0..MAX_REPEATS {
            let cost = FrameCost { repeats, ..self.draw_once(&light_local)? };
            if self.cast.wait_until_done(&self.scene.gpu)? {
                return Ok(cost);
            }
        }
        Err(DrawError::Incomplete)
    }

    fn draw_once(&mut self, light_local: &Light) -> Result<FrameCost, DrawError> {
        let JudgedScene { gpu, casters, receivers, eye_local, .. } = &*self.scene;
        let cpu_clock = ThreadTime::now();
        self.cast.prepare(gpu, casters, [(self.light, light_local)], eye_local)?;
        if !self.pass.fits(&self.cast) {
            // The light gained or lost its size.
            self.pass = VisibilityPass::new(gpu, &self.cast, self.light, receivers);
        }
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("judged") });
        self.cast.shadows.encode(&mut encoder, &mut self.timer);
        self.pass.encode(&mut encoder, &self.cast, receivers, &self.target_view, &mut self.timer);
        self.timer.resolve(&mut encoder);
        let commands = encoder.finish();
        let wall_clock = Instant::now();
        let submission = gpu.queue.submit([commands]);
        let cpu_ms = 1000.0 * cpu_clock.elapsed().as_secs_f64();
        gpu.wait(Some(submission))?;
        let wall_ms = 1000.0 * wall_clock.elapsed().as_secs_f64();

        // Only now does the timer ask for its results, so that this is in neither time.
        let FrameTime { whole_ms, passes } = self.timer.last_frame(gpu)?;
        Ok(FrameCost {
            cpu_ms,
            wall_ms,
            gpu_ms: whole_ms,
            passes,
            is_unchanged: self.cast.shadows.stats().lights_redone == 0,
            repeats: 0,
        })
    }

    /// How long the vertex stage takes of the pass that fills the silhouette map, without the fragments: that pass, drawn
    /// once more into a single texel. `None` where there is no such pass, or the device has no timestamps. Unit: milliseconds.
    ///
    /// # Errors
    ///
    /// As [`draw`](Self::draw).
    pub fn silhouette_vertices_ms(&mut self, light: &Light) -> Result<Option<f64>, DrawError> {
        let JudgedScene { gpu, casters, local, eye_local, .. } = &*self.scene;
        self.cast.shadows.redraw();
        self.cast.prepare(gpu, casters, [(self.light, &local.light(light))], eye_local)?;
        let Some(pass) = self.plan().and_then(FramePlan::silhouette_map_pass) else { return Ok(None) };
        let counter = TriangleCounter::new(gpu);
        let mut encoder =
            gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("vertices") });
        let timer = &mut self.timer;
        self.cast.shadows.encode_each(&mut encoder, &mut Untimed, |encoder, view| {
            let query = timer.begin("vertices", encoder);
            counter.count(encoder, view, (pass, 1), StageTimer::render_writes(&query));
            timer.end(query, encoder);
        });
        self.timer.resolve(&mut encoder);
        gpu.wait(Some(gpu.queue.submit([encoder.finish()])))?;
        Ok(self.timer.last_frame(gpu)?.passes.first().map(|vertices| vertices.gpu_ms))
    }

    /// Visibility of the light from each receiver in the last frame, rows from the top, 0 dark to 1 lit; 1 where there
    /// is no receiver. Waits for the device.
    ///
    /// # Errors
    ///
    /// [`ReadError`] when the device fails.
    pub fn visibility(&self) -> Result<Vec<f32>, ReadError> {
        let texels = read_texture(&self.scene.gpu, &self.target, size_of::<f32>() as u32)?;
        Ok(bytemuck::pod_collect_to_vec(&texels))
    }

    /// The shadows themselves: their counters and lists.
    pub fn shadows(&self) -> &Shadows {
        &self.cast.shadows
    }

    /// The light's plan; `None` where its device failed.
    pub fn plan(&self) -> Option<&FramePlan> {
        self.cast.shadows.plan(self.light)
    }

    /// The light's maps.
    pub fn maps(&self) -> Maps<'_> {
        self.cast.shadows.maps(self.light)
    }

    /// Bytes of the light's maps in the last frame.
    pub fn map_bytes(&self) -> u64 {
        self.plan_sum(|plan| plan.textures.iter().map(|texture| texture.bytes).sum())
    }

    /// Bytes of the buffers in the last frame: meshes, lists, records.
    pub fn buffer_bytes(&self) -> u64 {
        self.plan_sum(|plan| plan.buffers.iter().map(|buffer| buffer.bytes).sum())
    }

    fn plan_sum(&self, sum: impl FnOnce(&FramePlan) -> u64) -> u64 {
        self.plan().map_or(0, sum)
    }
}
