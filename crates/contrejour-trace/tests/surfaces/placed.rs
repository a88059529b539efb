//! Shapes in places where rounding bites, and the points that a raster pass would give for them.

use std::fmt;

use contrejour_trace::{LightShape, OccluderMesh, Occluders, Receiver, TraceOptions, Visibility, trace};
use glam::{DMat4, DQuat, DVec3, Mat4, Vec3};

use crate::shapes::Shape;

/// A shape in the world, and the world from the space in which its light is given.
pub struct Placed {
    pub shape: Shape,
    pub world_from_object: DMat4,
    pub world_from_light_space: DMat4,
    /// Units of the world in one of the shape.
    pub size: f64,
    /// How far the shape is from the world's origin, in sizes.
    pub sizes_away: f64,
    pub how: How,
}

/// What puts a shape in its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum How {
    /// Its transform, which also turns it.
    Transform,
    /// Its positions, rounded to `f32`.
    Positions,
}

/// For messages.
impl fmt::Display for Placed {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "size {:e}, {:e} sizes away, by its {:?}", self.size, self.sizes_away, self.how)
    }
}

/// The shape in all sizes and places: by its transform, turned, and by its positions.
pub fn places(shape: &Shape) -> Vec<Placed> {
    let sizes = [1e-3, 1.0, 1e3, 1e6];
    let offsets = [DVec3::ZERO, DVec3::new(1e-3, -1e-3, 1e-3), DVec3::new(1e3, 7e2, -4e2), DVec3::new(-1e6, 3e5, 1e6)];
    let pairs = sizes.into_iter().flat_map(|size| offsets.into_iter().map(move |offset| (size, offset)));
    pairs
        .flat_map(|(size, offset)| {
            let turn = DQuat::from_axis_angle(DVec3::new(0.3, 1.0, -0.4).normalize(), 0.6);
            let by_transform = DMat4::from_scale_rotation_translation(DVec3::splat(size), turn, offset);
            let by_positions = DMat4::from_scale_rotation_translation(DVec3::splat(size), DQuat::IDENTITY, offset);
            let sizes_away = offset.abs().max_element() / size;
            let transformed = Placed {
                shape: shape.clone(),
                world_from_object: by_transform,
                world_from_light_space: by_transform,
                size,
                sizes_away,
                how: How::Transform,
            };
            // Farther away, f32 would make another shape of it.
            let keeps_its_shape = sizes_away <= 1e4;
            let baked = keeps_its_shape.then(|| Placed {
                shape: shape.clone().baked(size, offset),
                world_from_object: DMat4::IDENTITY,
                world_from_light_space: by_positions,
                size,
                sizes_away,
                how: How::Positions,
            });
            [Some(transformed), baked].into_iter().flatten()
        })
        .collect()
}

/// Barycentric weights of points all over a face, also on its border and next to it.
const WEIGHTS: [[f32; 3]; 10] = [
    [0.333, 0.333, 0.334],
    [0.6, 0.3, 0.1],
    [0.1, 0.899, 0.001],
    [0.5, 0.5, 0.0],
    [0.0, 0.25, 0.75],
    [0.3, 0.0, 0.7],
    [1.0, 0.0, 0.0],
    [0.0, 0.0, 1.0],
    [1e-7, 0.5, 0.4999999],
    [0.999_999, 5e-7, 5e-7],
];

impl Placed {
    pub fn occluders(&self) -> Occluders {
        Occluders::new(&[OccluderMesh::new(&self.shape.positions, &self.shape.triangles, self.world_from_object)])
            .expect("the shape is finite")
    }

    /// Points of the faces, all arithmetic in `f32` as in a shader. Each is seen from the point of light space.
    pub fn receivers(&self, faces: impl Iterator<Item = u32>, seen_from: DVec3) -> Vec<Receiver> {
        let world_from_object: Mat4 = self.world_from_object.as_mat4();
        let seen_from = self.world_from_light_space.transform_point3(seen_from);
        let points = faces.flat_map(|face| WEIGHTS.map(|weights| (face, weights)));
        points
            .map(|(face, weights)| {
                let triangle = self.shape.triangles[face as usize];
                let corners = triangle
                    .map(|vertex| world_from_object.transform_point3(self.shape.positions[vertex as usize].into()));
                let position: Vec3 = (0..3).map(|i| weights[i] * corners[i]).sum();
                Receiver { position: position.as_dvec3(), face, seen_from }
            })
            .collect()
    }

    /// What the receivers see of the thin rectangle around `center` in light space, with 8 x 4 rays each.
    pub fn see(&self, receivers: &[Receiver], center: DVec3) -> Vec<Visibility> {
        let light = LightShape::Rectangle {
            center: self.world_from_light_space.transform_point3(center),
            half_u: self.world_from_light_space.transform_vector3(LIGHT_U),
            half_v: self.world_from_light_space.transform_vector3(LIGHT_V),
        };
        let options = TraceOptions { first_samples: 4, most_samples: 4, target_error: 0.0, ..Default::default() };
        trace(&self.occluders(), &light, receivers, &options, &|_| ()).expect("the receivers lie on their faces")
    }
}

const LIGHT_U: DVec3 = DVec3::new(0.4, 0.0, 0.0);
const LIGHT_V: DVec3 = DVec3::new(0.0, 0.0, 0.01);

/// A face beside the light around `center`, so near that the shaft to the light meets it, so that no receiver is
/// known to be lit without a ray. No ray hits it.
pub fn decoy(center: DVec3) -> Shape {
    let corners = [[-0.1, -0.3, 0.2], [0.1, -0.3, 0.2], [0.0, -0.3, 0.3]];
    Shape {
        positions: corners.map(|corner| (center + DVec3::from(corner)).to_array().map(|x| x as f32)).into(),
        triangles: vec![[0, 1, 2]],
    }
}
