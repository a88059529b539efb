//! Meshes that are not as they should be, and meshes with next to nothing.

use glam::DVec3;

use super::super::case::{Case, CaseMesh};
use super::super::effort::Effort;
use super::super::family::Family;
use super::super::lights::both;
use super::super::meshes::{RING_RADIUS, ring};
use crate::report::Scale;

pub(super) const BROKEN: Family = Family {
    name: "broken-meshes",
    stresses: "Doubled, flipped, torn, T-joined, self-intersecting and non-manifold meshes, and faces without area.",
    parameter: "the mesh's number",
    scale: Scale::Linear,
    cases: broken,
};

pub(super) const FEW: Family = Family {
    name: "few-faces",
    stresses: "No, one and two faces.",
    parameter: "the mesh's number",
    scale: Scale::Linear,
    cases: few,
};

fn broken(effort: &Effort) -> Vec<Case> {
    let ring = ring(1.0, DVec3::ZERO);
    let flipped = |[a, b, c]: [u32; 3]| [a, c, b];
    let mut random = fastrand::Rng::with_seed(effort.seed);
    let with = |triangles: Vec<[u32; 3]>| CaseMesh::new(ring.positions.clone(), triangles);
    let all = || ring.triangles.iter().copied();
    let soup = |random: &mut fastrand::Rng| -> Vec<[u32; 3]> {
        (0..300).map(|_| [(); 3].map(|()| random.u32(0..60))).collect()
    };
    let meshes = [
        ("doubled", with(all().chain(all()).collect())),
        ("doubled and flipped", with(all().chain(all().map(flipped)).collect())),
        ("inside out", with(all().map(flipped).collect())),
        (
            "every fifth face flipped",
            with((0..).zip(all()).map(|(i, f)| if i % 5 == 0 { flipped(f) } else { f }).collect()),
        ),
        ("every seventh face lost", with((0..).zip(all()).filter(|(i, _)| i % 7 != 0).map(|(_, face)| face).collect())),
        ("three of four corners shared", unwelded(&ring)),
        ("T-joined", t_joined()),
        ("crossing itself", crossing(&ring)),
        ("three sheets at an edge", sheets(3)),
        ("nine sheets at an edge", sheets(9)),
        ("soup", with(soup(&mut random))),
        (
            "faces that name a vertex twice",
            with(all().flat_map(|[a, b, c]| [[a, b, c], [a, a, b], [c, c, c]]).collect()),
        ),
        ("a strip of faces without area", collapsed()),
    ];
    numbered(&meshes, RING_RADIUS)
}

fn few(_effort: &Effort) -> Vec<Case> {
    let square = vec![[-0.5, 0.0, 0.5], [0.5, 0.0, 0.5], [0.5, 0.0, -0.5], [-0.5, 0.1, -0.5]];
    let with = |triangles: &[[u32; 3]]| CaseMesh::new(square.clone(), triangles.to_vec());
    let meshes = [
        ("nothing at all", CaseMesh::new(Vec::new(), Vec::new())),
        ("vertices and no face", with(&[])),
        ("one face", with(&[[0, 1, 2]])),
        ("one face without area", with(&[[0, 1, 1]])),
        ("two faces", with(&[[0, 1, 2], [0, 2, 3]])),
        ("one face from both sides", with(&[[0, 1, 2], [0, 2, 1]])),
        ("two faces wound by turns", with(&[[0, 1, 2], [0, 3, 2]])),
    ];
    numbered(&meshes, 0.8)
}

/// A case a mesh and light, also in quick runs: each mesh is another kind of fault.
fn numbered(meshes: &[(&str, CaseMesh)], radius: f64) -> Vec<Case> {
    let cases = meshes.iter().enumerate().flat_map(|(number, (name, mesh))| {
        both(DVec3::ZERO, radius)
            .map(|(light_name, light)| Case::new(format!("{name}, {light_name}"), number as f64, mesh.clone(), light))
    });
    cases.collect()
}

/// Every fourth corner is a vertex of its own, a little beside the others.
fn unwelded(mesh: &CaseMesh) -> CaseMesh {
    let mut positions = mesh.positions.clone();
    let corners = mesh.triangles.iter().flatten().enumerate().map(|(index, &vertex)| {
        if index % 4 != 0 {
            return vertex;
        }
        let [x, y, z] = mesh.positions[vertex as usize];
        positions.push([x + 1e-3, y, z - 1e-3]);
        positions.len() as u32 - 1
    });
    let corners: Vec<u32> = corners.collect();
    let triangles = corners.chunks_exact(3).map(|corners| [corners[0], corners[1], corners[2]]).collect();
    CaseMesh::new(positions, triangles)
}

/// ```text
///   3-------2
///   | \   / |
///   |  \ /  |
///   0---4---1    above with the vertex 4, below without
///    \     /
///      \ /
///       5
/// ```
fn t_joined() -> CaseMesh {
    let positions =
        vec![[-0.7, 0.0, 0.0], [0.7, 0.0, 0.0], [0.7, 0.3, -0.7], [-0.7, 0.3, -0.7], [0.0, 0.0, 0.0], [0.0, 0.3, 0.7]];
    CaseMesh::new(positions, vec![[0, 4, 3], [4, 2, 3], [4, 1, 2], [0, 5, 1]])
}

/// The ring and the ring turned by a quarter around the x axis, in one mesh.
fn crossing(ring: &CaseMesh) -> CaseMesh {
    let first = ring.positions.len() as u32;
    let turned = ring.positions.iter().map(|&[x, y, z]| [x, -z, y]);
    let positions = ring.positions.iter().copied().chain(turned).collect();
    let again = ring.triangles.iter().map(|face| face.map(|vertex| first + vertex));
    CaseMesh::new(positions, ring.triangles.iter().copied().chain(again).collect())
}

/// Sheets around one edge, like the pages of a book.
fn sheets(count: u32) -> CaseMesh {
    let mut positions = vec![[0.0, 0.0, -0.6], [0.0, 0.0, 0.6]];
    positions.extend((0..count).map(|index| {
        let (sin, cos) = (0.3 + std::f32::consts::TAU * index as f32 / count as f32).sin_cos();
        [0.8 * cos, 0.8 * sin, 0.1]
    }));
    CaseMesh::new(positions, (0..count).map(|index| [0, 1, 2 + index]).collect())
}

/// Two sheets with a strip between them whose faces all lie on one line.
fn collapsed() -> CaseMesh {
    let mut positions = Vec::new();
    for index in 0..9_u8 {
        positions.push([0.125 * f32::from(index) - 0.5, 0.0, 0.0]);
    }
    positions.extend([[0.0, 0.4, -0.6], [0.0, 0.2, 0.6]]);
    let mut triangles: Vec<[u32; 3]> = (0..8).map(|index| [index, index + 1, 9]).collect();
    triangles.extend((1..8).map(|index| [0, index + 1, index]));
    triangles.push([0, 10, 8]);
    CaseMesh::new(positions, triangles)
}
