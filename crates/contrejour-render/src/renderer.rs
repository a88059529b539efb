//! Draws a scene frame by frame, as a program of a user's would.

use std::collections::VecDeque;

use contrejour_gpu::{PassTimer, ShadowOptions};
use contrejour_plan::Light;
use contrejour_scene::Scene;
use cpu_time::ThreadTime;
use image::RgbaImage;

use crate::casters::{CastShadows, Casters};
use crate::error::{DrawError, MAX_REPEATS, NewRendererError};
use crate::frame_uniforms::FrameUniforms;
use crate::gpu::{DeviceFault, Gpu};
use crate::local_space::LocalSpace;
use crate::measurements::{CounterLog, Measurements};
use crate::picture_pass::{PicturePass, Shading};
use crate::readback::{ReadError, read_picture};
use crate::scene_meshes::SceneMeshes;
use crate::stage_timer::StageTimer;
use crate::targets::{Targets, check_size};

/// A scene on the device.
#[derive(Debug)]
pub struct Renderer {
    pub(crate) gpu: Gpu,
    pub(crate) local: LocalSpace,
    pub(crate) casters: Casters,
    pub(crate) cast: CastShadows,
    pub(crate) meshes: SceneMeshes,
    pub(crate) pass: PicturePass,
    pub(crate) targets: Targets,
    pub(crate) uniforms: FrameUniforms,
    pub(crate) background: wgpu::Color,
    /// The light of the last frame.
    pub(crate) light_local: Light,
    lit_pipeline: wgpu::RenderPipeline,
    timer: StageTimer,
    counter_log: CounterLog,
    frames: Vec<CpuCost>,
    /// Waits of [`Renderer::draw_complete`], which are no waits of the pipeline's own.
    submissions: VecDeque<wgpu::SubmissionIndex>,
    waits_asked_for: u64,
}

/// What one frame cost the CPU.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CpuCost {
    pub cpu_ms: f64,
    pub upload_bytes: u64,
}

impl Renderer {
    /// Uploads a scene.
    ///
    /// # Errors
    ///
    /// [`NewRendererError`] when something does not fit on the device.
    pub fn new(gpu: Gpu, scene: &Scene, options: &ShadowOptions) -> Result<Self, NewRendererError> {
        Self::with_casters(gpu, scene, options, |_, local| Ok(Casters::new(scene, local)?))
    }

    pub(crate) fn with_casters(
        gpu: Gpu,
        scene: &Scene,
        options: &ShadowOptions,
        new_casters: impl FnOnce(&Gpu, &LocalSpace) -> Result<Casters, NewRendererError>,
    ) -> Result<Self, NewRendererError> {
        check_size(&gpu, scene.size)?;
        let local = LocalSpace::around(&scene.camera);
        let casters = new_casters(&gpu, &local)?;
        let light_local = local.light(&scene.first_light()?.light);
        let mut cast = CastShadows::new(&gpu, &casters, &light_local, options)?;
        cast.prepare(&gpu, &casters, &light_local)?;
        let pass = PicturePass::new(&gpu, &cast);
        let meshes = SceneMeshes::new(&gpu, scene, &local, pass.surface_layout())?;
        let lit_pipeline = pass.pipeline(&gpu, Shading::Lit);
        let targets = Targets::new(&gpu, scene.size);
        let timer = StageTimer::new(&gpu)?;
        gpu.check()?;
        let [red, green, blue] = scene.background.map(f64::from);
        Ok(Self {
            uniforms: FrameUniforms::new(scene, &local.camera(&scene.camera)),
            background: wgpu::Color { r: red, g: green, b: blue, a: 1.0 },
            counter_log: CounterLog::default(),
            frames: Vec::new(),
            submissions: VecDeque::new(),
            waits_asked_for: 0,
            light_local,
            gpu,
            local,
            casters,
            cast,
            meshes,
            pass,
            targets,
            lit_pipeline,
            timer,
        })
    }

    /// Draws one frame; waits only to keep the frames under way at [`Gpu::frames_in_flight`].
    ///
    /// # Errors
    ///
    /// [`DrawError`] when the light is no light or the device fails.
    pub fn draw(&mut self, light: &Light) -> Result<(), DrawError> {
        let clock = ThreadTime::now();
        self.light_local = self.local.light(light);
        self.uniforms = self.uniforms.with_light(&self.light_local);
        self.cast.prepare(&self.gpu, &self.casters, &self.light_local)?;
        if !self.pass.fits(&self.cast) {
            // The light gained or lost its size.
            self.pass = PicturePass::new(&self.gpu, &self.cast);
            self.lit_pipeline = self.pass.pipeline(&self.gpu, Shading::Lit);
        }
        let uniform_bytes = self.pass.upload(&self.gpu, &self.uniforms);
        let mut encoder = self.encoder();
        if let Some(deformer) = &self.casters.deformer {
            deformer.encode(&mut encoder, &mut self.timer);
        }
        self.cast.shadows.encode(&mut encoder, &mut self.timer);
        let query = self.timer.begin("picture", &mut encoder);
        {
            let mut pass = self.targets.begin_pass(&mut encoder, self.background, StageTimer::render_writes(&query));
            self.pass.draw(&mut pass, &self.lit_pipeline, &self.cast, &self.meshes);
        }
        self.timer.end(query, &mut encoder);
        self.counter_log.record(&self.gpu, &self.cast.shadows, &mut encoder);
        self.timer.resolve(&mut encoder);
        let submission = self.gpu.queue.submit([encoder.finish()]);
        self.timer.end_frame()?;
        let cpu_ms = 1000.0 * clock.elapsed().as_secs_f64();

        let pose_bytes = std::mem::take(&mut self.casters.pose_bytes);
        let upload_bytes = uniform_bytes + pose_bytes + self.cast.shadows.stats().upload_bytes;
        self.frames.push(CpuCost { cpu_ms, upload_bytes });
        self.timer.collect();
        self.pace(submission)?;
        Ok(self.gpu.check()?)
    }

    /// Draws a frame again until its buffers held everything; waits for each.
    ///
    /// # Errors
    ///
    /// [`DrawError`] when the light is no light or the device fails.
    pub fn draw_complete(&mut self, light: &Light) -> Result<(), DrawError> {
        for _ in 0..MAX_REPEATS {
            self.draw(light)?;
            self.waits_asked_for += 1;
            if self.cast.wait_until_done(&self.gpu)? {
                return Ok(());
            }
        }
        Err(DrawError::Incomplete)
    }

    /// Reads the last picture back; waits for it.
    ///
    /// # Errors
    ///
    /// [`ReadError`] when the device fails.
    pub fn picture(&self) -> Result<RgbaImage, ReadError> {
        read_picture(&self.gpu, &self.targets.picture)
    }

    /// What the frames so far cost; waits for the last of them.
    ///
    /// # Errors
    ///
    /// [`DrawError`] when the device fails.
    pub fn measurements(&mut self) -> Result<Measurements, DrawError> {
        self.gpu.wait(None)?;
        self.timer.collect();
        let counters = self.counter_log.read(&self.gpu)?;
        let mut stats = self.cast.shadows.stats();
        stats.readback_waits -= self.waits_asked_for;
        Ok(Measurements::new(
            self.gpu.description(),
            self.gpu.frames_in_flight(),
            self.casters.edge_count(),
            &self.frames,
            &counters,
            self.timer.stages(),
            &stats,
        ))
    }

    fn pace(&mut self, submission: wgpu::SubmissionIndex) -> Result<(), DeviceFault> {
        self.submissions.push_back(submission);
        while self.submissions.len() > self.gpu.frames_in_flight() {
            self.gpu.wait(self.submissions.pop_front())?;
        }
        Ok(())
    }

    pub(crate) fn encoder(&self) -> wgpu::CommandEncoder {
        self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") })
    }
}
