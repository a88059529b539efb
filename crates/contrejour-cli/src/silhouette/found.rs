//! Silhouette edges as they are told: by the vertex numbers of the file.

use std::sync::Arc;

use contrejour_layout::SilhouetteEdge;
use contrejour_mesh::{TopologyAwareMesh, TriangleMesh};
use glam::{DMat4, DVec3};

/// A mesh of a file in its place.
pub struct PlacedMesh<'a> {
    pub mesh: &'a TriangleMesh,
    pub topology: Arc<TopologyAwareMesh>,
    pub world_from_object: DMat4,
}

/// A silhouette edge, from its lower to its higher vertex number.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundEdge {
    pub low: FoundVertex,
    pub high: FoundVertex,
    /// Faces on the left minus faces on the right as seen from the light, from low to high; never 0.
    pub multiplicity: i64,
    /// Whether it has faces on both sides.
    pub is_inner: bool,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FoundVertex {
    /// Its number in the file.
    pub number: u32,
    pub position_world: DVec3,
}

/// The edges, sorted by their numbers.
pub fn found_edges(placed: &[PlacedMesh<'_>], silhouettes: &[SilhouetteEdge]) -> Vec<FoundEdge> {
    let mut found: Vec<FoundEdge> =
        silhouettes.iter().map(|silhouette| found_edge(&placed[silhouette.caster as usize], silhouette)).collect();
    found.sort_by_key(|edge| (edge.low.number, edge.high.number, edge.multiplicity));
    found
}

fn found_edge(placed: &PlacedMesh<'_>, silhouette: &SilhouetteEdge) -> FoundEdge {
    let edge = placed.topology.edges[silhouette.edge_id as usize];
    let vertex = |id: u32| {
        let position = DVec3::from(placed.mesh.positions[id as usize].map(f64::from));
        FoundVertex {
            number: placed.mesh.vertex_numbers[id as usize],
            position_world: placed.world_from_object.transform_point3(position),
        }
    };
    let [low, high] = [edge.low_vertex, edge.high_vertex].map(vertex);
    let multiplicity = i64::from(silhouette.left) - i64::from(silhouette.right);
    let is_inner = silhouette.left > 0 && silhouette.right > 0;
    // The loader may have put the vertices into another order than the file.
    if low.number <= high.number {
        FoundEdge { low, high, multiplicity, is_inner }
    } else {
        FoundEdge { low: high, high: low, multiplicity: -multiplicity, is_inner }
    }
}

#[cfg(test)]
pub mod tests {
    use super::*;
    use contrejour_mesh::BuildOptions;

    /// An edge between two points whose numbers are given.
    pub fn edge(low: (u32, [f64; 3]), high: (u32, [f64; 3]), multiplicity: i64) -> FoundEdge {
        let vertex = |(number, position): (u32, [f64; 3])| FoundVertex { number, position_world: position.into() };
        FoundEdge { low: vertex(low), high: vertex(high), multiplicity, is_inner: false }
    }

    #[test]
    fn the_sign_follows_the_numbers_of_the_file() {
        let mesh = TriangleMesh {
            positions: vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            triangles: vec![[0, 1, 2]],
            vertex_numbers: vec![7, 3, 9],
            ..TriangleMesh::default()
        };
        let topology = TopologyAwareMesh::build(&mesh.positions, &mesh.triangles, &BuildOptions::default())
            .expect("the triangle is fine");
        let edge_id = topology.edges.iter().position(|edge| (edge.low_vertex, edge.high_vertex) == (0, 1));
        let edge_id = edge_id.expect("the triangle has this edge") as u32;
        let world_from_object = DMat4::from_translation(DVec3::Z);
        let placed = [PlacedMesh { mesh: &mesh, topology: Arc::new(topology), world_from_object }];
        let found = found_edges(&placed, &[SilhouetteEdge { caster: 0, edge_id, left: 1, right: 0 }]);
        assert_eq!(found, [edge((3, [1.0, 0.0, 1.0]), (7, [0.0, 0.0, 1.0]), -1)]);
    }
}
