//! Meshes on a floor.

use std::f64::consts::TAU;
use std::sync::Arc;

use contrejour_plan::{Light, LightKind, ShadowSettings};
use glam::{DMat4, DVec3};

use super::camera_fit::fit_camera;
use super::{light_depths, with_some_size};
use crate::shapes::Shape;
use crate::{Bounds, Material, MeshSource, Scene, SceneLight, SceneMesh};

/// From the meshes towards the light: above, left, in front.
const TOWARDS_LIGHT: DVec3 = DVec3::new(-0.46, 0.85, 0.26);
/// Distance of the light, over half the diagonal of the meshes.
const LIGHT_DISTANCE: f64 = 6.0;
/// Radius of the light, over half the diagonal of the meshes.
const LIGHT_RADIUS: f64 = 0.35;
/// Warm, and as bright as white surfaces bear beside the ambient light.
const LIGHT_COLOR: [f32; 3] = [0.9, 0.86, 0.81];
/// Along the camera's view: a three-quarter view from in front, right and above.
const CAMERA_FORWARD: DVec3 = DVec3::new(-0.5, -0.5, -1.0);
const CAMERA_FOV_Y_DEGREES: f64 = 32.0;
/// Gap between meshes and floor over the diagonal: too small to see, enough to keep their surfaces apart.
const STANDING_GAP: f64 = 1e-3;
/// The same for meshes that lie flat: a sheet on the floor would have no shadow to see.
const FLAT_GAP: f64 = 0.25;
/// Height over diagonal below which meshes are flat.
const FLAT_HEIGHT: f64 = 5e-3;
/// Radius of the floor over what must lie on it.
const FLOOR_MARGIN: f64 = 1.1;
/// Thickness of the floor over its radius.
const FLOOR_THICKNESS: f64 = 0.04;
const FLOOR_COLOR: [f32; 3] = [0.72, 0.7, 0.67];
/// Points that stand for a circle.
const CIRCLE_POINTS: u32 = 16;

/// The meshes on a floor, lit by a spot from above left.
pub(super) fn on_a_floor(mut meshes: Vec<SceneMesh>, bounds: Bounds) -> Scene {
    let reach = bounds;
    let bounds = with_some_size(bounds);
    let diagonal = bounds.size().length();
    let gap = if bounds.size().y > FLAT_HEIGHT * diagonal { STANDING_GAP } else { FLAT_GAP };
    let floor_y = bounds.min.y - gap * diagonal;
    let stage = Stage { bounds, floor_y, light_position: light_position(&bounds) };

    let mut everywhere = stage.turned_points();
    let floor_radius = FLOOR_MARGIN
        * everywhere.iter().map(|point| (*point - bounds.center()).with_y(0.0).length()).fold(0.0, f64::max);
    let floor_middle = bounds.center().with_y(floor_y);
    everywhere.extend(circle(floor_middle, floor_radius));
    meshes.push(floor_mesh(floor_middle, floor_radius));
    let all = meshes.iter().map(SceneMesh::bounds).fold(reach, Bounds::union);

    let size = Scene::DEFAULT_SIZE;
    let aspect = f64::from(size[0]) / f64::from(size[1]);
    let fov_y = CAMERA_FOV_Y_DEGREES.to_radians();
    Scene {
        camera: fit_camera(&stage.seen_points(), &all, CAMERA_FORWARD, fov_y, aspect),
        size,
        meshes,
        lights: vec![SceneLight::new(stage.light(&everywhere, &all), ShadowSettings::default())],
        exposure_ev100: 0.0,
        ambient: Scene::DEFAULT_AMBIENT,
        background: Scene::DEFAULT_BACKGROUND,
        warnings: Vec::new(),
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
        let foot = self.bounds.center().with_y(self.floor_y);
        let mut points = Vec::new();
        for low in circle(foot, 0.5 * size.x.hypot(size.z)) {
            let top = low.with_y(self.bounds.max.y);
            points.extend([low, top, self.shadow(top)]);
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

/// Corners of a regular polygon that holds the horizontal circle around `middle`.
fn circle(middle: DVec3, radius: f64) -> impl Iterator<Item = DVec3> {
    let step = TAU / f64::from(CIRCLE_POINTS);
    let corner_radius = radius / (0.5 * step).cos();
    (0..CIRCLE_POINTS).map(move |corner| {
        let (sin, cos) = (step * f64::from(corner)).sin_cos();
        middle + DVec3::new(corner_radius * sin, 0.0, corner_radius * cos)
    })
}

/// A round slab; `middle` is the middle of its upper side. It casts too: soft edges harden towards what is in the map.
fn floor_mesh(middle: DVec3, floor_radius: f64) -> SceneMesh {
    // A unit cylinder and a matrix: good at any size and place.
    let shape = Shape::Cylinder { radius: 1.0, height: 1.0, segments: 96 };
    let mesh = shape.generate().expect("a unit cylinder is within all ranges");
    let scale = DVec3::new(floor_radius, FLOOR_THICKNESS * floor_radius, floor_radius);
    let center = middle - DVec3::new(0.0, 0.5 * scale.y, 0.0);
    SceneMesh {
        name: "floor".to_owned(),
        source: MeshSource::Shape(shape),
        mesh: Arc::new(mesh),
        world_from_object: DMat4::from_translation(center) * DMat4::from_scale(scale),
        material: Material { base_color: Some(FLOOR_COLOR) },
        casts: true,
        receives: true,
    }
}
