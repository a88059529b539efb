//! No light comes into a closed body.

use contrejour_trace::{LightShape, OccluderMesh, Occluders, Receiver, TraceOptions, trace};
use glam::{DMat4, DVec3};

use crate::placed::places;
use crate::shapes::Shape;

const LIGHT: DVec3 = DVec3::new(0.5, 6.0, -1.0);

/// The most that any point inside the body sees of a light outside, and where the body is then.
fn brightest(body: &Shape) -> (f64, String) {
    let faces = body.triangles.len() as u32;
    let inside = places(body).into_iter().map(|placed| {
        let receivers = placed.receivers(0..faces, DVec3::ZERO);
        let seen = placed.see(&receivers, LIGHT);
        (seen.iter().map(|seen| seen.mean).fold(0.0, f64::max), placed.to_string())
    });
    inside.max_by(|a, b| a.0.total_cmp(&b.0)).expect("there are places")
}

#[test]
fn closed_bodies_are_dark_inside() {
    for body in [Shape::sphere(), Shape::cube()] {
        assert_eq!(brightest(&body).0, 0.0, "in {}", brightest(&body).1);
    }
}

#[test]
fn a_missing_face_lets_light_in() {
    for mut body in [Shape::sphere(), Shape::cube()] {
        // One near the top, where the light is.
        let height = |triangle: &[u32; 3]| triangle.iter().map(|&v| body.positions[v as usize][1]).sum::<f32>();
        let top = body.triangles.iter().enumerate().max_by(|a, b| height(a.1).total_cmp(&height(b.1)));
        let top = top.expect("bodies have faces").0;
        body.triangles.remove(top);
        assert!(brightest(&body).0 > 0.0, "the test above would not see a hole");
    }
}

/// Rays aimed at vertices and along edges: those from the middle through the corners of a grid.
#[test]
fn no_ray_slips_between_faces() {
    let corners = 48;
    let wavy = |u: f64, v: f64| DVec3::new(4.0 * u - 2.0, 1.0 + 0.1 * (9.0 * u).sin() * (7.0 * v).cos(), 4.0 * v - 2.0);
    let sheet = Shape::grid(corners, corners, wavy);
    let floor = Shape::grid(1, 1, |u, v| DVec3::new(0.2 * u - 0.1, 0.0, 0.2 * v - 0.1));
    let both = floor.and(sheet.clone());
    let occluders = Occluders::new(&[OccluderMesh::new(&both.positions, &both.triangles, DMat4::IDENTITY)])
        .expect("the sheet is finite");
    let start = DVec3::new(0.003, 0.0, 0.001);
    let receiver = Receiver { position: start, face: 0, seen_from: DVec3::Y };
    let receivers = [receiver, Receiver { face: 1, ..receiver }];
    // Inner vertices, and middles of their edges.
    let inner = |vertex: &[f32; 3]| vertex[0].abs() < 1.9 && vertex[2].abs() < 1.9;
    let vertices: Vec<DVec3> =
        sheet.positions.iter().filter(|v| inner(v)).map(|v| DVec3::from(v.map(f64::from))).collect();
    let middles = vertices.windows(2).map(|pair| (pair[0] + pair[1]) / 2.0);
    for target in vertices.iter().copied().chain(middles) {
        for reach in [2.0, 3.0, 16.0] {
            let light = LightShape::Sphere { center: start + reach * (target - start), radius: 0.0 };
            let seen = trace(&occluders, &light, &receivers, &TraceOptions::default(), &|_| ())
                .expect("light and receivers are good");
            assert!(seen.iter().all(|seen| seen.mean == 0.0), "{target} from {reach} times as far");
        }
    }
}
