//! Draws a scene frame by frame, as a program of a user's would.

use std::collections::VecDeque;

use contrejour_gpu::{LightHandle, PassTimer, Shadows};
use contrejour_plan::{Eye, FramePlan, Light, Reason};
use contrejour_scene::{Camera, Scene};
use cpu_time::ThreadTime;
use glam::DMat4;
use image::RgbaImage;

use crate::casters::{CastShadows, Casters};
use crate::error::{DrawError, MAX_REPEATS, NewRendererError};
use crate::frame_uniforms::FrameUniforms;
use crate::gpu::{DeviceFault, Gpu};
use crate::light_targets::LightTargets;
use crate::local_space::LocalSpace;
use crate::measurements::{CounterLog, Measurements};
use crate::picture_pass::PicturePass;
use crate::readback::{ReadError, read_picture};
use crate::scene_lights::{MoveError, SceneLights};
use crate::scene_meshes::{SceneMeshes, has_cuts};
use crate::scene_pass::ScenePass;
use crate::stage_timer::StageTimer;
use crate::targets::{COLOR_FORMAT, SizeTooLarge, check_size, target_texture};

/// A scene on the device.
///
/// Its lights are drawn one after the other: each adds what it sheds to a picture of 16-bit floats, of which the last pass
/// makes tones ([`tone_mapped`](crate::tone_mapped)). Between frames lights, meshes and camera move; a frame uploads what
/// moved.
#[derive(Debug)]
pub struct Renderer {
    pub(crate) gpu: Gpu,
    pub(crate) local: LocalSpace,
    pub(crate) casters: Casters,
    pub(crate) cast: CastShadows,
    pub(crate) lights: SceneLights,
    pub(crate) meshes: SceneMeshes,
    pub(crate) pass: ScenePass,
    pub(crate) targets: LightTargets,
    pub(crate) uniforms: FrameUniforms,
    pub(crate) background: wgpu::Color,
    pub(crate) picture_pass: PicturePass,
    /// Our own, for who does not bring one.
    pub(crate) picture: wgpu::Texture,
    camera: Camera,
    mesh_count: usize,
    timer: StageTimer,
    counter_log: CounterLog,
    frames: Vec<CpuCost>,
    /// Bytes of meshes that moved since the last frame.
    moved_bytes: u64,
    /// Waits of [`Renderer::draw_complete`], which are no waits of the pipeline's own.
    submissions: VecDeque<wgpu::SubmissionIndex>,
    waits_asked_for: u64,
}

/// What one frame cost the CPU. Unit of times: milliseconds.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct CpuCost {
    pub cpu_ms: f64,
    pub upload_ms: f64,
    pub record_ms: f64,
    pub submit_ms: f64,
    pub upload_bytes: u64,
}

/// Where a frame is drawn.
pub(crate) type Target<'a> = (&'a wgpu::TextureView, wgpu::TextureFormat);

impl Renderer {
    /// Uploads a scene.
    ///
    /// # Errors
    ///
    /// [`NewRendererError`] when a light is no light, or something does not fit on the device.
    pub fn new(gpu: Gpu, scene: &Scene) -> Result<Self, NewRendererError> {
        Self::with_casters(gpu, scene, |_, local| Ok(Casters::new(scene, local)?))
    }

    pub(crate) fn with_casters(
        gpu: Gpu,
        scene: &Scene,
        new_casters: impl FnOnce(&Gpu, &LocalSpace) -> Result<Casters, NewRendererError>,
    ) -> Result<Self, NewRendererError> {
        check_size(&gpu, scene.size)?;
        let local = LocalSpace::around(&scene.camera);
        let casters = new_casters(&gpu, &local)?;
        let mut cast = CastShadows::new(&gpu, &casters)?;
        let lights = SceneLights::new(scene, &local, &mut cast)?;
        cast.prepare(&gpu, &casters, lights.casting(), &local.camera(&scene.camera).as_eye(scene.aspect()))?;
        let mut pass = ScenePass::new(&gpu, lights.count(), has_cuts(scene));
        pass.prepare(&gpu, &cast, &lights.handles);
        let meshes = SceneMeshes::new(&gpu, scene, &local, pass.surface_layout())?;
        let targets = LightTargets::new(&gpu, scene.size);
        let picture_pass = PicturePass::new(&gpu, &targets);
        let timer = StageTimer::new(&gpu)?;
        gpu.check()?;
        let [red, green, blue] = scene.background.map(f64::from);
        Ok(Self {
            uniforms: FrameUniforms::new(scene, &local.camera(&scene.camera)),
            background: wgpu::Color { r: red, g: green, b: blue, a: 1.0 },
            picture: new_picture(&gpu, scene.size),
            camera: scene.camera,
            mesh_count: scene.meshes.len(),
            counter_log: CounterLog::default(),
            frames: Vec::new(),
            moved_bytes: 0,
            submissions: VecDeque::new(),
            waits_asked_for: 0,
            gpu,
            local,
            casters,
            cast,
            lights,
            meshes,
            pass,
            targets,
            picture_pass,
            timer,
        })
    }

    /// Moves or changes a light of the scene for the frames that follow; `index` is its place among the scene's lights. Its
    /// intensity, range and inner cone, and how its shadow is made, stay.
    ///
    /// # Errors
    ///
    /// [`MoveError`] when there is none or it is no light; then nothing has changed.
    pub fn set_light(&mut self, index: usize, light: &Light) -> Result<(), MoveError> {
        self.lights.set(index, light, &self.local)
    }

    /// Moves a mesh of the scene for the frames that follow, with its shadows; `index` is its place among the scene's
    /// meshes. It uploads where the mesh stands and nothing else.
    ///
    /// # Errors
    ///
    /// [`MoveError`] when there is none or a number is not finite; then nothing has changed.
    pub fn place_mesh(&mut self, index: usize, world_from_object: &DMat4) -> Result<(), MoveError> {
        if index >= self.mesh_count {
            return Err(MoveError::NoSuchMesh { index, count: self.mesh_count });
        }
        if !world_from_object.is_finite() {
            return Err(MoveError::NotFinite { index });
        }
        self.casters.place(index, &(self.local.local_from_world() * world_from_object));
        self.moved_bytes += self.meshes.place(&self.gpu, index, &self.local, world_from_object);
        Ok(())
    }

    /// Sees the scene from another camera in the frames that follow. Numbers on the device stay small around what the
    /// scene's own camera looks at.
    pub fn set_camera(&mut self, camera: &Camera) {
        self.camera = *camera;
        let [width, height] = self.targets.size.map(f64::from);
        self.uniforms = self.uniforms.seen_from(&self.local.camera(camera), width / height);
    }

    /// What cascades follow.
    pub(crate) fn eye_local(&self) -> Eye {
        let [width, height] = self.targets.size.map(f64::from);
        self.local.camera(&self.camera).as_eye(width / height)
    }

    /// Draws pictures of another size from now on, in pixels; the vertical opening angle of the camera stays.
    ///
    /// # Errors
    ///
    /// [`SizeTooLarge`] when the device's textures are smaller, or a side is 0; then nothing has changed.
    pub fn resize(&mut self, size: [u32; 2]) -> Result<(), SizeTooLarge> {
        check_size(&self.gpu, size)?;
        if size != self.targets.size {
            self.targets = LightTargets::new(&self.gpu, size);
            self.picture_pass.bind_again(&self.gpu, &self.targets);
            self.picture = new_picture(&self.gpu, size);
            self.set_camera(&self.camera.clone());
        }
        Ok(())
    }

    /// Draws one frame into a picture of its own; waits only to keep the frames under way at [`Gpu::frames_in_flight`].
    ///
    /// # Errors
    ///
    /// [`DrawError`] when the device does not allow the frame or fails.
    pub fn draw(&mut self) -> Result<(), DrawError> {
        let view = self.picture.create_view(&wgpu::TextureViewDescriptor::default());
        self.draw_frame((&view, COLOR_FORMAT))
    }

    /// Draws one frame into a picture of the caller's, such as a window's, of the [size](Self::resize) that is set; `format`
    /// is its view's, any that can be drawn into. Numbers are encoded as sRGB unless the format does it or holds floats,
    /// which stay linear.
    ///
    /// # Errors
    ///
    /// [`DrawError`] when the picture has another size, the device does not allow the frame, or fails.
    pub fn draw_into(&mut self, view: &wgpu::TextureView, format: wgpu::TextureFormat) -> Result<(), DrawError> {
        let texture = view.texture();
        let (found, wanted) = ([texture.width(), texture.height()], self.targets.size);
        if found != wanted {
            return Err(DrawError::TargetSize { found, wanted });
        }
        self.draw_frame((view, format))
    }

    fn draw_frame(&mut self, target: Target<'_>) -> Result<(), DrawError> {
        let clock = ThreadTime::now();
        let ms = || 1000.0 * clock.elapsed().as_secs_f64();
        let eye_local = self.eye_local();
        self.cast.prepare(&self.gpu, &self.casters, self.lights.casting(), &eye_local)?;
        // A light may have gained or lost its size.
        self.pass.prepare(&self.gpu, &self.cast, &self.lights.handles);
        self.picture_pass.prepare(&self.gpu, target.1);
        let uniform_bytes = self.pass.upload(&self.gpu, &self.uniforms, &self.lights.records);
        let uploaded = ms();
        let mut encoder = self.encoder();
        if let Some(deformer) = &mut self.casters.deformer {
            deformer.encode(&mut encoder, &mut self.timer);
        }
        let Self { gpu, cast, counter_log, timer, .. } = self;
        cast.shadows.encode_each(&mut encoder, timer, |encoder, view| counter_log.record(gpu, view, encoder));
        counter_log.end_frame();
        self.encode_picture(&mut encoder, target);
        self.timer.resolve(&mut encoder);
        let commands = encoder.finish();
        let recorded = ms();
        let submission = self.gpu.queue.submit([commands]);
        self.timer.end_frame()?;
        let cpu_ms = ms();

        let moved_bytes = std::mem::take(&mut self.casters.pose_bytes) + std::mem::take(&mut self.moved_bytes);
        let upload_bytes = uniform_bytes + moved_bytes + self.cast.shadows.stats().upload_bytes;
        self.frames.push(CpuCost {
            cpu_ms,
            upload_ms: uploaded,
            record_ms: recorded - uploaded,
            submit_ms: cpu_ms - recorded,
            upload_bytes,
        });
        self.timer.collect();
        self.pace(submission)?;
        Ok(self.gpu.check()?)
    }

    /// The light of all lights, and the picture of it.
    fn encode_picture(&mut self, encoder: &mut wgpu::CommandEncoder, target: Target<'_>) {
        let query = self.timer.begin("picture", encoder);
        {
            let writes = StageTimer::render_writes(&query);
            let mut pass = self.targets.begin_pass(encoder, self.background, writes);
            self.pass.draw(&mut pass, &self.cast, &self.lights.handles, &self.meshes);
        }
        self.timer.end(query, encoder);
        let query = self.timer.begin("picture", encoder);
        self.picture_pass.encode(encoder, target, StageTimer::render_writes(&query));
        self.timer.end(query, encoder);
    }

    /// Draws a frame again until its buffers held everything; waits for each.
    ///
    /// # Errors
    ///
    /// [`DrawError`] when the device does not allow the frame or fails.
    pub fn draw_complete(&mut self) -> Result<(), DrawError> {
        for _ in 0..MAX_REPEATS {
            self.draw()?;
            self.waits_asked_for += 1;
            if self.cast.wait_until_done(&self.gpu)? {
                return Ok(());
            }
        }
        Err(DrawError::Incomplete)
    }

    /// The shadows of the scene.
    pub fn shadows(&self) -> &Shadows {
        &self.cast.shadows
    }

    /// The lights that cast, in their order in the scene.
    pub fn casting_lights(&self) -> impl Iterator<Item = LightHandle> {
        self.lights.casting().map(|(handle, _)| handle)
    }

    /// Reads the last picture of [`draw`](Self::draw) back; waits for it.
    ///
    /// # Errors
    ///
    /// [`ReadError`] when the device fails.
    pub fn picture(&self) -> Result<RgbaImage, ReadError> {
        read_picture(&self.gpu, &self.picture)
    }

    /// How many casters bring positions of their own under a light that reads silhouettes from a stream of meshes at rest: they
    /// are in its shadow map alone, with steps.
    pub fn casters_left_out_of_streams(&self) -> usize {
        let plans = self.lights.handles.iter().flatten().filter_map(|light| self.cast.shadows.plan(*light));
        let left_out = |plan: &FramePlan| {
            plan.left_out.iter().filter(|left_out| left_out.reason == Reason::StreamIsAtRest).count()
        };
        plans.map(left_out).max().unwrap_or(0)
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

fn new_picture(gpu: &Gpu, size: [u32; 2]) -> wgpu::Texture {
    target_texture(gpu, "picture", size, 1, COLOR_FORMAT, wgpu::TextureUsages::COPY_SRC)
}
