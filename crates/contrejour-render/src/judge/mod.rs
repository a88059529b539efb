//! One scene under its first light, the points that its picture shows, and any number of shadow techniques that say how visible the light is
//! from each of them.
//!
//! Shading is kept apart: a technique is judged by its visibility alone, against the truth at the same points, and timed
//! by the pass that finds it. [`Judge::compose`] shades a picture from any visibility, a technique's or the truth.

mod compose_pass;
mod contestant;
mod error;
mod faces;
mod receiver_pass;
mod receivers;
mod rocking;
mod visibility_pass;

use std::sync::Arc;

use contrejour_mesh::MaskedMesh;
use contrejour_plan::{Eye, Light, ShadowSettings};
use contrejour_scene::{Scene, SceneLight};
use image::RgbaImage;

use crate::casters::Casters;
use crate::frame_uniforms::FrameUniforms;
use crate::readback::{ReadError, read_picture, read_texture};
use crate::scene_meshes::{SceneMeshes, has_cuts};
use crate::surface_light::SurfaceLight;
use crate::targets::{COLOR_FORMAT, Targets, check_size};
use crate::{Gpu, LocalSpace};

use compose_pass::ComposePass;
use faces::{first_faces, with_separate_faces};
use receiver_pass::{ReceiverPass, ReceiverTarget};

pub use contestant::{Contestant, FrameCost};
pub use error::{ComposeError, NewContestantError, NewJudgeError};
pub use faces::TooManyFaces;
pub use receivers::{Receiver, Receivers};
pub use rocking::rocked;

/// Format of pictures before they are rounded.
const FLOAT_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

/// A scene on the device, to judge shadow techniques by.
///
/// Pictures have one sample a pixel, so that each pixel stands for one point of one face.
#[derive(Debug)]
pub struct Judge {
    scene: Arc<JudgedScene>,
    first_faces: Vec<u32>,
    meshes: SceneMeshes,
    surface_layout: wgpu::BindGroupLayout,
    compose: ComposePass,
    targets: Targets,
    uniforms: FrameUniforms,
    background: wgpu::Color,
}

/// What all contestants share.
#[derive(Debug)]
struct JudgedScene {
    gpu: Gpu,
    local: LocalSpace,
    casters: Casters,
    receivers: ReceiverTarget,
    /// The scene's first light.
    light: SceneLight,
    /// What sees the receivers, in local space.
    eye_local: Eye,
    exposure: f64,
}

impl Judge {
    /// Uploads a scene and draws its receivers, in the size of the scene's picture.
    ///
    /// # Errors
    ///
    /// [`NewJudgeError`] when something does not fit on the device.
    pub fn new(mut gpu: Gpu, scene: &Scene) -> Result<Self, NewJudgeError> {
        gpu.wait(None)?;
        gpu.sample_count = 1;
        check_size(&gpu, scene.size)?;
        let first_faces = first_faces(scene)?;
        let local = LocalSpace::around(&scene.camera);
        let casters = Casters::new(scene, &local)?;
        let pass = ReceiverPass::new(&gpu, has_cuts(scene));
        let meshes = SceneMeshes::new(&gpu, &with_separate_faces(scene), &local, pass.surface_layout())?;
        let uniforms = FrameUniforms::new(scene, &local.camera(&scene.camera));
        let receivers = pass.draw(&gpu, scene.size, &meshes, &uniforms);
        let surface_layout = pass.surface_layout().clone();
        let compose = ComposePass::new(&gpu, scene.size, COLOR_FORMAT, (&surface_layout, has_cuts(scene)));
        let targets = Targets::new(&gpu, scene.size);
        gpu.check()?;
        let [red, green, blue] = scene.background.map(f64::from);
        Ok(Self {
            scene: Arc::new(JudgedScene {
                eye_local: local.camera(&scene.camera).as_eye(scene.aspect()),
                gpu,
                local,
                casters,
                receivers,
                light: scene.first_light()?.clone(),
                exposure: scene.exposure(),
            }),
            first_faces,
            meshes,
            surface_layout,
            compose,
            targets,
            uniforms,
            background: wgpu::Color { r: red, g: green, b: blue, a: 1.0 },
        })
    }

    /// The device.
    pub fn gpu(&self) -> &Gpu {
        &self.scene.gpu
    }

    /// The space of the receivers' points.
    pub fn local_space(&self) -> &LocalSpace {
        &self.scene.local
    }

    /// A technique that takes part: its shadows of the scene's casters, with settings of its own.
    ///
    /// # Errors
    ///
    /// [`NewContestantError`] when the settings or the device do not allow it.
    pub fn contestant(&self, settings: &ShadowSettings) -> Result<Contestant, NewContestantError> {
        Contestant::new(Arc::clone(&self.scene), settings)
    }

    /// The parts of a mesh of the scene that alpha cuts and that cast, in its order: what a ray meets of them may be a hole.
    pub fn masked_parts(&self, mesh: usize) -> impl Iterator<Item = &Arc<MaskedMesh>> {
        self.scene.casters.masked_parts(mesh)
    }

    /// The points from which visibility is asked for; waits for the device.
    ///
    /// # Errors
    ///
    /// [`ReadError`] when the device fails.
    pub fn receivers(&self) -> Result<Receivers, ReadError> {
        self.scene.receivers.read(&self.scene.gpu, &self.first_faces)
    }

    /// The shaded picture under a light of which each pixel sees the given part: rows from the top, as
    /// [`Receivers::points`] and [`Contestant::visibility`] have them. Pixels without a receiver need not be right. How bright
    /// the light is follows from the scene's first light.
    ///
    /// # Errors
    ///
    /// [`ComposeError`] when the values are not one for each pixel or not finite, or the device fails.
    pub fn compose(&self, light: &Light, visibility: &[f32]) -> Result<RgbaImage, ComposeError> {
        self.draw(&self.compose, &self.targets, light, visibility)?;
        Ok(read_picture(&self.scene.gpu, &self.targets.picture)?)
    }

    /// The same before it is rounded to 8 bits, as linear red, green, blue and opacity: a number that is none would not
    /// show in a picture.
    ///
    /// # Errors
    ///
    /// As [`compose`](Self::compose).
    pub fn compose_floats(&self, light: &Light, visibility: &[f32]) -> Result<Vec<[f32; 4]>, ComposeError> {
        let JudgedScene { gpu, receivers, .. } = &*self.scene;
        let pass =
            ComposePass::new(gpu, receivers.size(), FLOAT_FORMAT, (&self.surface_layout, self.meshes.has_cuts()));
        let targets = Targets::of_format(gpu, receivers.size(), FLOAT_FORMAT);
        self.draw(&pass, &targets, light, visibility)?;
        Ok(bytemuck::pod_collect_to_vec(&read_texture(gpu, &targets.picture, size_of::<[f32; 4]>() as u32)?))
    }

    fn draw(
        &self,
        pass: &ComposePass,
        targets: &Targets,
        light: &Light,
        visibility: &[f32],
    ) -> Result<(), ComposeError> {
        let JudgedScene { gpu, local, exposure, .. } = &*self.scene;
        let light = SceneLight { light: *light, ..self.scene.light.clone() };
        let uniforms = FrameUniforms { light: SurfaceLight::new(&light, local, *exposure), ..self.uniforms };
        pass.upload(gpu, &uniforms, visibility)?;
        pass.draw(gpu, targets, self.background, &self.meshes);
        Ok(())
    }
}
