//! A silhouette is a cycle: at every vertex as many edges arrive as leave. So it falls apart into closed loops.

use std::collections::BTreeMap;

use glam::DVec2;

/// A directed piece of the silhouette.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// Vertex where it begins: any key that is the same for all edges at the vertex.
    pub begin: usize,
    /// Vertex where it ends.
    pub end: usize,
    /// How often it is there.
    pub count: u64,
}

/// Walks all arcs into closed loops of vertices; the first is not repeated at the end. `None` where they are no cycle.
pub fn loops(arcs: &[Arc]) -> Option<Vec<Vec<usize>>> {
    // Most meshes are closed, and then every count is even: half of all loops would be drawn twice.
    let divisor = if arcs.iter().all(|arc| arc.count % 2 == 0) { 2 } else { 1 };
    let mut leaving: BTreeMap<usize, Vec<(usize, u64)>> = BTreeMap::new();
    for arc in arcs.iter().rev().filter(|arc| arc.count > 0) {
        leaving.entry(arc.begin).or_default().push((arc.end, arc.count / divisor));
    }
    let mut loops = Vec::new();
    while let Some((&first, _)) = leaving.first_key_value() {
        let mut vertices = Vec::new();
        let mut vertex = first;
        loop {
            vertices.push(vertex);
            vertex = take_one(&mut leaving, vertex)?;
            if vertex == first {
                break;
            }
        }
        loops.push(vertices);
    }
    Some(loops)
}

/// Takes one arc that leaves a vertex and returns where it ends.
fn take_one(leaving: &mut BTreeMap<usize, Vec<(usize, u64)>>, vertex: usize) -> Option<usize> {
    let arcs = leaving.get_mut(&vertex)?;
    let (end, count) = arcs.last_mut()?;
    let end = *end;
    *count -= 1;
    if *count == 0 {
        arcs.pop();
    }
    if arcs.is_empty() {
        leaving.remove(&vertex);
    }
    Some(end)
}

/// A closed SVG path through points.
pub fn closed_path(points: impl Iterator<Item = DVec2>) -> String {
    let mut path = String::new();
    for (point, command) in points.zip(std::iter::once('M').chain(std::iter::repeat('L'))) {
        path += &format!("{command}{:.2} {:.2}", point.x, point.y);
    }
    path + "Z"
}

#[cfg(test)]
mod tests {
    use super::*;

    fn arcs(arcs: &[(usize, usize, u64)]) -> Vec<Arc> {
        arcs.iter().map(|&(begin, end, count)| Arc { begin, end, count }).collect()
    }

    #[test]
    fn a_triangle_of_double_edges_is_one_loop() {
        assert_eq!(loops(&arcs(&[(0, 1, 2), (1, 2, 2), (2, 0, 2)])), Some(vec![vec![0, 1, 2]]));
    }

    #[test]
    fn every_arc_is_walked_as_often_as_it_is_there() {
        let walked = loops(&arcs(&[(0, 1, 1), (1, 2, 3), (2, 0, 1), (2, 1, 2)])).expect("it is a cycle");
        assert_eq!(walked.iter().map(Vec::len).sum::<usize>(), 7);
    }

    #[test]
    fn what_is_no_cycle_has_no_loops() {
        assert_eq!(loops(&arcs(&[(0, 1, 1), (1, 2, 1)])), None);
        assert_eq!(loops(&[]), Some(vec![]));
    }

    #[test]
    fn paths_are_closed() {
        let points = [DVec2::ZERO, DVec2::new(1.0, 0.5), DVec2::Y];
        assert_eq!(closed_path(points.into_iter()), "M0.00 0.00L1.00 0.50L0.00 1.00Z");
    }
}
