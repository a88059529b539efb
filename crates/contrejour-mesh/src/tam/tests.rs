//! What faces know of their neighbours, against the signed multiplicities of edges.

use contrejour_layout::{
    ACROSS_ALONE, ACROSS_ALONG, ACROSS_NEVER, ACROSS_NOTHING, FaceNeighbours, INCIDENCE_ALONG, UNLIT_FACE,
};
use glam::DVec3;
use half::f16;

use super::*;
use crate::{BuildOptions, Motion, incidence_words};

const CUBE: [[f32; 3]; 8] = [
    [0.0, 0.0, 0.0],
    [1.0, 0.0, 0.0],
    [1.0, 1.0, 0.0],
    [0.0, 1.0, 0.0],
    [0.0, 0.0, 1.0],
    [1.0, 0.0, 1.0],
    [1.0, 1.0, 1.0],
    [0.0, 1.0, 1.0],
];

const CUBE_FACES: [[u32; 3]; 12] = [
    [0, 2, 1],
    [0, 3, 2],
    [4, 5, 6],
    [4, 6, 7],
    [0, 1, 5],
    [0, 5, 4],
    [2, 3, 7],
    [2, 7, 6],
    [1, 2, 6],
    [1, 6, 5],
    [3, 0, 4],
    [3, 4, 7],
];

fn mesh(positions: &[[f32; 3]], triangles: &[[u32; 3]], motion: Motion) -> TopologyAwareMesh {
    let options = BuildOptions { motion, ..BuildOptions::default() };
    TopologyAwareMesh::build(positions, triangles, &options).expect("the mesh is sound")
}

fn stream(mesh: &TopologyAwareMesh) -> TamStream {
    TamStream::new(mesh, &TamOptions::default())
}

/// Where `light` is by a plane through `corner`: 1 in front of it, else -1. Zeros are no plane.
fn side(normal: [f32; 3], corner: [f32; 3], light: DVec3) -> i32 {
    let [normal, corner] = [normal, corner].map(|vector| DVec3::from(vector.map(f64::from)));
    if normal == DVec3::ZERO {
        0
    } else if normal.dot(light - corner) > 0.0 {
        1
    } else {
        -1
    }
}

fn own_side(face: &TamFace, light: DVec3) -> i32 {
    side(unit_normal(face.corners).as_vec3().to_array(), face.corners[0], light)
}

/// Silhouette edges by their ends' positions, as those faces of a stream say that draw them.
fn said_by_faces(stream: &TamStream, light: DVec3) -> Vec<[[u32; 3]; 2]> {
    let mut edges: Vec<_> = stream
        .faces
        .iter()
        .flat_map(|face| (0..3).map(move |turn| (face, turn)))
        .filter(|&(face, turn)| {
            let normal = face.neighbour_normals[turn];
            let own = own_side(face, light);
            let draws = own == 1 || DVec3::from(normal.map(f64::from)).length() > 1.5;
            draws && own * side(normal, face.corners[turn], light) == -1
        })
        .map(|(face, turn)| ends([face.corners[turn], face.corners[(turn + 1) % 3]]))
        .collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// The same as the vertex stage asks what is across; each edge as often as it is drawn.
fn drawn_by_indices(mesh: &TopologyAwareMesh, neighbours: &[FaceNeighbours], light: DVec3) -> Vec<[[u32; 3]; 2]> {
    let position = |vertex: u32| mesh.positions[vertex as usize];
    let is_lit = |vertices: [u32; 3]| {
        let corners = vertices.map(position);
        side(unit_normal(corners).as_vec3().to_array(), corners[0], light) == 1
    };
    let mut edges = Vec::new();
    for (face, neighbours) in mesh.faces.iter().zip(neighbours) {
        let vertices = [face.a, face.b, face.c];
        let lit = is_lit(vertices);
        for (turn, across) in [neighbours.across_ab, neighbours.across_bc, neighbours.across_ca].into_iter().enumerate()
        {
            let [from, to] = [vertices[turn], vertices[(turn + 1) % 3]];
            let is_along = across & ACROSS_ALONG != 0;
            let opposite = across & !(ACROSS_ALONG | ACROSS_ALONE);
            let is_outline = match across {
                ACROSS_NOTHING => true,
                ACROSS_NEVER => false,
                _ if !lit && across & ACROSS_ALONE == 0 => false,
                _ if is_along => lit == is_lit([from, to, opposite]),
                _ => lit != is_lit([to, from, opposite]),
            };
            if is_outline {
                edges.push(ends([from, to].map(position)));
            }
        }
    }
    edges.sort_unstable();
    edges
}

/// The same by their signed multiplicities.
fn by_definition(mesh: &TopologyAwareMesh, light: DVec3) -> Vec<[[u32; 3]; 2]> {
    let sign = |face: u32| {
        let corners = || mesh.corners(&mesh.faces[face as usize]);
        if face == UNLIT_FACE { -1 } else { side(unit_normal(corners()).as_vec3().to_array(), corners()[0], light) }
    };
    let multiplicity = |words: &[u32]| -> i32 {
        words.iter().map(|word| sign(word >> 1) * if word & INCIDENCE_ALONG != 0 { 1 } else { -1 }).sum()
    };
    let mut edges: Vec<_> = mesh
        .edges
        .iter()
        .filter(|edge| multiplicity(incidence_words(edge, &mesh.incidences)) != 0)
        .map(|edge| ends([edge.low_vertex, edge.high_vertex].map(|vertex| mesh.positions[vertex as usize])))
        .collect();
    edges.sort_unstable();
    edges
}

fn ends(positions: [[f32; 3]; 2]) -> [[u32; 3]; 2] {
    let mut ends = positions.map(|position| position.map(f32::to_bits));
    ends.sort_unstable();
    ends
}

/// Lights all around, none of them in a plane of simple coordinates.
fn lights() -> impl Iterator<Item = DVec3> {
    let mut random = fastrand::Rng::with_seed(1);
    (0..200).map(move |_| DVec3::from([0; 3].map(|_| 8.0 * random.f64() - 4.0)))
}

#[track_caller]
fn check(positions: &[[f32; 3]], triangles: &[[u32; 3]]) {
    for motion in [Motion::Rigid, Motion::Deforming] {
        let mesh = mesh(positions, triangles, motion);
        let stream = stream(&mesh);
        let neighbours = face_neighbours(&mesh);
        for light in lights() {
            let defined = by_definition(&mesh, light);
            assert_eq!(said_by_faces(&stream, light), defined, "{motion:?}, light at {light}");
            let mut drawn = drawn_by_indices(&mesh, &neighbours, light);
            drawn.dedup();
            assert_eq!(drawn, defined, "{motion:?}, light at {light}, by indices");
        }
    }
}

#[test]
fn faces_say_what_the_definition_says() {
    check(&CUBE, &CUBE_FACES);
    // Open, and with a face that is wound against its neighbours.
    check(&CUBE, &CUBE_FACES[2..]);
    let mut flipped = CUBE_FACES;
    flipped[4].swap(0, 1);
    check(&CUBE, &flipped);
    // A face without area between two others takes a side.
    check(
        &[[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.5], [1.0, -1.0, 0.7]],
        &[[0, 2, 3], [2, 1, 3], [0, 1, 2], [1, 0, 4]],
    );
}

#[test]
fn one_of_two_faces_draws_an_edge() {
    let mesh = mesh(&CUBE, &CUBE_FACES, Motion::Rigid);
    let mut neighbours = face_neighbours(&mesh);
    let light = DVec3::new(3.0, 0.4, 0.6);
    assert_eq!(drawn_by_indices(&mesh, &neighbours, light), by_definition(&mesh, light), "each once");
    neighbours[8].across_ab = ACROSS_NEVER;
    assert_ne!(drawn_by_indices(&mesh, &neighbours, light), by_definition(&mesh, light), "a lost edge is found");
}

#[test]
fn a_neighbour_that_is_not_its_own_is_found() {
    let mesh = mesh(&CUBE, &CUBE_FACES, Motion::Rigid);
    let mut stream = stream(&mesh);
    let light = DVec3::new(3.0, 0.4, 0.6);
    assert_eq!(said_by_faces(&stream, light), by_definition(&mesh, light));
    let [first, second, third] = stream.faces[8].neighbour_normals;
    stream.faces[8].neighbour_normals = [third, first, second];
    assert_ne!(said_by_faces(&stream, light), by_definition(&mesh, light));
}

#[test]
fn many_faces_at_an_edge_draw_it_rather_too_often() {
    // Three, four and five faces on the edge from 0 to 1.
    let mut positions = vec![[0.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
    positions.extend([[1.0, 1.0, 0.1], [0.2, 1.0, 1.0], [-1.0, 1.0, 0.3], [-0.4, 1.0, -1.0], [0.7, 1.0, -0.8]]);
    for count in 3..=5 {
        let triangles: Vec<_> = (0..count).map(|index| [index % 2, 1 - index % 2, 2 + index]).collect();
        let mesh = mesh(&positions, &triangles, Motion::Rigid);
        let stream = stream(&mesh);
        assert_eq!(stream.overdrawn_edges, 1);
        let mut more = 0;
        for light in lights() {
            let (said, defined) = (said_by_faces(&stream, light), by_definition(&mesh, light));
            assert!(defined.iter().all(|edge| said.contains(edge)), "{count} faces, light at {light}");
            more += said.len() - defined.len();
        }
        // An odd number of signs never adds up to zero, so here the edge is in the silhouette, if not in the outline.
        assert_eq!(more > 0, count == 4, "{count} faces");
    }
}

#[test]
fn both_sides_of_a_sheet_agree() {
    let sheet = [[0, 1, 2], [1, 0, 3]];
    let both_sides = [sheet, sheet.map(|[a, b, c]| [b, a, c])].concat();
    let positions = [[0.0, 0.0, 0.0], [0.0, 2.0, 0.0], [1.0, 1.0, 0.1], [-0.4, 1.0, 1.0]];
    let mesh = mesh(&positions, &both_sides, Motion::Rigid);
    let stream = stream(&mesh);
    assert_eq!(stream.overdrawn_edges, 0);
    assert!(lights().all(|light| said_by_faces(&stream, light) == by_definition(&mesh, light)));
}

#[test]
fn a_fan_of_many_faces_is_asked_face_by_face() {
    let mut positions = vec![[0.0, 0.0, 0.0], [0.0, 2.0, 0.0]];
    positions.extend((0..100_000).map(|index| [1.0, index as f32, 1.0]));
    let triangles: Vec<_> = (0..100_000).map(|index| [0, 1, 2 + index]).collect();
    let stream = stream(&mesh(&positions, &triangles, Motion::Rigid));
    assert_eq!((stream.faces.len(), stream.overdrawn_edges), (100_000, 1));
}

#[test]
fn faces_without_silhouette_are_left_out() {
    // A plate of 4 x 4 squares. Its 16 border edges are always in the silhouette; two of its faces have two of them.
    let positions: Vec<_> = (0..25).map(|index| [(index % 5) as f32, (index / 5) as f32, 0.0]).collect();
    let squares = (0..16).map(|index| index / 4 * 5 + index % 4);
    let triangles: Vec<_> =
        squares.flat_map(|corner| [[corner, corner + 1, corner + 6], [corner, corner + 6, corner + 5]]).collect();
    let rigid = stream(&mesh(&positions, &triangles, Motion::Rigid));
    assert_eq!((rigid.faces.len(), rigid.never_silhouette_faces), (14, 18));
    let deforming = stream(&mesh(&positions, &triangles, Motion::Deforming));
    assert_eq!((deforming.faces.len(), deforming.never_silhouette_faces), (32, 0));
    check(&positions, &triangles);
    let [first, _, third] = rigid.faces[0].neighbour_normals;
    assert_eq!((rigid.face_ids[0], first, third), (0, [0.0, 0.0, -4.0], [0.0; 3]));
}

#[test]
fn faces_without_area_are_left_out() {
    let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0]];
    let stream = stream(&mesh(&positions, &[[0, 1, 1], [0, 1, 3], [0, 1, 2]], Motion::Rigid));
    assert_eq!((&stream.face_ids[..], stream.faces_without_area), (&[2][..], 2));
}

#[test]
fn bytes_are_those_of_the_faces() {
    let mesh = mesh(&CUBE, &CUBE_FACES, Motion::Rigid);
    let stream = TamStream::new(&mesh, &TamOptions { origin: [0.5; 3], scale: 2.0 });
    let numbers = |face: &TamFace| [face.corners, face.neighbour_normals].concat().concat();
    assert!(stream.faces.iter().all(|face| face.corners.as_flattened().iter().all(|number| number.abs() == 1.0)));

    let faces = stream.bytes(TamForm::Faces, TamPrecision::Full).expect("finite");
    let read: Vec<f32> = bytemuck::pod_collect_to_vec(&faces);
    assert_eq!(read, stream.faces.iter().flat_map(numbers).collect::<Vec<_>>());

    // Own position, corners, normals, and three numbers that fill the item.
    let items = stream.bytes(TamForm::Items, TamPrecision::Half).expect("small");
    assert_eq!(items.len(), 12 * TamForm::Items.face_bytes(TamPrecision::Half));
    let read: Vec<f16> = bytemuck::pod_collect_to_vec(&items);
    for (index, item) in read.chunks(24).enumerate() {
        let face = &stream.faces[index / 3];
        let expected = [face.corners[index % 3].to_vec(), numbers(face), vec![0.0; 3]].concat();
        assert_eq!(item.iter().map(|half| half.to_f32()).collect::<Vec<_>>(), expected);
    }
    for (form, precision, bytes) in [
        (TamForm::Items, TamPrecision::Full, 252),
        (TamForm::Items, TamPrecision::Half, 144),
        (TamForm::Faces, TamPrecision::Full, 72),
        (TamForm::Faces, TamPrecision::Half, 36),
    ] {
        assert_eq!(form.face_bytes(precision), bytes);
        assert_eq!(stream.bytes(form, precision).expect("small").len(), 12 * bytes);
    }
}

#[test]
fn halves_refuse_what_is_too_large() {
    let far = CUBE.map(|position| position.map(|number| number + 70_000.0));
    let mesh = mesh(&far, &CUBE_FACES, Motion::Rigid);
    let error = stream(&mesh).bytes(TamForm::Faces, TamPrecision::Half).expect_err("beyond 65504");
    assert_eq!(error, TamError::BeyondHalf { face: 0, coordinate: 70_000.0 });
    let stream = TamStream::new(&mesh, &TamOptions { origin: [70_000.0; 3], scale: 1.0 });
    assert!(stream.bytes(TamForm::Faces, TamPrecision::Half).is_ok());
}

#[test]
fn memory_is_told_against_both_baselines() {
    let mesh = mesh(&CUBE, &CUBE_FACES, Motion::Rigid);
    let memory = stream(&mesh).memory(TamForm::Faces, TamPrecision::Full, &mesh.report);
    assert_eq!((memory.face_bytes, memory.bytes, memory.of_unindexed), (72, 864, 0.75));
    assert_eq!(memory.of_indexed, 864.0 / (8.0 * 32.0 + 12.0 * 12.0));
    let empty = TopologyAwareMesh::build(&[], &[], &BuildOptions::default()).expect("nothing is sound");
    assert_eq!(stream(&empty).memory(TamForm::Items, TamPrecision::Half, &empty.report).of_unindexed, 0.0);
}
