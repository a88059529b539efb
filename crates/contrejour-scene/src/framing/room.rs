//! Rooms: meshes that are to be seen from within.

use contrejour_plan::{Light, LightKind, ShadowSettings};
use glam::DVec3;

use super::{camera_depths, cone_angle, light_depths, with_some_size};
use crate::{Bounds, Camera, Scene, SceneLight, SceneMesh};

/// Directions in which one looks from the middle.
const LOOKS: usize = 64;
/// In so many of them one must see the front of a face: a room may lack a wall.
const FRONTS: usize = 44;
/// In so many of them that must be a wall.
const WALLS: usize = 32;
/// What is nearer than this share of the way to the walls stands in the room.
const BEFORE_WALLS: f64 = 0.8;
const CAMERA_FOV_Y_DEGREES: f64 = 65.0;
/// Eye and lamp, from the middle (0) to the sides (1) of the room.
const EYE: DVec3 = DVec3::new(0.2, 0.1, 0.88);
const LAMP: DVec3 = DVec3::new(0.0, 0.8, 0.1);
/// Radius of the lamp over the height of the room.
const LAMP_RADIUS: f64 = 0.05;
const LAMP_COLOR: [f32; 3] = [0.8, 0.76, 0.7];

/// Whether the middle is a place within: almost wherever one looks from there, one sees a front, mostly a wall, and some
/// of what one sees stands before the walls. So neither a body whose faces are wound inward is a room, nor a cloth.
pub(super) fn is_room(meshes: &[SceneMesh], bounds: &Bounds) -> bool {
    if bounds.is_empty() || bounds.size().min_element() <= 0.1 * bounds.size().max_element() {
        return false;
    }
    let mut sights = looks().map(|direction| Sight { direction, distance: f64::INFINITY, is_front: false });
    for placed in meshes {
        let world = |vertex: u32| {
            let position = placed.mesh.positions[vertex as usize].map(f64::from);
            placed.world_from_object.transform_point3(DVec3::from(position)) - bounds.center()
        };
        let mirrored = placed.world_from_object.determinant() < 0.0;
        for triangle in &placed.mesh.triangles {
            let corners = triangle.map(world);
            for sight in &mut sights {
                sight.meet(corners, mirrored);
            }
        }
    }
    let half = 0.5 * bounds.size();
    let to_wall = |direction: DVec3| (half / direction.abs()).min_element();
    let is_wall = |sight: &&Sight| sight.distance >= BEFORE_WALLS * to_wall(sight.direction);
    let fronts = || sights.iter().filter(|sight| sight.is_front);
    let walls = fronts().filter(is_wall).count();
    fronts().count() >= FRONTS && (WALLS..fronts().count()).contains(&walls)
}

/// What one sees from the middle in one direction.
#[derive(Clone, Copy, Debug)]
struct Sight {
    direction: DVec3,
    distance: f64,
    is_front: bool,
}

impl Sight {
    /// Keeps the triangle if it is the nearest so far. Moller & Trumbore 1997.
    fn meet(&mut self, [a, b, c]: [DVec3; 3], mirrored: bool) {
        let (ab, ac) = (b - a, c - a);
        let across = self.direction.cross(ac);
        let determinant = ab.dot(across);
        let u = -a.dot(across) / determinant;
        let around = ab.cross(a);
        let v = self.direction.dot(around) / determinant;
        let distance = ac.dot(around) / determinant;
        if u >= 0.0 && v >= 0.0 && u + v <= 1.0 && distance > 0.0 && distance < self.distance {
            self.distance = distance;
            self.is_front = (determinant > 0.0) != mirrored;
        }
    }
}

/// Directions all around, evenly spread: a Fibonacci sphere.
fn looks() -> [DVec3; LOOKS] {
    let golden_angle = core::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    core::array::from_fn(|i| {
        let y = 1.0 - (2.0 * i as f64 + 1.0) / LOOKS as f64;
        let (sine, cosine) = (golden_angle * i as f64).sin_cos();
        let ring = (1.0 - y * y).sqrt();
        DVec3::new(ring * cosine, y, ring * sine)
    })
}

/// The room from its front wall, lit by a lamp under its ceiling.
pub(super) fn seen_from_within(meshes: Vec<SceneMesh>, bounds: Bounds) -> Scene {
    let bounds = with_some_size(bounds);
    let half = 0.5 * bounds.size();
    let eye = bounds.center() + EYE * half;
    let target = bounds.center() - DVec3::new(0.0, 0.15 * half.y, 0.3 * half.z);
    let [near, far] = camera_depths(&bounds, eye, (target - eye).normalize());
    let camera = Camera { eye, target, up: DVec3::Y, fov_y: CAMERA_FOV_Y_DEGREES.to_radians(), near, far };

    let position = bounds.center() + LAMP * half;
    let below = bounds.center().with_y(bounds.min.y);
    let axis = (below - position).normalize();
    // The floor and the lower half of the walls: what stands above is beside the lamp, not under it.
    let lower_half = Bounds { min: bounds.min, max: bounds.max.with_y(bounds.center().y) };
    let [light_near, light_far] = light_depths(&bounds, position, axis);
    let kind = LightKind::Spot {
        position,
        target: below,
        cone_angle: cone_angle(&lower_half, position, axis),
        radius: LAMP_RADIUS * bounds.size().y,
        near: light_near,
        far: light_far,
    };
    Scene {
        camera,
        size: Scene::DEFAULT_SIZE,
        meshes,
        lights: vec![SceneLight::new(Light { kind, color: LAMP_COLOR }, ShadowSettings::default())],
        exposure_ev100: 0.0,
        ambient: Scene::DEFAULT_AMBIENT,
        background: Scene::DEFAULT_BACKGROUND,
        warnings: Vec::new(),
    }
}
