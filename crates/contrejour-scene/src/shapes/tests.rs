use std::collections::HashMap;

use super::*;
use contrejour_mesh::TriangleMesh;
use glam::Vec3;

fn closed_shapes() -> Vec<Shape> {
    vec![
        Shape::Box { size: [1.0, 2.0, 3.0] },
        Shape::Cylinder { radius: 0.5, height: 1.0, segments: 3 },
        Shape::Cylinder { radius: 0.5, height: 1.0, segments: 96 },
        Shape::Sphere { radius: 2.0, segments: 4 },
        Shape::Sphere { radius: 2.0, segments: 65 },
        Shape::Torus { radius: 1.0, tube_radius: 0.3, segments: 25, sides: 20 },
        Shape::Knot { radius: 1.0, tube_radius: 0.22, segments: 160, sides: 16 },
        Shape::Fence { size: [4.0, 2.0, 0.1], columns: 1, rows: 1, bar: 0.1 },
        Shape::Fence { size: [4.0, 2.0, 0.1], columns: 9, rows: 4, bar: 0.1 },
        Shape::Elephant { height: 2.0, segments: 24 },
        Shape::Elephant { height: 2.0, segments: 40 },
    ]
}

fn generate(shape: &Shape) -> TriangleMesh {
    shape.generate().unwrap_or_else(|error| panic!("{shape:?}: {error}"))
}

fn point(mesh: &TriangleMesh, vertex: u32) -> Vec3 {
    Vec3::from(mesh.positions[vertex as usize])
}

/// Times that each edge between welded positions is walked, counted up from its lower end and down from its higher.
fn edge_walks(mesh: &TriangleMesh) -> HashMap<([u32; 3], [u32; 3]), (u32, u32)> {
    let bits = |vertex: u32| mesh.positions[vertex as usize].map(|coordinate| (coordinate + 0.0).to_bits());
    let mut walks = HashMap::new();
    for &[a, b, c] in &mesh.triangles {
        for (from, to) in [(a, b), (b, c), (c, a)].map(|(from, to)| (bits(from), bits(to))) {
            let (forward, backward) = walks.entry((from.min(to), from.max(to))).or_insert((0, 0));
            *(if from < to { forward } else { backward }) += 1;
        }
    }
    walks
}

fn is_closed(mesh: &TriangleMesh) -> bool {
    edge_walks(mesh).values().all(|&walks| walks == (1, 1))
}

fn volume(mesh: &TriangleMesh) -> f32 {
    mesh.triangles.iter().map(|&[a, b, c]| point(mesh, a).dot(point(mesh, b).cross(point(mesh, c))) / 6.0).sum()
}

#[test]
fn every_shape_but_the_plane_is_closed_and_wound_outward() {
    for shape in closed_shapes() {
        let mesh = generate(&shape);
        assert!(is_closed(&mesh), "{shape:?} has an open, doubled or badly wound edge");
        assert!(volume(&mesh) > 0.0, "{shape:?} is inside out");
    }
}

#[test]
fn the_closed_check_sees_a_missing_and_a_flipped_triangle() {
    let whole = generate(&Shape::Sphere { radius: 1.0, segments: 8 });
    let mut open = whole.clone();
    open.triangles.pop();
    assert!(!is_closed(&open));
    let mut flipped = whole;
    flipped.triangles[3].reverse();
    assert!(!is_closed(&flipped));
}

#[test]
fn every_vertex_has_a_unit_normal_a_color_and_a_number() {
    let plane = Shape::Plane { size: [3.0, 2.0], segments: 4 };
    for shape in closed_shapes().into_iter().chain([plane]) {
        let mesh = generate(&shape);
        let count = mesh.positions.len();
        assert_eq!([mesh.normals.len(), mesh.colors.len(), mesh.vertex_numbers.len()], [count; 3], "{shape:?}");
        for normal in &mesh.normals {
            assert!((Vec3::from(*normal).length() - 1.0).abs() < 1e-4, "{shape:?}: {normal:?}");
        }
    }
}

#[test]
fn normals_point_to_the_front_of_their_triangles() {
    for shape in closed_shapes() {
        let mesh = generate(&shape);
        // The soles of the elephant meet its feet in an edge, where smooth normals stand between both.
        let allowed = if matches!(shape, Shape::Elephant { .. }) { mesh.triangles.len() / 20 } else { 0 };
        let against = mesh
            .triangles
            .iter()
            .filter(|&&[a, b, c]| {
                let front = (point(&mesh, b) - point(&mesh, a)).cross(point(&mesh, c) - point(&mesh, a));
                [a, b, c].iter().any(|&vertex| front.dot(Vec3::from(mesh.normals[vertex as usize])) <= 0.0)
            })
            .count();
        assert!(against <= allowed, "{shape:?}: {against} of {}", mesh.triangles.len());
    }
}

#[test]
fn no_triangle_is_without_area() {
    for shape in closed_shapes() {
        let mesh = generate(&shape);
        for &[a, b, c] in &mesh.triangles {
            let front = (point(&mesh, b) - point(&mesh, a)).cross(point(&mesh, c) - point(&mesh, a));
            assert!(front.length() > 0.0, "{shape:?}");
        }
    }
}

#[test]
fn the_elephant_stands_on_the_ground_and_is_as_high_as_asked() {
    let mesh = generate(&Shape::Elephant { height: 3.0, segments: 32 });
    let back = mesh.positions.iter().filter(|position| position[0].abs() < 0.5).map(|position| position[1]);
    let lowest = mesh.positions.iter().map(|position| position[1]).fold(f32::INFINITY, f32::min);
    assert!(lowest.abs() < 0.05, "soles at {lowest}");
    assert!((back.fold(0.0, f32::max) - 3.0).abs() < 0.15);
}

#[test]
fn tori_come_with_a_thousand_and_a_million_triangles() {
    for (segments, sides, triangles) in [(25, 20, 1_000), (1_000, 500, 1_000_000)] {
        let mesh = generate(&Shape::Torus { radius: 1.0, tube_radius: 0.3, segments, sides });
        assert_eq!(mesh.triangles.len(), triangles);
    }
}

#[test]
fn parameters_out_of_range_are_refused_by_name() {
    let refused = |shape: Shape| shape.generate().expect_err("must be refused").parameter();
    assert_eq!(refused(Shape::Box { size: [1.0, f64::NAN, 1.0] }), "size");
    assert_eq!(refused(Shape::Sphere { radius: -1.0, segments: 8 }), "radius");
    assert_eq!(refused(Shape::Sphere { radius: f64::INFINITY, segments: 8 }), "radius");
    assert_eq!(refused(Shape::Cylinder { radius: 1.0, height: 1.0, segments: 2 }), "segments");
    assert_eq!(refused(Shape::Torus { radius: 1.0, tube_radius: 0.3, segments: 65_536, sides: 65_536 }), "segments");
    assert_eq!(refused(Shape::Fence { size: [1.0, 1.0, 0.1], columns: 9, rows: 1, bar: 0.1 }), "bar");
}
