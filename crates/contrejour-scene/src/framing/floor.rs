//! Meshes on a floor.

use std::f64::consts::TAU;
use std::sync::Arc;

use contrejour_plan::{Light, LightKind, ShadowSettings};
use glam::{DMat4, DVec3};

use super::camera_fit::fit_camera;
use super::{light_depths, with_some_size};
use crate::shapes::Shape;
use crate::{Bounds, Material, MeshSource, Scene, SceneMesh};

/// From the meshes towards the light: above, left, in front.
const TOWARDS_LIGHT: DVec3 = DVec3::new(-0.75, 1.15, 0.4);
/// Distance of the light, over half the diagonal of the meshes.
const LIGHT_DISTANCE: f64 = 4.0;
/// Radius of the light, over half the diagonal of the meshes.
const LIGHT_RADIUS: f64 = 0.22;
/// Warm, and as bright as white surfaces bear beside the ambient light.
const LIGHT_COLOR: [f32; 3] = [1.0, 0.96, 0.9];
/// Along the camera's view: a three-quarter view from in front, right and above.
const CAMERA_FORWARD: DVec3 = DVec3::new(-0.5, -0.5, -1.0);
const CAMERA_FOV_Y_DEGREES: f64 = 32.0;
/// Gap between meshes and floor over the diagonal: too small to see, enough to keep their surfaces apart.
const STANDING_GAP: f64 = 1e-3;
/// The same for meshes that lie flat: a sheet on the floor would have no shadow to see.
const FLAT_GAP: f64 = 0.25;
/// Height over diagonal below which meshes are flat.
const FLAT_HEIGHT: f64 = 5e-3;
/// Side of the floor over what must lie on it.
const FLOOR_MARGIN: f64 = 1.15;
const FLOOR_COLOR: [f32; 3] = [0.72, 0.7, 0.67];
/// Points that stand for a circle.
const CIRCLE_POINTS: u32 = 16;

/// The meshes on a floor, lit by a spot from above left.
pub(super) fn on_a_floor(mut meshes: Vec<SceneMesh>, bounds: Bounds) -> Scene {
    let bounds = with_some_size(bounds);
    let diagonal = bounds.size().length();
    let gap = if bounds.size().y > FLAT_HEIGHT * diagonal { STANDING_GAP } else { FLAT_GAP };
    let floor_y = bounds.min.y - gap * diagonal;
    let stage = Stage { bounds, floor_y, light_position: light_position(&bounds) };

    let everywhere = stage.turned_points();
    let half_side = FLOOR_MARGIN
        * everywhere.iter().map(|point| (*point - bounds.center()).with_y(0.0).length()).fold(0.0, f64::max);
    meshes.push(floor_mesh(bounds.center().with_y(floor_y), half_side));
    let all = meshes.iter().map(SceneMesh::bounds).fold(Bounds::EMPTY, Bounds::union);

    let size = Scene::DEFAULT_SIZE;
    let aspect = f64::from(size[0]) / f64::from(size[1]);
    let fov_y = CAMERA_FOV_Y_DEGREES.to_radians();
    Scene {
        camera: fit_camera(&stage.seen_points(), &all, CAMERA_FORWARD, fov_y, aspect),
        size,
        meshes,
        light: stage.light(&everywhere, &all),
        shadow: ShadowSettings::default(),
        ambient: Scene::DEFAULT_AMBIENT,
        background: Scene::DEFAULT_BACKGROUND,
    }
}

fn light_position(bounds: &Bounds) -> DVec3 {
    bounds.center() + 0.5 * LIGHT_DISTANCE * bounds.size().length() * TOWARDS_LIGHT.normalize()
}

/// What stands where before there is a scene.
struct Stage {
    bounds: Bounds,
    floor_y: f64,
    light_position: DVec3,
}

impl Stage {
    /// Where the shadow of a point falls on the floor.
    fn shadow(&self, point: DVec3) -> DVec3 {
        let from = self.light_position;
        from + (point - from) * ((from.y - self.floor_y) / (from.y - point.y))
    }

    /// Corners of the box around the meshes and of its shadow.
    fn seen_points(&self) -> Vec<DVec3> {
        self.bounds.corners().into_iter().flat_map(|corner| [corner, self.shadow(corner)]).collect()
    }

    /// Points around the upright cylinder that holds the meshes however they turn, and around its shadow: when the
    /// light goes around the meshes, these are all it must reach.
    fn turned_points(&self) -> Vec<DVec3> {
        let size = self.bounds.size();
        let around = 0.5 * size.x.hypot(size.z) / (0.5 * TAU / f64::from(CIRCLE_POINTS)).cos();
        let mut points = Vec::new();
        for step in 0..CIRCLE_POINTS {
            let (sin, cos) = (TAU * f64::from(step) / f64::from(CIRCLE_POINTS)).sin_cos();
            let on_circle = self.bounds.center() + DVec3::new(around * sin, 0.0, around * cos);
            let top = on_circle.with_y(self.bounds.max.y);
            points.extend([on_circle.with_y(self.floor_y), top, self.shadow(top)]);
        }
        points
    }

    fn light(&self, reached: &[DVec3], all: &Bounds) -> Light {
        let position = self.light_position;
        let target = self.bounds.center();
        let axis = (target - position).normalize();
        let half_angle = reached.iter().map(|point| (*point - position).angle_between(axis)).fold(0.0, f64::max);
        let [near, far] = light_depths(all, position, axis);
        let radius = 0.5 * LIGHT_RADIUS * self.bounds.size().length();
        let kind = LightKind::Spot { position, target, cone_angle: 2.1 * half_angle, radius, near, far };
        Light { kind, color: LIGHT_COLOR }
    }
}

/// A square that receives and does not cast.
fn floor_mesh(middle: DVec3, half_side: f64) -> SceneMesh {
    // A unit square and a matrix: exact at any size and place.
    let shape = Shape::Plane { size: [1.0; 2], segments: 1 };
    let mesh = shape.generate().expect("a unit square is within all ranges");
    SceneMesh {
        name: "floor".to_owned(),
        source: MeshSource::Shape(shape),
        mesh: Arc::new(mesh),
        world_from_object: DMat4::from_translation(middle) * DMat4::from_scale(DVec3::splat(2.0 * half_side)),
        material: Material { base_color: Some(FLOOR_COLOR) },
        casts: false,
        receives: true,
    }
}
