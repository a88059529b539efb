//! A floor along an eye's view and a wall beside it, with posts all the way and slats high above: shadows at all depths.

use contrejour_plan::{CascadeSettings, Eye, Light, LightKind};
use contrejour_scene::shapes::Shape;
use contrejour_trace::{LightShape, OccluderMesh, Occluders, Receiver, TraceOptions, trace};
use glam::{DMat4, DVec3};

use crate::ask::Point;
use crate::meshes::TestMesh;
use crate::random::Random;

/// From where it is seen, along it.
pub const EYE: Eye = Eye {
    position: DVec3::new(0.0, 1.6, 0.0),
    forward: DVec3::new(0.0, -0.15, -1.0),
    fov_y: 1.0,
    aspect: 1.6,
    near: 0.5,
    far: 40.0,
};

/// Shines from above, from beside the eye and a little from behind it.
pub const TOWARDS_LIGHT: DVec3 = DVec3::new(0.6, 0.7, 0.35);

/// After so much of the way everything is as before. World units.
pub const PERIOD: f64 = 1.8;

/// So high hang the slats: in front of the nearer cascades' cubes.
const SLATS: f64 = 20.0;

/// A rectangle of two faces, the first of them where the way along the first side is longer.
#[derive(Clone, Copy, Debug)]
struct Rectangle {
    corner: DVec3,
    sides: [DVec3; 2],
    normal: DVec3,
}

const FLOOR: Rectangle = Rectangle {
    corner: DVec3::new(-3.0, 0.0, 6.0),
    sides: [DVec3::new(7.0, 0.0, 0.0), DVec3::new(0.0, 0.0, -60.0)],
    normal: DVec3::Y,
};

const WALL: Rectangle = Rectangle {
    corner: DVec3::new(-3.0, 0.0, 6.0),
    sides: [DVec3::new(0.0, 4.0, 0.0), DVec3::new(0.0, 0.0, -60.0)],
    normal: DVec3::X,
};

impl Rectangle {
    fn mesh(&self, name: &str) -> TestMesh {
        let Self { corner, sides: [u, v], .. } = *self;
        let corners = [corner, corner + u, corner + u + v, corner + v].map(|corner| corner.as_vec3().to_array());
        TestMesh::generated(name, &corners, &[[0, 1, 2], [0, 2, 3]])
    }

    /// Which of its faces a point lies on.
    fn face_of(&self, position: DVec3) -> u32 {
        let [along, across] = self.sides.map(|side| (position - self.corner).dot(side) / side.length_squared());
        u32::from(along < across)
    }
}

/// A point of floor or wall.
#[derive(Clone, Copy, Debug)]
pub struct Seen {
    /// Where it is.
    pub point: Point,
    /// Its depth in the eye's view.
    pub depth: f64,
    face: u32,
}

/// The sun, with cascades of which casters high above are in front.
pub fn sun(angular_radius: f64, cascades: CascadeSettings) -> Light {
    Light { kind: LightKind::Cascaded { towards_light: TOWARDS_LIGHT, angular_radius, cascades }, color: [1.0; 3] }
}

/// Floor, wall, posts and slats.
///
/// # Panics
///
/// When a box is no shape.
pub fn avenue() -> TestMesh {
    let mut avenue = FLOOR.mesh("avenue");
    avenue.parts.extend(WALL.mesh("wall").parts);
    let solid = |size: [f64; 3]| {
        let mesh = Shape::Box { size }.generate().expect("a good box");
        TestMesh::generated("box", &mesh.positions, &mesh.triangles).parts.remove(0)
    };
    let [post, slat] = [[0.12, 2.2, 0.12], [0.9, 0.05, 0.5]].map(solid);
    let mut put = |part: &crate::meshes::TestPart, place: DVec3| {
        let world_from_object = DMat4::from_translation(place);
        avenue.parts.push(crate::meshes::TestPart { world_from_object, ..part.clone() });
    };
    for index in 0..60 {
        let z = 4.0 - 0.5 * PERIOD * f64::from(index);
        // Above the floor by a hair, and not all alike, so that no two faces are one.
        put(&post, DVec3::new(1.1 + 0.15 * f64::from(index % 2), 1.101, z));
        if index % 2 == 0 {
            let up = TOWARDS_LIGHT * (SLATS / TOWARDS_LIGHT.y);
            put(&slat, DVec3::new(-1.2, 0.0, z) + up);
            put(&slat, DVec3::new(-3.0, 1.2, z) + up);
        }
    }
    avenue
}

/// A surface that shadows fall on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Surface {
    /// From the wall to the right.
    Floor,
    /// Up from the floor.
    Wall,
}

/// So many points of floor and wall that the eye sees, spread evenly over the logarithm of its depths.
pub fn seen(eye: &Eye, count: usize, seed: u64) -> Vec<Seen> {
    let mut random = Random::new(seed);
    let mut points = Vec::new();
    while points.len() < count {
        let [along_depth, across] = [(); 2].map(|()| 0.5 + 0.5 * random.signed());
        let surface = if random.below(3) == 0 { Surface::Wall } else { Surface::Floor };
        points.extend(seen_at(eye, surface, across, eye.near * (eye.far / eye.near).powf(along_depth)));
    }
    points
}

/// The point of a surface at a depth, a share of the way across it: from the wall, or up. None where that is out of view.
pub fn seen_at(eye: &Eye, surface: Surface, across: f64, depth: f64) -> Option<Seen> {
    let rectangle = if surface == Surface::Wall { WALL } else { FLOOR };
    let start = rectangle.corner + across * rectangle.sides[0];
    // The second side goes along the view: as far as the depth asks.
    let step = (depth - eye.depth_of(start)) / eye.axis_world().dot(rectangle.sides[1]);
    let position = start + step * rectangle.sides[1];
    let axis = eye.axis_world();
    let right = axis.cross(DVec3::Y).normalize();
    let from_eye = position - eye.position;
    let [x, y] = [right, right.cross(axis)].map(|side| from_eye.dot(side) / depth / (0.5 * eye.fov_y).tan());
    let is_seen = (0.0..1.0).contains(&step) && x.abs() < eye.aspect && y.abs() < 1.0;
    let face = rectangle.face_of(position) + if surface == Surface::Wall { 2 } else { 0 };
    is_seen.then_some(Seen { point: Point { position, normal: rectangle.normal }, depth, face })
}

/// The ray-traced truth at points.
///
/// # Errors
///
/// What the tracer refuses.
pub fn truth(mesh: &TestMesh, light: &Light, points: &[Seen]) -> Result<Vec<f64>, String> {
    let meshes: Vec<_> = (mesh.parts.iter())
        .map(|part| OccluderMesh::new(&part.topology.positions, &part.triangles, part.world_from_object))
        .collect();
    let occluders = Occluders::new(&meshes).map_err(|error| error.to_string())?;
    let receivers: Vec<_> = (points.iter())
        .map(|seen| Receiver { position: seen.point.position, face: seen.face, seen_from: EYE.position })
        .collect();
    let shape = LightShape::of(light).map_err(|error| error.to_string())?;
    let options = TraceOptions { first_samples: 8, most_samples: 128, target_error: 0.02, ..Default::default() };
    let traced = trace(&occluders, &shape, &receivers, &options, &|_| ()).map_err(|error| error.to_string())?;
    Ok(traced.iter().map(|visibility| visibility.mean).collect())
}
