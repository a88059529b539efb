//! The world of a run in pictures.

use std::sync::Arc;

use contrejour_mesh::{DeformingMesh, TriangleMesh};
use contrejour_plan::Light;
use contrejour_render::{DeformingMeshes, Gpu, Renderer, StageCost};
use contrejour_scene::shapes::Shape;
use contrejour_scene::{Camera, Material, MeshSource, Scene, SceneLight, SceneMesh};
use cpu_time::ThreadTime;
use glam::{DMat4, DVec3};

use super::error::StressError;
use super::options::StressOptions;
use super::stopwatch::Stopwatch;
use super::summary::{StageTime, Summary, median};
use super::world::World;
use crate::torus::Triangles;

/// The world of a run over a floor, frame after frame in pictures of the caller's, such as a window's.
///
/// The library makes the shadows of the same lights and casters as in [`run`](super::run); what a frame costs holds the
/// picture too.
#[derive(Debug)]
pub struct Show {
    world: World,
    scene: Scene,
    renderer: Renderer,
    summary: Summary,
    watch: Stopwatch,
    /// CPU time that placing took, frame by frame. Unit: milliseconds.
    placing: Vec<f64>,
}

/// Linear base colours of casters, which take turns.
const CASTER_COLORS: [[f32; 3]; 5] =
    [[0.85, 0.83, 0.78], [0.8, 0.42, 0.28], [0.33, 0.52, 0.64], [0.76, 0.64, 0.32], [0.46, 0.6, 0.42]];

/// Linear colours of lights, which take turns.
const LIGHT_COLORS: [[f32; 3]; 4] = [[1.0, 0.88, 0.7], [0.68, 0.84, 1.0], [1.0, 0.72, 0.56], [0.84, 0.95, 0.78]];

/// What all lights together shed on a white surface.
const BRIGHTNESS: f32 = 1.9;

const FLOOR_COLOR: [f32; 3] = [0.72, 0.7, 0.67];

/// The floor's side, over the room's radius: what suns shadow goes on beyond it.
const FLOOR_SIDE: f64 = 2.6;

/// From the middle of the room to the eye, over the room's radius.
const EYE: DVec3 = DVec3::new(0.95, 1.2, 2.7);

impl Show {
    /// Sets the world up.
    ///
    /// # Errors
    ///
    /// The options are out of range, or the device does not allow the scene.
    pub fn new(gpu: Gpu, options: &StressOptions, size: [u32; 2]) -> Result<Self, StressError> {
        let world = World::new(options)?;
        let scene = scene(&world, size)?;
        let deforming = Deforming { world: &world, scene: &scene };
        let summary = Summary { device: gpu.description(), ..world.summary() };
        let renderer = Renderer::new_posed(gpu, &scene, &deforming, &world.part_poses(0))?;
        let watch = Stopwatch::start(options.duration);
        Ok(Self { world, scene, renderer, summary, watch, placing: Vec::new() })
    }

    /// Whether the time of the run is over.
    pub fn is_over(&self) -> bool {
        self.watch.is_over()
    }

    /// Draws pictures of another size from now on, in pixels.
    ///
    /// # Errors
    ///
    /// The device's textures are smaller, or a side is 0.
    pub fn resize(&mut self, size: [u32; 2]) -> Result<(), StressError> {
        Ok(self.renderer.resize(size)?)
    }

    /// Moves everything on and draws it into a picture of the caller's. Returns the CPU's time of the frame. Unit:
    /// milliseconds.
    ///
    /// # Errors
    ///
    /// The device does not allow the frame, or fails.
    pub fn draw_into(&mut self, view: &wgpu::TextureView, format: wgpu::TextureFormat) -> Result<f64, StressError> {
        self.watch.begin_frame();
        let frame = self.summary.frames + 1;
        let count = self.scene.lights.len();
        let lights = self.world.lights(frame).enumerate().map(|(index, light)| shown(light, index, count));
        let (poses, lights) = (self.world.part_poses(frame), lights.collect::<Vec<_>>());
        let clock = ThreadTime::now();
        let ms = || 1000.0 * clock.elapsed().as_secs_f64();
        self.renderer.pose_meshes(&self.scene, &poses)?;
        for (index, light) in lights.iter().enumerate() {
            self.renderer.set_light(index, light)?;
        }
        self.placing.push(ms());
        self.renderer.draw_into(view, format)?;
        self.summary.add_frame(&self.renderer.shadows().stats());
        self.watch.end_frame();
        Ok(ms())
    }

    /// Waits for the last frame and says what came of all of them.
    ///
    /// # Errors
    ///
    /// The device fails.
    pub fn finish(mut self) -> Result<Summary, StressError> {
        let measured = self.renderer.measurements()?;
        let placing = median(self.placing);
        let time = |stage: &StageCost| StageTime { name: stage.name.clone(), gpu_ms: stage.gpu_ms };
        let mut summary = Summary {
            cpu_ms_per_frame: placing + measured.cpu_ms_per_frame,
            cpu_upload_ms: placing + measured.cpu_upload_ms,
            cpu_record_ms: measured.cpu_record_ms,
            cpu_submit_ms: measured.cpu_submit_ms,
            upload_bytes_per_frame: measured.upload_bytes_per_frame,
            stages: measured.stages.iter().map(time).collect(),
            overflow_frames: measured.overflow_frames,
            ..self.summary
        };
        summary.count(self.renderer.shadows(), self.renderer.casting_lights());
        self.watch.tell(&mut summary);
        Ok(summary)
    }
}

/// What deforms the meshes of a scene that shows a world: those of the casters in their order, then the floor.
struct Deforming<'a> {
    world: &'a World,
    scene: &'a Scene,
}

impl DeformingMeshes for Deforming<'_> {
    fn deforming(&self, mesh: usize) -> Option<&Arc<DeformingMesh>> {
        let index = (mesh < self.world.caster_count()).then_some(mesh)?;
        self.world.flexible_index(index).map(|_| &self.world.flexible.deforming)
    }

    fn rest_mesh(&self, mesh: usize) -> Option<&TriangleMesh> {
        self.scene.meshes.get(mesh).map(|mesh| &*mesh.mesh)
    }
}

/// The world over a floor, seen from above.
fn scene(world: &World, size: [u32; 2]) -> Result<Scene, StressError> {
    let room = world.room();
    let mesh = triangle_mesh(&world.triangles);
    let rigid = Arc::new(mesh.clone());
    let caster = |(index, world_from_object): (usize, DMat4)| {
        // What deforms has a mesh of its own, since its vertices are where no other's are.
        let deforms = world.flexible_index(index).is_some();
        let mesh = if deforms { Arc::new(mesh.clone()) } else { Arc::clone(&rigid) };
        scene_mesh(&format!("caster {index}"), mesh, world_from_object, CASTER_COLORS[index % CASTER_COLORS.len()])
    };
    let mut meshes: Vec<_> = world.casters(0).enumerate().map(caster).collect();
    let floor = Shape::Plane { size: [FLOOR_SIDE * room; 2], segments: 1 }.generate()?;
    let below = DMat4::from_translation(-1.1 * room * DVec3::Y);
    meshes.push(scene_mesh("floor", Arc::new(floor), below, FLOOR_COLOR));

    let settings = *world.settings();
    let count = world.lights(0).count();
    let lights =
        world.lights(0).enumerate().map(|(index, light)| SceneLight::new(shown(light, index, count), settings));
    Ok(Scene {
        camera: Camera {
            eye: room * EYE,
            target: -0.2 * room * DVec3::Y,
            up: DVec3::Y,
            fov_y: 0.8,
            near: 0.05 * room,
            far: 20.0 * room,
        },
        size,
        meshes,
        lights: lights.collect(),
        exposure_ev100: 0.0,
        ambient: Scene::DEFAULT_AMBIENT.map(|x| 0.4 * x),
        background: [0.02, 0.022, 0.026],
        warnings: Vec::new(),
    })
}

fn scene_mesh(name: &str, mesh: Arc<TriangleMesh>, world_from_object: DMat4, color: [f32; 3]) -> SceneMesh {
    SceneMesh {
        name: name.to_owned(),
        source: MeshSource::Given,
        mesh,
        world_from_object,
        material: Material { base_color: Some(color) },
        casts: true,
        receives: true,
    }
}

fn triangle_mesh(torus: &Triangles) -> TriangleMesh {
    let mut mesh = TriangleMesh {
        positions: torus.positions.clone(),
        triangles: torus.triangles.clone(),
        colors: vec![TriangleMesh::DEFAULT_COLOR; torus.positions.len()],
        vertex_numbers: (0..torus.positions.len() as u32).collect(),
        ..TriangleMesh::default()
    };
    mesh.complete_normals();
    mesh
}

/// A light as pictures show it: all of them together are as bright as one.
fn shown(light: Light, index: usize, count: usize) -> Light {
    let share = BRIGHTNESS / count as f32;
    Light { color: LIGHT_COLORS[index % LIGHT_COLORS.len()].map(|x| share * x), ..light }
}
