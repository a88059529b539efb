//! Connected parts of a mesh.

use contrejour_layout::Edge;

/// Number of sets of edges that hang together by their vertices.
pub(super) fn count_components(edges: &[Edge], vertex_count: usize) -> u32 {
    let mut parents: Vec<u32> = (0..vertex_count as u32).collect();
    let mut vertices_with_edges = vec![false; vertex_count];
    let mut joined = 0;
    for edge in edges {
        vertices_with_edges[edge.low_vertex as usize] = true;
        vertices_with_edges[edge.high_vertex as usize] = true;
        let (low, high) = (root(&mut parents, edge.low_vertex), root(&mut parents, edge.high_vertex));
        if low != high {
            parents[low.max(high) as usize] = low.min(high);
            joined += 1;
        }
    }
    vertices_with_edges.into_iter().map(u32::from).sum::<u32>() - joined
}

/// The vertex that stands for the set; halves the way to it, so that later searches are short.
fn root(parents: &mut [u32], mut vertex: u32) -> u32 {
    while parents[vertex as usize] != vertex {
        let grandparent = parents[parents[vertex as usize] as usize];
        parents[vertex as usize] = grandparent;
        vertex = grandparent;
    }
    vertex
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edge(low_vertex: u32, high_vertex: u32) -> Edge {
        Edge { low_vertex, high_vertex, first: 0, second: 0 }
    }

    #[test]
    fn parts_are_joined_late_and_loose_vertices_are_none() {
        //  0 - 1   2 - 3   4   5 - 6      then 1 - 3
        let mut edges = vec![edge(0, 1), edge(2, 3), edge(5, 6)];
        assert_eq!(count_components(&edges, 7), 3);
        edges.push(edge(1, 3));
        edges.push(edge(0, 2));
        assert_eq!(count_components(&edges, 7), 2);
        assert_eq!(count_components(&[], 7), 0);
    }
}
