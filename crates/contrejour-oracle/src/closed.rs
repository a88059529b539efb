//! A silhouette is a cycle: at every vertex the multiplicities that arrive and leave add up to zero.

use std::collections::BTreeMap;

use contrejour_layout::{Edge, SilhouetteEdge};

/// The vertices at which the silhouette of one caster is not closed, ascending: the sum of the signed multiplicities of
/// the edges that arrive there (it is their higher end) less those that leave is not zero.
///
/// # Panics
///
/// When a silhouette edge is not one of the edges.
pub fn open_vertices(edges: &[Edge], silhouettes: &[SilhouetteEdge]) -> Vec<u32> {
    let mut sums: BTreeMap<u32, i64> = BTreeMap::new();
    for silhouette in silhouettes {
        let edge = &edges[silhouette.edge_id as usize];
        let multiplicity = i64::from(silhouette.left) - i64::from(silhouette.right);
        *sums.entry(edge.high_vertex).or_default() += multiplicity;
        *sums.entry(edge.low_vertex).or_default() -= multiplicity;
    }
    sums.into_iter().filter(|&(_, sum)| sum != 0).map(|(vertex, _)| vertex).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// ```text
    ///   2
    ///   |\      0-1-2, run along counter-clockwise
    ///   0-1
    /// ```
    const EDGES: [Edge; 3] = [edge(0, 1), edge(1, 2), edge(0, 2)];
    const LOOP: [SilhouetteEdge; 3] = [silhouette(0, 2, 0), silhouette(1, 2, 0), silhouette(2, 0, 2)];

    const fn edge(low_vertex: u32, high_vertex: u32) -> Edge {
        Edge { low_vertex, high_vertex, first: 0, second: 0 }
    }

    const fn silhouette(edge_id: u32, left: u32, right: u32) -> SilhouetteEdge {
        SilhouetteEdge { caster: 0, edge_id, left, right }
    }

    #[test]
    fn a_loop_is_closed() {
        assert_eq!(open_vertices(&EDGES, &LOOP), []);
        assert_eq!(open_vertices(&EDGES, &[]), []);
    }

    #[test]
    fn a_lost_a_turned_and_a_weaker_edge_are_found() {
        assert_eq!(open_vertices(&EDGES, &LOOP[..2]), [0, 2]);
        assert_eq!(open_vertices(&EDGES, &[LOOP[0], silhouette(1, 0, 2), LOOP[2]]), [1, 2]);
        assert_eq!(open_vertices(&EDGES, &[silhouette(0, 1, 0), LOOP[1], LOOP[2]]), [0, 1]);
    }
}
