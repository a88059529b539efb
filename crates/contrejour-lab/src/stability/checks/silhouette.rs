//! Silhouettes: those that exact arithmetic finds in a topology of its own.

use contrejour_layout::{Edge, SilhouetteEdge};
use contrejour_oracle::OracleEdge;

/// Edges that were lost, invented, told twice or given other faces. `expected` ascends.
pub(in super::super) fn wrong_edges(edges: &[Edge], expected: &[OracleEdge], found: &[SilhouetteEdge]) -> u64 {
    let as_oracle = |silhouette: &SilhouetteEdge| {
        let edge = &edges[silhouette.edge_id as usize];
        let [left, right] = [silhouette.left, silhouette.right].map(u32::cast_signed);
        OracleEdge { low: edge.low_vertex, high: edge.high_vertex, left, right }
    };
    let mut found: Vec<_> = found.iter().map(as_oracle).collect();
    found.sort();
    let (mut missing, mut extra) = (0, 0);
    let (mut expected, mut found) = (expected.iter().peekable(), found.iter().peekable());
    loop {
        match (expected.peek(), found.peek()) {
            (None, None) => break,
            (Some(one), Some(other)) if one == other => {
                expected.next();
                found.next();
            }
            (Some(one), other) if other.is_none_or(|other| one < other) => {
                missing += 1;
                expected.next();
            }
            _ => {
                extra += 1;
                found.next();
            }
        }
    }
    // An edge with other faces is one that is missing and one too many.
    u64::max(missing, extra)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_fault_is_counted() {
        let edge = |low_vertex, high_vertex| Edge { low_vertex, high_vertex, ..Edge::default() };
        let edges = [edge(0, 1), edge(0, 2), edge(1, 2), edge(2, 3)];
        let oracle = |edge: &Edge| OracleEdge { low: edge.low_vertex, high: edge.high_vertex, left: 2, right: 0 };
        let expected: Vec<_> = edges[..3].iter().map(oracle).collect();
        let good = [2, 0, 1].map(|edge_id| SilhouetteEdge { caster: 0, edge_id, left: 2, right: 0 }).to_vec();
        assert_eq!(wrong_edges(&edges, &expected, &good), 0);
        let faults: [fn(&mut Vec<SilhouetteEdge>); 5] = [
            |edges| edges.truncate(2),
            |edges| edges.push(edges[0]),
            |edges| edges[1].edge_id = 3,
            |edges| (edges[2].left, edges[2].right) = (0, 2),
            |edges| edges[0].left = 3,
        ];
        for (index, fault) in faults.iter().enumerate() {
            let mut faulty = good.clone();
            fault(&mut faulty);
            assert_eq!(wrong_edges(&edges, &expected, &faulty), 1, "fault {index}");
        }
        assert_eq!(wrong_edges(&edges, &expected, &[]), 3);
    }
}
