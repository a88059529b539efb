//! The edges around each vertex.

use contrejour_layout::{Edge, VertexEdge};

/// Offsets (one more than there are vertices) and lists: the edges of each vertex, ascending.
pub(super) fn vertex_edges(edges: &[Edge], vertex_count: usize) -> (Vec<u32>, Vec<VertexEdge>) {
    let mut offsets = vec![0u32; vertex_count + 1];
    for edge in edges {
        offsets[edge.low_vertex as usize] += 1;
        offsets[edge.high_vertex as usize] += 1;
    }
    let mut start = 0;
    for offset in &mut offsets {
        start += std::mem::replace(offset, start);
    }

    let mut lists = bytemuck::zeroed_vec(edges.len() * 2);
    let mut add = |vertex: u32, entry: VertexEdge| {
        let next = &mut offsets[vertex as usize];
        lists[*next as usize] = entry;
        *next += 1;
    };
    for (edge, edge_id) in edges.iter().zip(0..) {
        add(edge.low_vertex, VertexEdge { edge_id, other_vertex: edge.high_vertex });
        add(edge.high_vertex, VertexEdge { edge_id, other_vertex: edge.low_vertex });
    }

    // Each offset has moved on to its vertex's end, which is where the next vertex starts.
    offsets.rotate_right(1);
    offsets[0] = 0;
    (offsets, lists)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_edge_is_at_both_its_vertices() {
        // 0 - 2 - 3   1 alone
        let edge = |low_vertex, high_vertex| Edge { low_vertex, high_vertex, first: 0, second: 0 };
        let entry = |edge_id, other_vertex| VertexEdge { edge_id, other_vertex };
        let (offsets, lists) = vertex_edges(&[edge(0, 2), edge(2, 3)], 4);
        assert_eq!(offsets, [0, 1, 1, 3, 4]);
        assert_eq!(lists, [entry(0, 2), entry(0, 0), entry(1, 3), entry(1, 2)]);
    }

    #[test]
    fn no_vertices_still_have_an_end() {
        assert_eq!(vertex_edges(&[], 0), (vec![0], vec![]));
    }
}
