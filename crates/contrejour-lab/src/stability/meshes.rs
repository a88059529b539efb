//! Meshes that several families share.

use glam::DVec3;

use super::case::CaseMesh;
use crate::torus;

/// Distance from the middle of [`ring`] to its farthest vertex.
pub(super) const RING_RADIUS: f64 = 1.4;

/// A torus of 768 faces around the y axis, scaled and then moved, rounded once.
pub(super) fn ring(scale: f64, offset: DVec3) -> CaseMesh {
    let torus = torus(24, 16);
    let place = |position: [f32; 3]| scale * DVec3::from(position.map(f64::from)) + offset;
    let positions = torus.positions.into_iter().map(|position| place(position).as_vec3().to_array()).collect();
    CaseMesh::new(positions, torus.triangles)
}

/// A box from -1 to 1 with so many squares of two faces along each edge, each vertex placed and rounded once.
pub(super) fn box_of(squares: u32, place: impl Fn(DVec3) -> DVec3) -> CaseMesh {
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for (axis, along, across) in
        [(DVec3::X, DVec3::Y, DVec3::Z), (DVec3::Y, DVec3::Z, DVec3::X), (DVec3::Z, DVec3::X, DVec3::Y)]
    {
        for side in [1.0, -1.0] {
            let first = positions.len() as u32;
            let share = |index: u32| 2.0 * f64::from(index) / f64::from(squares) - 1.0;
            for i in 0..=squares {
                for j in 0..=squares {
                    let position = side * (axis + share(j) * across) + share(i) * along;
                    positions.push(place(position).as_vec3().to_array());
                }
            }
            let at = |i: u32, j: u32| first + i * (squares + 1) + j;
            for (i, j) in (0..squares).flat_map(|i| (0..squares).map(move |j| (i, j))) {
                let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
                triangles.extend([[a, b, c], [a, c, d]]);
            }
        }
    }
    CaseMesh::new(positions, triangles)
}

#[cfg(test)]
mod tests {
    use contrejour_mesh::{BuildOptions, TopologyAwareMesh};

    use super::*;

    #[test]
    fn the_meshes_are_closed_and_face_outwards() {
        for mesh in [ring(1.0, DVec3::ZERO), box_of(3, |position| position)] {
            let mesh = TopologyAwareMesh::build(&mesh.positions, &mesh.triangles, &BuildOptions::default());
            let report = mesh.expect("a good mesh").report;
            assert!(report.closed && report.oriented && report.manifold, "{report}");
            assert!(report.convex_edges > report.concave_edges, "{report}");
        }
    }
}
