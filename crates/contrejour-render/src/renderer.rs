//! Draws a scene frame by frame, as a program of a user's would.

use std::collections::{HashMap, VecDeque};
use std::sync::Arc;

use contrejour_gpu::{
    CasterInput, CountersError, FrameInput, MeshHandle, PassTimer, Positions, PrepareError, ShadowOptions, Shadows,
};
use contrejour_mesh::{BuildOptions, TopologyAwareMesh, TriangleMesh};
use contrejour_plan::Light;
use contrejour_scene::Scene;
use cpu_time::ThreadTime;
use glam::DMat4;
use image::RgbaImage;

use crate::error::{DrawError, MAX_REPEATS, NewRendererError};
use crate::frame_uniforms::FrameUniforms;
use crate::gpu::Gpu;
use crate::local_space::LocalSpace;
use crate::measurements::{CounterLog, Measurements};
use crate::picture_pass::{PicturePass, Shading};
use crate::readback::{ReadError, read_picture};
use crate::scene_meshes::SceneMeshes;
use crate::stage_timer::StageTimer;
use crate::targets::Targets;

/// A scene on the device.
#[derive(Debug)]
pub struct Renderer {
    pub(crate) gpu: Gpu,
    pub(crate) local: LocalSpace,
    pub(crate) shadows: Shadows,
    pub(crate) casters: Vec<Caster>,
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
    frames: Vec<FrameCost>,
    /// Waits of [`Renderer::draw_complete`], which are no waits of the pipeline's own.
    submissions: VecDeque<wgpu::SubmissionIndex>,
    waits_asked_for: u64,
}

/// A mesh that throws a shadow.
#[derive(Debug)]
pub(crate) struct Caster {
    pub handle: MeshHandle,
    pub local_from_object: DMat4,
    pub topology: Arc<TopologyAwareMesh>,
}

/// What one frame cost the CPU.
#[derive(Clone, Copy, Debug)]
pub(crate) struct FrameCost {
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
        let [width, height] = scene.size;
        let limit = gpu.device.limits().max_texture_dimension_2d;
        if width.max(height) > limit {
            return Err(NewRendererError::SizeTooLarge { width, height, limit });
        }
        let local = LocalSpace::around(&scene.camera);
        let mut shadows = Shadows::new(&gpu.device, options)?;
        let casters = add_casters(&mut shadows, scene, &local)?;
        let light_local = local.light(&scene.light);
        prepare(&gpu, &mut shadows, &casters, &light_local)?;
        let pass = PicturePass::new(&gpu, &shadows);
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
            shadows,
            casters,
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
        prepare(&self.gpu, &mut self.shadows, &self.casters, &self.light_local)?;
        if !self.pass.fits(&self.shadows) {
            // The light gained or lost its size.
            self.pass = PicturePass::new(&self.gpu, &self.shadows);
            self.lit_pipeline = self.pass.pipeline(&self.gpu, Shading::Lit);
        }
        let uniform_bytes = self.pass.upload(&self.gpu, &self.uniforms);
        let mut encoder = self.encoder();
        self.shadows.encode(&mut encoder, &mut self.timer);
        let query = self.timer.begin("picture", &mut encoder);
        {
            let mut pass = self.targets.begin_pass(&mut encoder, self.background, StageTimer::render_writes(&query));
            self.pass.draw(&mut pass, &self.lit_pipeline, &self.shadows, &self.meshes);
        }
        self.timer.end(query, &mut encoder);
        self.counter_log.record(&self.gpu, &self.shadows, &mut encoder);
        self.timer.resolve(&mut encoder);
        let submission = self.gpu.queue.submit([encoder.finish()]);
        self.timer.end_frame()?;
        let cpu_ms = 1000.0 * clock.elapsed().as_secs_f64();

        let upload_bytes = uniform_bytes + self.shadows.stats().upload_bytes;
        self.frames.push(FrameCost { cpu_ms, upload_bytes });
        self.timer.collect();
        self.pace(submission)?;
        self.gpu.check()?;
        Ok(())
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
            match self.shadows.wait_for_counters(&self.gpu.device) {
                // Frames without smoothies count nothing and miss nothing.
                Err(CountersError::NoFrame) => return Ok(()),
                Ok(_) if self.shadows.is_complete() => return Ok(()),
                Ok(_) => {}
                Err(error) => return Err(error.into()),
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
        self.gpu.device.poll(wgpu::PollType::wait_indefinitely())?;
        self.timer.collect();
        let counters = self.counter_log.read(&self.gpu)?;
        let edges = self.casters.iter().map(|caster| caster.topology.edges.len() as u64).sum();
        let mut stats = self.shadows.stats();
        stats.readback_waits -= self.waits_asked_for;
        Ok(Measurements::new(
            self.gpu.description(),
            self.gpu.frames_in_flight(),
            edges,
            &self.frames,
            &counters,
            self.timer.stages(),
            &stats,
        ))
    }

    fn pace(&mut self, submission: wgpu::SubmissionIndex) -> Result<(), wgpu::PollError> {
        self.submissions.push_back(submission);
        while self.submissions.len() > self.gpu.frames_in_flight() {
            let submission_index = self.submissions.pop_front();
            self.gpu.device.poll(wgpu::PollType::Wait { submission_index, timeout: None })?;
        }
        Ok(())
    }

    pub(crate) fn encoder(&self) -> wgpu::CommandEncoder {
        self.gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("frame") })
    }
}

/// Prepares a frame of the library, whose world is our local space.
fn prepare(gpu: &Gpu, shadows: &mut Shadows, casters: &[Caster], light_local: &Light) -> Result<(), PrepareError> {
    let casters: Vec<CasterInput<'_>> = (casters.iter())
        .map(|caster| CasterInput {
            mesh: caster.handle,
            world_from_object: caster.local_from_object,
            positions: Positions::OfMesh,
        })
        .collect();
    shadows.prepare(&gpu.device, &gpu.queue, &FrameInput { light: light_local, casters: &casters })
}

/// Builds the topology of each mesh that casts once, however often it stands in the scene.
fn add_casters(shadows: &mut Shadows, scene: &Scene, local: &LocalSpace) -> Result<Vec<Caster>, NewRendererError> {
    let mut known = HashMap::new();
    let mut casters = Vec::new();
    for placed in scene.meshes.iter().filter(|placed| placed.casts && !placed.mesh.triangles.is_empty()) {
        let key = Arc::as_ptr(&placed.mesh);
        let (handle, topology) = match known.get(&key) {
            Some((handle, topology)) => (*handle, Arc::clone(topology)),
            None => {
                let TriangleMesh { positions, triangles, .. } = &*placed.mesh;
                let topology = TopologyAwareMesh::build(positions, triangles, &BuildOptions::default())
                    .map_err(|source| NewRendererError::Topology { mesh: placed.name.clone(), source })?;
                let topology = Arc::new(topology);
                let handle = shadows.add_mesh(Arc::clone(&topology))?;
                known.insert(key, (handle, Arc::clone(&topology)));
                (handle, topology)
            }
        };
        casters.push(Caster {
            handle,
            local_from_object: local.local_from_world() * placed.world_from_object,
            topology,
        });
    }
    Ok(casters)
}
