//! The world of a run as a scene over a floor, and the renderer that draws it.

use std::sync::Arc;

use contrejour_mesh::{DeformingMesh, PartPose, TriangleMesh};
use contrejour_plan::Light;
use contrejour_render::{DeformingMeshes, Gpu, Renderer};
use contrejour_scene::shapes::Shape;
use contrejour_scene::{Camera, Material, MeshSource, Scene, SceneLight, SceneMesh};
use glam::{DMat4, DVec3, Vec3};

use super::error::StressError;
use super::world::World;
use crate::torus::Triangles;

/// A world in pictures.
#[derive(Debug)]
pub(super) struct Pictures {
    scene: Scene,
    pub renderer: Renderer,
}

/// Where everything of a picture is.
#[derive(Debug)]
pub(super) struct PictureMoment {
    poses: Vec<PartPose>,
    pub lights: Vec<Light>,
    pub camera: Camera,
}

/// Linear base colours of casters, which take turns.
const CASTER_COLORS: [[f32; 3]; 5] =
    [[0.85, 0.83, 0.78], [0.8, 0.42, 0.28], [0.33, 0.52, 0.64], [0.76, 0.64, 0.32], [0.46, 0.6, 0.42]];

/// What all lights together shed on a white surface.
const BRIGHTNESS: f32 = 2.0;

const FLOOR_COLOR: [f32; 3] = [0.72, 0.7, 0.67];

/// The floor's side, over the room's radius: what suns shadow goes on beyond it.
const FLOOR_SIDE: f64 = 2.6;

impl PictureMoment {
    pub fn new(world: &World, frame: u64) -> Self {
        let lights: Vec<_> = world.lights(frame).collect();
        let share = BRIGHTNESS / lights.len().max(1) as f32;
        let shown = |light: Light| Light { color: light.color.map(|x| share * x), ..light };
        Self {
            poses: world.part_poses(frame),
            lights: lights.into_iter().map(shown).collect(),
            camera: world.camera(frame),
        }
    }
}

impl Pictures {
    /// Sets the world up as it is in a frame. Numbers on the device are small around what the camera of the first frame looks
    /// at, whatever the frame.
    pub fn new(gpu: Gpu, world: &World, frame: u64, size: [u32; 2]) -> Result<Self, StressError> {
        let moment = PictureMoment::new(world, frame);
        let scene = scene(world, &moment, size)?;
        let deforming = Deforming { world, scene: &scene };
        let mut renderer = Renderer::new_posed(gpu, &scene, &deforming, &moment.poses)?;
        renderer.set_camera(&moment.camera);
        Ok(Self { scene, renderer })
    }

    /// Moves everything.
    pub fn follow(&mut self, moment: &PictureMoment) -> Result<(), StressError> {
        self.renderer.pose_meshes(&self.scene, &moment.poses)?;
        for (index, light) in moment.lights.iter().enumerate() {
            self.renderer.set_light(index, light)?;
        }
        self.renderer.set_camera(&moment.camera);
        Ok(())
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
fn scene(world: &World, moment: &PictureMoment, size: [u32; 2]) -> Result<Scene, StressError> {
    let room = world.room();
    let mesh = triangle_mesh(&world.triangles);
    let rigid = Arc::new(mesh.clone());
    let caster = |(index, pose): (usize, &PartPose)| {
        // What deforms has a mesh of its own, since its vertices are where no other's are.
        let deforms = world.flexible_index(index).is_some();
        let mesh = if deforms { Arc::new(mesh.clone()) } else { Arc::clone(&rigid) };
        let color = CASTER_COLORS[index % CASTER_COLORS.len()];
        scene_mesh(&format!("caster {index}"), mesh, pose.world_from_object, color)
    };
    let mut meshes: Vec<_> = moment.poses.iter().enumerate().map(caster).collect();
    let floor = Shape::Plane { size: [FLOOR_SIDE * room; 2], segments: 1 }.generate()?;
    let below = DMat4::from_translation(-1.1 * room * DVec3::Y);
    meshes.push(scene_mesh("floor", Arc::new(floor), below, FLOOR_COLOR));

    let lights = moment.lights.iter().enumerate();
    Ok(Scene {
        camera: world.camera(0),
        size,
        meshes,
        lights: lights.map(|(index, light)| SceneLight::new(*light, *world.settings(index))).collect(),
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
        normals: torus.positions.iter().map(torus_normal).collect(),
        colors: vec![TriangleMesh::DEFAULT_COLOR; torus.positions.len()],
        vertex_numbers: (0..torus.positions.len() as u32).collect(),
        ..TriangleMesh::default()
    };
    mesh.complete_normals();
    mesh
}

/// The normal of the smooth torus, of any length: a coarse one has creases, where normals of its faces would repeat vertices
/// that what deforms does not know.
fn torus_normal(position: &[f32; 3]) -> [f32; 3] {
    let position = Vec3::from(*position);
    let ring = (position * Vec3::new(1.0, 0.0, 1.0)).normalize_or_zero();
    (position - ring).to_array()
}
