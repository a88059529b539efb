//! Rooms: meshes that are to be seen from within.

use contrejour_plan::{Light, LightKind, ShadowSettings};
use glam::DVec3;

use super::{camera_depths, cone_angle, light_depths, with_some_size};
use crate::{Bounds, Camera, Scene, SceneMesh};

/// Share of the faces' area that must face the middle.
const INWARD_SHARE: f64 = 0.6;
const CAMERA_FOV_Y_DEGREES: f64 = 65.0;
/// Eye and lamp, from the middle (0) to the sides (1) of the room.
const EYE: DVec3 = DVec3::new(0.2, 0.1, 0.88);
const LAMP: DVec3 = DVec3::new(0.0, 0.8, 0.1);
/// Radius of the lamp over the height of the room.
const LAMP_RADIUS: f64 = 0.05;
const LAMP_COLOR: [f32; 3] = [0.8, 0.76, 0.7];

/// Whether most of the surface faces the middle: walls, floor and ceiling of a room.
pub(super) fn is_room(meshes: &[SceneMesh], bounds: &Bounds) -> bool {
    if bounds.is_empty() || bounds.size().min_element() <= 0.1 * bounds.size().max_element() {
        return false;
    }
    let middle = bounds.center();
    let (mut inward, mut all) = (0.0, 0.0);
    for placed in meshes {
        let world = |vertex: u32| {
            let position = placed.mesh.positions[vertex as usize].map(f64::from);
            placed.world_from_object.transform_point3(DVec3::from(position)) - middle
        };
        let mirrored = placed.world_from_object.determinant() < 0.0;
        for triangle in &placed.mesh.triangles {
            let [a, b, c] = triangle.map(world);
            let front = (b - a).cross(c - a);
            let area = front.length();
            let faces_middle = (front.dot(a + b + c) < 0.0) != mirrored;
            all += area;
            inward += if faces_middle { area } else { 0.0 };
        }
    }
    inward > INWARD_SHARE * all
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
        light: Light { kind, color: LAMP_COLOR },
        shadow: ShadowSettings::default(),
        ambient: Scene::DEFAULT_AMBIENT,
        background: Scene::DEFAULT_BACKGROUND,
        warnings: Vec::new(),
    }
}
