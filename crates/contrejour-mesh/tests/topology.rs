//! Topology of small meshes that can be checked by hand.

use contrejour_layout::{INCIDENCE_ALONG, UNLIT_FACE, incidence};
use contrejour_mesh::{
    BuildOptions, EdgeClass, Findings, Motion, Partner, TopologyAwareMesh, TopologyError, incidence_words,
};

fn build(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> TopologyAwareMesh {
    build_with(positions, triangles, &BuildOptions::default())
}

fn build_with(positions: &[[f32; 3]], triangles: &[[u32; 3]], options: &BuildOptions) -> TopologyAwareMesh {
    let mesh = TopologyAwareMesh::build(positions, triangles, options).expect("the mesh is sound");
    check_lists(&mesh);
    check_closed(&mesh);
    mesh
}

/// Vertex edges list each candidate edge at both its ends, and nothing else.
fn check_lists(mesh: &TopologyAwareMesh) {
    assert_eq!(mesh.edge_classes.len(), mesh.edges.len());
    assert_eq!(mesh.vertex_edge_offsets.len(), mesh.positions.len() + 1);
    assert_eq!(mesh.vertex_edges.len(), 2 * mesh.candidate_edge_count as usize);
    for (range, vertex) in mesh.vertex_edge_offsets.windows(2).zip(0..) {
        let listed = &mesh.vertex_edges[range[0] as usize..range[1] as usize];
        assert!(listed.is_sorted_by(|one, next| one.edge_id < next.edge_id));
        for entry in listed {
            assert!(entry.edge_id < mesh.candidate_edge_count);
            let edge = mesh.edges[entry.edge_id as usize];
            assert!(
                [[vertex, entry.other_vertex], [entry.other_vertex, vertex]]
                    .contains(&[edge.low_vertex, edge.high_vertex])
            );
        }
    }
    let by_vertices = |edges: &[contrejour_layout::Edge]| {
        edges.is_sorted_by(|one, next| (one.low_vertex, one.high_vertex) < (next.low_vertex, next.high_vertex))
    };
    let (candidates, others) = mesh.edges.split_at(mesh.candidate_edge_count as usize);
    assert!(by_vertices(candidates) && by_vertices(others));
    assert_eq!(mesh.report.never_silhouette_edges as usize, others.len());
}

/// Signed multiplicity of an edge for the signs of faces with area.
fn multiplicity(mesh: &TopologyAwareMesh, edge_id: usize, sign: impl Fn(u32) -> i32) -> i32 {
    incidence_words(&mesh.edges[edge_id], &mesh.incidences)
        .iter()
        .map(|word| {
            let sign = if word >> 1 == UNLIT_FACE { -1 } else { sign(word >> 1) };
            if word & INCIDENCE_ALONG != 0 { sign } else { -sign }
        })
        .sum()
}

/// At every vertex the multiplicities that arrive are those that leave, whatever the signs are.
fn check_closed(mesh: &TopologyAwareMesh) {
    for pattern in 0..16u32 {
        let sign = |face: u32| if (face ^ pattern).wrapping_mul(0x9e37_79b9) >> 31 == 0 { 1 } else { -1 };
        let mut balance = vec![0; mesh.positions.len()];
        for (edge_id, edge) in mesh.edges.iter().enumerate() {
            let multiplicity = multiplicity(mesh, edge_id, sign);
            balance[edge.low_vertex as usize] -= multiplicity;
            balance[edge.high_vertex as usize] += multiplicity;
        }
        assert!(balance.iter().all(|&sum| sum == 0), "signs {pattern}: {balance:?}");
    }
}

fn edge_between(mesh: &TopologyAwareMesh, low: u32, high: u32) -> usize {
    mesh.edges.iter().position(|edge| [edge.low_vertex, edge.high_vertex] == [low, high]).expect("the edge exists")
}

fn words(mesh: &TopologyAwareMesh, low: u32, high: u32) -> &[u32] {
    incidence_words(&mesh.edges[edge_between(mesh, low, high)], &mesh.incidences)
}

fn class(mesh: &TopologyAwareMesh, low: u32, high: u32) -> EdgeClass {
    mesh.edge_classes[edge_between(mesh, low, high)]
}

fn is_candidate(mesh: &TopologyAwareMesh, low: u32, high: u32) -> bool {
    edge_between(mesh, low, high) < mesh.candidate_edge_count as usize
}

fn found<Id: Clone>(ids: &[Id]) -> Findings<Id> {
    Findings { count: ids.len() as u32, first: ids.to_vec() }
}

const TETRAHEDRON: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

#[test]
fn a_tetrahedron_is_convex_and_inside_out_concave() {
    let outward = [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
    let mesh = build(&TETRAHEDRON, &outward);
    assert!(mesh.edge_classes.iter().all(|&class| class == EdgeClass::Convex), "{:?}", mesh.edge_classes);
    assert_eq!((mesh.report.edges, mesh.report.convex_edges, mesh.report.components), (6, 6, 1));
    assert!(mesh.report.closed && mesh.report.manifold && mesh.report.oriented);
    assert_eq!((mesh.bounds_min, mesh.bounds_max), ([0.0; 3], [1.0; 3]));
    assert_eq!(words(&mesh, 0, 1), [incidence(0, false), incidence(1, true)]);

    let mesh = build(&TETRAHEDRON, &outward.map(|[a, b, c]| [a, c, b]));
    assert!(mesh.edge_classes.iter().all(|&class| class == EdgeClass::Concave), "{:?}", mesh.edge_classes);
}

// 3---2
// | / |
// 0---1
const SQUARE: [[f32; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];

#[test]
fn the_diagonal_of_a_square_is_left_out_while_it_is_rigid() {
    let triangles = [[0, 1, 2], [0, 2, 3]];
    let mesh = build(&SQUARE, &triangles);
    assert_eq!((mesh.edges.len(), mesh.candidate_edge_count), (5, 4));
    assert_eq!(class(&mesh, 0, 2), EdgeClass::Coplanar);
    assert!(!is_candidate(&mesh, 0, 2));
    assert_eq!(mesh.report.border_edges, found(&[[0, 1], [0, 3], [1, 2], [2, 3]]));

    let mesh = build_with(&SQUARE, &triangles, &BuildOptions { motion: Motion::Deforming, ..Default::default() });
    assert_eq!(mesh.candidate_edge_count, 5);
    assert_eq!(class(&mesh, 0, 2), EdgeClass::Coplanar);

    // The smallest bend there is makes it a candidate again.
    let mut bent = SQUARE;
    bent[3][2] = -f32::from_bits(1);
    let mesh = build(&bent, &triangles);
    assert_eq!((class(&mesh, 0, 2), mesh.candidate_edge_count), (EdgeClass::Convex, 5));
}

#[test]
fn a_square_folded_flat_keeps_its_fold() {
    // 2       3 lies where 1 is seen from the diagonal: both triangles are on the same side of it.
    // | \
    // 0--1/3
    let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [2.0, 0.0, 0.0]];
    let mesh = build(&positions, &[[0, 1, 2], [0, 2, 3]]);
    assert_eq!(class(&mesh, 0, 2), EdgeClass::Coplanar);
    assert!(is_candidate(&mesh, 0, 2));
}

#[test]
fn faces_wound_against_each_other_are_flipped() {
    let mesh = build(&SQUARE, &[[0, 1, 2], [0, 3, 2]]);
    assert_eq!(class(&mesh, 0, 2), EdgeClass::Flipped);
    assert!(is_candidate(&mesh, 0, 2));
    assert_eq!(mesh.report.flipped_edges, found(&[[0, 2]]));
    assert!(!mesh.report.oriented);
}

#[test]
fn a_fan_of_three_is_non_manifold_and_loses_no_face() {
    // Pages 2, 3 and 4 of a book whose spine is 0-1.
    let positions = [[0.0; 3], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.0]];
    let mesh = build(&positions, &[[0, 1, 2], [1, 0, 3], [0, 1, 4]]);
    assert_eq!(class(&mesh, 0, 1), EdgeClass::NonManifold);
    assert_eq!(words(&mesh, 0, 1), [incidence(0, true), incidence(1, false), incidence(2, true)]);
    assert_eq!(mesh.report.most_faces_at_an_edge, 3);
    assert_eq!(mesh.report.non_manifold_edges, found(&[[0, 1]]));
    assert!(!mesh.report.manifold);
}

#[test]
fn a_moebius_strip_is_flipped_somewhere() {
    // Five squares in a ring, each from rung i to rung i + 1; the last meets the first upside down.
    let rungs = 5u32;
    let positions: Vec<[f32; 3]> = (0..rungs)
        .flat_map(|rung| {
            let turn = std::f32::consts::TAU * rung as f32 / rungs as f32;
            [-0.5, 0.5].map(|side: f32| {
                let radius = 2.0 + side * (turn / 2.0).cos();
                [radius * turn.cos(), radius * turn.sin(), side * (turn / 2.0).sin()]
            })
        })
        .collect();
    let triangles: Vec<[u32; 3]> = (0..rungs)
        .flat_map(|rung| {
            let (a, b) = (2 * rung, 2 * rung + 1);
            let (c, d) = if rung + 1 < rungs { (a + 2, b + 2) } else { (1, 0) };
            [[a, c, d], [a, d, b]]
        })
        .collect();
    let mesh = build(&positions, &triangles);
    assert_eq!(mesh.report.flipped_edges, found(&[[0, 1]]));
    assert_eq!((mesh.report.border_edges.count, mesh.report.edges), (2 * rungs, 4 * rungs));
}

#[test]
fn a_box_of_separate_sides_is_welded_across_both_zeros() {
    // Each side has corners of its own, and its zeros have the sign of its normal.
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for axis in 0..3 {
        for (at, zero) in [(0.0f32, -0.0f32), (1.0, 0.0)] {
            let first = positions.len() as u32;
            for (u, v) in [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0f32)] {
                let mut corner = [0.0; 3];
                corner[axis] = at;
                corner[(axis + 1) % 3] = u;
                corner[(axis + 2) % 3] = v;
                positions.push(corner.map(|x| if x == 0.0 { zero } else { x }));
            }
            let [a, b, c, d] = [first, first + 1, first + 2, first + 3];
            triangles.extend(if at > 0.5 { [[a, b, c], [a, c, d]] } else { [[a, c, b], [a, d, c]] });
        }
    }
    let mesh = build(&positions, &triangles);
    let report = &mesh.report;
    assert_eq!((report.vertices, report.used_vertices, report.welded_vertices), (24, 8, 16));
    assert_eq!((report.edges, report.convex_edges, report.coplanar_edges), (18, 12, 6));
    assert_eq!((report.never_silhouette_edges, mesh.candidate_edge_count), (6, 12));
    assert!(report.closed && report.manifold && report.oriented);
}

#[test]
fn a_face_that_names_a_vertex_twice_cancels_itself() {
    let mut positions = SQUARE.to_vec();
    positions.push(SQUARE[1]);
    let mesh = build(&positions, &[[0, 1, 2], [1, 2, 4], [0, 2, 3], [3, 3, 3]]);
    assert_eq!(mesh.report.repeated_vertex_faces, found(&[1, 3]));
    assert_eq!((mesh.report.edges, mesh.report.faces), (5, 4));
    assert_eq!(words(&mesh, 0, 2), [incidence(0, false), incidence(2, true)]);
    assert!(mesh.partners.is_empty());
}

#[test]
fn duplicates_are_counted_once_each_in_any_order_of_corners() {
    let mesh = build(&SQUARE, &[[0, 1, 2], [2, 0, 1], [1, 0, 2], [0, 2, 3], [3, 2, 0]]);
    assert_eq!(mesh.report.duplicate_faces, found(&[1, 2, 4]));
    // A pair that has all its edges for itself: consistently wound, and flipped.
    assert_eq!(build(&SQUARE, &[[0, 1, 2], [0, 2, 1]]).report.duplicate_faces, found(&[1]));
    assert_eq!(build(&SQUARE, &[[3, 1, 2], [1, 2, 3]]).report.duplicate_faces, found(&[1]));
}

#[test]
fn unused_vertices_are_counted_and_out_of_bounds() {
    let mut positions = SQUARE.to_vec();
    positions.extend([[9.0; 3], [0.0; 3]]);
    let mesh = build(&positions, &[[5, 1, 2]]);
    assert_eq!(mesh.report.unused_vertices, found(&[0, 3, 4]));
    assert_eq!((mesh.report.used_vertices, mesh.report.welded_vertices), (3, 1));
    assert_eq!(mesh.faces[0].a, 0);
    assert_eq!(mesh.bounds_max, [1.0, 1.0, 0.0]);
}

//      3
//    /   \
//  0---4---1     0, 4 and 1 are on one line: the face [0, 4, 1] or [0, 1, 4] fills the T between the face above
//    \   /       and the two below.
//      2
const T_JUNCTION: [[f32; 3]; 5] = [[0.0; 3], [4.0, 0.0, 0.0], [2.0, -1.0, 0.0], [2.0, 1.0, 1.0], [1.0, 0.0, 0.0]];

#[test]
fn a_face_without_area_takes_the_sign_across_its_longest_edge() {
    for (sliver, negated) in [([0, 4, 1], false), ([1, 4, 0], true)] {
        let mesh = build(&T_JUNCTION, &[[0, 1, 3], [2, 4, 0], [2, 1, 4], sliver]);
        assert_eq!(mesh.partners, [Partner { face: 3, of: Some(0), negated }]);
        assert_eq!(mesh.report.zero_area_faces, found(&[3]));
        assert_eq!(mesh.report.unlit_faces.count, 0);
        // Its longest edge is in no silhouette, and its short ones meet the lower faces with the sign of face 0.
        assert_eq!(words(&mesh, 0, 1), [incidence(0, true), incidence(0, false)]);
        assert_eq!(words(&mesh, 0, 4), [incidence(1, false), incidence(0, true)]);
        assert_eq!(words(&mesh, 1, 4), [incidence(2, true), incidence(0, false)]);
    }
}

#[test]
fn chains_of_faces_without_area_are_followed_to_their_end() {
    //      6
    //    /   \
    // 0-2--4--1     Face 1 is [0, 4, 1] and face 2 is [0, 2, 4], its longest edge at face 1; face 3 hangs below.
    let x = |x: f32| [x, 0.0, 0.0];
    let positions = [x(0.0), x(4.0), x(1.0), [1.0, -1.0, 0.0], x(2.0), [9.0; 3], [2.0, 1.0, 0.0]];
    let mesh = build(&positions, &[[0, 1, 6], [0, 4, 1], [4, 2, 0], [0, 3, 2]]);
    assert_eq!(
        mesh.partners,
        [Partner { face: 1, of: Some(0), negated: false }, Partner { face: 2, of: Some(0), negated: true }]
    );
    assert_eq!(words(&mesh, 0, 2), [incidence(0, true), incidence(3, false)]);

    // Without face 0 the first is unlit, whatever the light; the second is wound against it, and takes the opposite.
    let mesh = build(&positions, &[[0, 4, 1], [4, 2, 0], [0, 3, 2]]);
    assert_eq!(
        mesh.partners,
        [Partner { face: 0, of: None, negated: false }, Partner { face: 1, of: None, negated: true }]
    );
    assert_eq!(mesh.report.unlit_faces, found(&[0]));
    assert_eq!(words(&mesh, 0, 1), [incidence(UNLIT_FACE, false)]);
    // Both run from 0 to 4: no silhouette.
    assert_eq!(words(&mesh, 0, 4), [incidence(UNLIT_FACE, true), incidence(UNLIT_FACE, false)]);
}

#[test]
fn faces_without_area_that_only_have_each_other_are_unlit() {
    let x = |x: f32| [x, 0.0, 0.0];
    let mesh = build(&[x(0.0), x(1.0), x(2.0), x(3.0)], &[[0, 1, 3], [3, 2, 0]]);
    assert_eq!(mesh.report.unlit_faces, found(&[0, 1]));
    assert_eq!((mesh.report.coplanar_edges, mesh.candidate_edge_count), (1, 5));
    assert_eq!(words(&mesh, 0, 3), [incidence(UNLIT_FACE, false), incidence(UNLIT_FACE, true)]);
}

#[test]
fn two_faces_across_the_longest_edge_are_no_partner() {
    let x = |x: f32| [x, 0.0, 0.0];
    let positions = [x(0.0), x(1.0), x(2.0), [1.0, 1.0, 0.0], [1.0, -1.0, 0.0]];
    let mesh = build(&positions, &[[0, 1, 2], [0, 2, 3], [0, 2, 4]]);
    assert_eq!(mesh.partners, [Partner { face: 0, of: None, negated: false }]);
    assert_eq!(words(&mesh, 0, 2).len(), 3);
}

#[test]
fn welding_by_distance_closes_a_gap() {
    let gap = [SQUARE[0], SQUARE[1], SQUARE[2], [0.001, 0.0, 0.0], [1.0, 1.001, 0.0], SQUARE[3]];
    let triangles = [[0, 1, 2], [3, 4, 5]];
    assert_eq!(build(&gap, &triangles).report.border_edges.count, 6);
    let mesh = build_with(&gap, &triangles, &BuildOptions { weld_distance: Some(0.01), ..Default::default() });
    assert_eq!((mesh.report.border_edges.count, mesh.report.welded_vertices), (4, 2));
    assert_eq!(mesh.positions, gap);
}

#[test]
fn weld_data_keeps_a_seam_that_can_open() {
    let seam = [SQUARE[0], SQUARE[1], SQUARE[2], SQUARE[0], SQUARE[2], SQUARE[3]];
    let triangles = [[0, 1, 2], [3, 4, 5]];
    let with_bones = |bones: &[u8]| {
        let options = BuildOptions { motion: Motion::Deforming, weld_data: Some(bones), ..Default::default() };
        build_with(&seam, &triangles, &options).report.border_edges.count
    };
    assert_eq!(with_bones(&[7; 6]), 4);
    assert_eq!(with_bones(&[7, 7, 7, 8, 8, 8]), 6);
}

#[test]
fn bad_input_is_named() {
    let error = |positions: &[[f32; 3]], triangles: &[[u32; 3]], options: &BuildOptions| {
        TopologyAwareMesh::build(positions, triangles, options).expect_err("the input is bad")
    };
    let default = BuildOptions::default();
    assert_eq!(
        error(&SQUARE, &[[0, 1, 4]], &default).to_string(),
        "face 0 names vertex 4, but there are 4 vertices: correct the index or add the missing vertices"
    );
    let nan = [[0.0, f32::NAN, 0.0]];
    assert!(matches!(error(&nan, &[], &default), TopologyError::NonFinitePosition { vertex: 0, .. }));
    for distance in [-1.0, f32::NAN, f32::INFINITY] {
        let options = BuildOptions { weld_distance: Some(distance), ..default };
        assert!(matches!(error(&SQUARE, &[], &options), TopologyError::WeldDistance { .. }));
    }
    let options = BuildOptions { weld_data: Some(&[0; 6]), ..default };
    assert_eq!(error(&SQUARE, &[], &options), TopologyError::UnevenWeldData { bytes: 6, vertices: 4 });
}

#[test]
fn nothing_is_a_mesh() {
    let mesh = build(&[], &[]);
    assert_eq!((mesh.edges.len(), mesh.vertex_edge_offsets.len()), (0, 1));
    assert!(mesh.report.closed);
    assert_eq!(build(&SQUARE, &[]).report.unused_vertices.count, 4);
}

#[test]
fn a_hub_of_many_faces_is_no_trouble() {
    // A fan of 20 000 faces around vertex 0, and as many faces on the edge 0-1.
    let count = 20_000u32;
    let mut positions = vec![[0.0; 3], [0.0, 0.0, 1.0]];
    positions.extend((0..count).map(|i| [(i % 199) as f32 + 1.0, (i / 199) as f32, 0.0]));
    let fan = (2..count + 1).map(|i| [0, i, i + 1]);
    let book = (2..count + 2).map(|i| [0, 1, i]);
    let mesh = build(&positions, &fan.chain(book).collect::<Vec<_>>());
    assert_eq!(mesh.report.most_faces_at_an_edge, count);
    assert_eq!(words(&mesh, 0, 1).len(), count as usize);
}
