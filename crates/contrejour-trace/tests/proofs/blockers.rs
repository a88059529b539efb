//! Scenes of which the truth is known: a floor, a blocker above it, and a light above that.

use std::f64::consts::TAU;

use contrejour_trace::{LightShape, OccluderMesh, Occluders, Receiver, TraceOptions, Visibility, trace};
use glam::{DMat4, DQuat, DVec2, DVec3};

/// Height of the blocker above the floor.
pub const BLOCKER: f64 = 1.0;

/// The world from the space in which the floor is y = 0: turned and moved, so that no axis is special.
pub fn world_from_scene() -> DMat4 {
    let turn = DQuat::from_axis_angle(DVec3::new(1.0, -2.0, 0.5).normalize(), 0.7);
    DMat4::from_rotation_translation(turn, DVec3::new(3.0, -5.0, 11.0))
}

/// A convex polygon at the height of the blocker, as a fan.
pub fn polygon(corners: &[DVec2]) -> (Vec<[f32; 3]>, Vec<[u32; 3]>) {
    let positions = corners.iter().map(|corner| [corner.x as f32, BLOCKER as f32, corner.y as f32]).collect();
    let triangles = (2..corners.len() as u32).map(|i| [0, i - 1, i]).collect();
    (positions, triangles)
}

/// The half plane x < 0, as far as it matters.
pub fn half_plane() -> Vec<DVec2> {
    [[-50.0, -50.0], [0.0, -50.0], [0.0, 50.0], [-50.0, 50.0]].map(DVec2::from).into()
}

/// A regular polygon with the area of a disk, whose outline is within 2e-6 of the radius from the disk's.
pub fn disk(radius: f64) -> Vec<DVec2> {
    let corners = 2000;
    let angle = TAU / f64::from(corners);
    let reach = radius * (angle / angle.sin()).sqrt();
    (0..corners).map(|i| reach * DVec2::from_angle(f64::from(i) * angle)).collect()
}

/// Points of the floor (x, z) that fill the square of half side `half` around `center` evenly (Roberts' R2 sequence).
pub fn floor_points(center: DVec2, half: f64, count: u32) -> impl Iterator<Item = DVec2> {
    let step = DVec2::new(0.754_877_666_246_693, 0.569_840_290_998_053);
    (0..count).map(move |i| center + half * (2.0 * (0.5 + step * f64::from(i)).fract() - 1.0))
}

/// What the tracer says about points of the floor. The light is in the space of the scene.
pub fn traced(blocker: &[DVec2], light: &LightShape, floor: &[DVec2], options: &TraceOptions) -> Vec<Visibility> {
    let world_from_scene = world_from_scene();
    let corners = [[-40.0, 0.0, -40.0], [-40.0, 0.0, 40.0], [40.0, 0.0, 0.0_f32]];
    let (positions, triangles) = polygon(blocker);
    let occluders = Occluders::new(&[
        OccluderMesh::new(&corners, &[[0, 1, 2]], world_from_scene),
        OccluderMesh::new(&positions, &triangles, world_from_scene),
    ])
    .expect("the scene is finite");
    let world = |point| world_from_scene.transform_point3(point);
    let receivers: Vec<Receiver> = floor
        .iter()
        .map(|point| Receiver {
            position: world(DVec3::new(point.x, 0.0, point.y)),
            face: 0,
            seen_from: world(DVec3::Y * 9.0),
        })
        .collect();
    trace(&occluders, &in_world(light), &receivers, options, &|_| ()).expect("the light and the receivers are good")
}

fn in_world(light: &LightShape) -> LightShape {
    let point = |point| world_from_scene().transform_point3(point);
    let vector = |vector| world_from_scene().transform_vector3(vector);
    match *light {
        LightShape::Disk { center, normal, radius } => {
            LightShape::Disk { center: point(center), normal: vector(normal), radius }
        }
        LightShape::Sphere { center, radius } => LightShape::Sphere { center: point(center), radius },
        LightShape::Rectangle { center, half_u, half_v } => {
            LightShape::Rectangle { center: point(center), half_u: vector(half_u), half_v: vector(half_v) }
        }
        LightShape::Sun { towards_light, angular_radius } => {
            LightShape::Sun { towards_light: vector(towards_light), angular_radius }
        }
    }
}

/// The same number of points for each receiver.
pub fn fixed(samples: u32) -> TraceOptions {
    TraceOptions { seed: 7, first_samples: samples, most_samples: samples, target_error: 0.0, ..Default::default() }
}
