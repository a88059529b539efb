//! Meshes of a few faces, each with one thing that can go wrong.

use super::TestMesh;
use crate::random::Random;

const TETRAHEDRON: [[f32; 3]; 4] = [[1.0, 1.0, 1.0], [-1.0, -1.0, 1.0], [-1.0, 1.0, -1.0], [1.0, -1.0, -1.0]];
const TETRAHEDRON_FACES: [[u32; 3]; 4] = [[0, 1, 3], [0, 2, 1], [0, 3, 2], [1, 2, 3]];

/// All of them.
pub fn tiny() -> Vec<TestMesh> {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let doubled: Vec<_> = TETRAHEDRON_FACES.iter().flat_map(|&[a, b, c]| [[a, b, c], [a, c, b]]).collect();
    vec![
        TestMesh::generated("no face", &[], &[]),
        TestMesh::generated("vertices and no face", &square, &[]),
        TestMesh::generated("one face", &square, &[[0, 1, 2]]),
        TestMesh::generated("square", &square, &[[0, 1, 2], [0, 2, 3]]),
        TestMesh::generated("square with one face flipped", &square, &[[0, 1, 2], [0, 3, 2]]),
        TestMesh::generated("one face twice", &square, &[[0, 1, 2], [1, 2, 0]]),
        TestMesh::generated("one face from both sides", &square, &[[0, 1, 2], [0, 2, 1]]),
        TestMesh::generated("tetrahedron", &TETRAHEDRON, &TETRAHEDRON_FACES),
        TestMesh::generated("open tetrahedron", &TETRAHEDRON, &TETRAHEDRON_FACES[..3]),
        TestMesh::generated("doubled tetrahedron", &TETRAHEDRON, &doubled),
        TestMesh::generated("seam", &seam_positions(), &[[0, 1, 2], [3, 5, 4]]),
        three_at_an_edge(),
        TestMesh::generated("only faces without area", &[[0.0; 3], [1.0; 3], [2.0; 3]], &[[0, 1, 2], [0, 0, 1]]),
        sliver_between(),
        TestMesh::generated(
            "signed zero",
            &[[0.0; 3], [-0.0, 1.0, 0.0], [1.0, 0.0, -0.0], [0.0, -0.0, 1.0]],
            &[[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]],
        ),
        fan(300),
        soup("soup", 200, |random| (16.0 * random.signed()).round() as f32 / 16.0),
        soup("soup far from the origin", 100, |random| (4096.0 + random.signed()) as f32),
        soup("soup of tiny numbers", 100, |random| (1e-40 * random.signed()) as f32),
        soup("soup of large numbers", 100, |random| (1e30 * random.signed()) as f32),
        soup("soup of any finite numbers", 200, Random::any_finite),
        soup("soup of numbers 2^250 apart", 100, |random| {
            let exponent = if random.below(2) == 0 { 125 } else { -125 };
            (random.signed() * 2.0_f64.powi(exponent)) as f32
        }),
    ]
}

/// The square again, its faces joined only by equal positions.
fn seam_positions() -> [[f32; 3]; 6] {
    let [a, b, c, d] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.5]];
    [a, b, c, a, d, c]
}

/// ```text
///    2   3   4
///     \  |  /
///      \ | /
///       0-1    three sheets at one edge
/// ```
fn three_at_an_edge() -> TestMesh {
    let positions = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 1.0, 0.5], [0.0, 1.5, 0.5], [1.0, 1.0, 0.5]];
    TestMesh::generated("three faces at an edge", &positions, &[[0, 1, 2], [1, 0, 3], [0, 1, 4]])
}

/// ```text
///       3
///      / \
///     /   \
///    0--1--2    face 0 1 2 has no area and lies between face 0 2 3 and the two below
///     \ | /
///      \|/
///       4
/// ```
fn sliver_between() -> TestMesh {
    let positions = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0], [1.0, 2.0, 1.0], [1.0, -2.0, 1.0]];
    TestMesh::generated("face without area between others", &positions, &[[0, 2, 3], [0, 1, 2], [0, 4, 1], [1, 4, 2]])
}

/// A cone of `count` faces around one vertex, more than are searched for a neighbour.
pub fn fan(count: u32) -> TestMesh {
    let rim = (0..count).map(|index| {
        let (sine, cosine) = (f64::from(index) * std::f64::consts::TAU / f64::from(count)).sin_cos();
        [cosine as f32, 0.0, sine as f32]
    });
    let positions: Vec<_> = std::iter::once([0.0, 0.5, 0.0]).chain(rim).collect();
    let triangles: Vec<_> = (0..count).map(|index| [0, 1 + (index + 1) % count, 1 + index]).collect();
    TestMesh::generated(&format!("fan of {count}"), &positions, &triangles)
}

/// Faces between random vertices, so that edges have any number of faces.
fn soup(name: &str, faces: usize, mut coordinate: impl FnMut(&mut Random) -> f32) -> TestMesh {
    let mut random = Random::new(faces as u64);
    let vertices = faces / 4;
    let positions: Vec<_> = (0..vertices).map(|_| [(); 3].map(|()| coordinate(&mut random))).collect();
    let triangles: Vec<_> = (0..faces).map(|_| [(); 3].map(|()| random.below(vertices) as u32)).collect();
    TestMesh::generated(name, &positions, &triangles)
}
