//! Checking the input, and triangles by welded ids.

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use contrejour_layout::Face;
use rayon::prelude::*;

use super::error::{MAX_FACES, MAX_VERTICES, TopologyError};
use super::exact::collinear;

/// Refuses what has no topology.
///
/// # Errors
///
/// More faces or vertices than ids, the first face with an index out of range, the first position that is not finite.
pub(super) fn check(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<(), TopologyError> {
    check_counts(positions.len(), triangles.len())?;
    let vertices = positions.len() as u32;
    if let Some(face) = first_where(triangles, |corners| corners.iter().any(|&index| index >= vertices)) {
        let index = triangles[face].into_iter().find(|&index| index >= vertices).unwrap_or(vertices);
        return Err(TopologyError::IndexOutOfRange { face: face as u32, index, vertices });
    }
    if let Some(vertex) = first_where(positions, |position| !position.iter().all(|x| x.is_finite())) {
        return Err(TopologyError::NonFinitePosition { vertex: vertex as u32, position: positions[vertex] });
    }
    Ok(())
}

/// Index of the first item for which the test holds.
fn first_where<Item: Sync>(items: &[Item], test: impl Fn(&Item) -> bool + Sync) -> Option<usize> {
    const ITEMS_PER_TASK: usize = 1 << 12;
    // Without a way out of the loop, the compiler tests several items at once.
    let any = |items: &[Item]| items.iter().fold(false, |any, item| any | test(item));
    let task = items.par_chunks(ITEMS_PER_TASK).position_first(any)?;
    let first_item = task * ITEMS_PER_TASK;
    items[first_item..].iter().position(test).map(|offset| first_item + offset)
}

fn check_counts(vertices: usize, faces: usize) -> Result<(), TopologyError> {
    if faces > MAX_FACES {
        return Err(TopologyError::TooManyFaces { faces });
    }
    if vertices > MAX_VERTICES {
        return Err(TopologyError::TooManyVertices { vertices });
    }
    Ok(())
}

/// Triangles by welded ids, in the same order.
pub(super) fn welded_faces(triangles: &[[u32; 3]], ids: &[u32]) -> Vec<Face> {
    triangles
        .par_iter()
        .map(|corners| {
            let [a, b, c] = corners.map(|index| ids[index as usize]);
            Face { a, b, c }
        })
        .collect()
}

/// Whether a face names a vertex twice, so that it cancels itself.
pub(crate) fn repeats_a_vertex(face: &Face) -> bool {
    face.a == face.b || face.b == face.c || face.c == face.a
}

/// The corner of a face that is not at the edge.
pub(super) fn apex(face: &Face, low: u32, high: u32) -> u32 {
    // Two of the three corners are the ends of the edge, and x ^ x = 0.
    face.a ^ face.b ^ face.c ^ low ^ high
}

/// Faces with three distinct, exactly collinear corners, ascending.
pub(super) fn faces_without_area(positions: &[[f32; 3]], faces: &[Face]) -> Vec<u32> {
    let at = |vertex: u32| positions[vertex as usize];
    (0..faces.len() as u32)
        .into_par_iter()
        .filter(|&id| {
            let face = &faces[id as usize];
            collinear(at(face.a), at(face.b), at(face.c)) && !repeats_a_vertex(face)
        })
        .collect()
}

/// Whether each source vertex is named by a triangle.
pub(super) fn used_vertices(vertex_count: usize, triangles: &[[u32; 3]]) -> Vec<bool> {
    let used: Vec<AtomicBool> = (0..vertex_count).map(|_| AtomicBool::new(false)).collect();
    triangles.par_iter().flatten_iter().for_each(|&index| used[index as usize].store(true, Relaxed));
    used.into_iter().map(AtomicBool::into_inner).collect()
}

/// Smallest and largest corner of the box around the vertices that stand for a used one; zeros when there is none.
pub(super) fn bounds(positions: &[[f32; 3]], ids: &[u32], used: &[bool]) -> ([f32; 3], [f32; 3]) {
    let nothing = || ([f32::INFINITY; 3], [f32::NEG_INFINITY; 3]);
    let join = |(min_a, max_a): ([f32; 3], [f32; 3]), (min_b, max_b): ([f32; 3], [f32; 3])| {
        let min = std::array::from_fn(|axis| f32::min(min_a[axis], min_b[axis]));
        let max = std::array::from_fn(|axis| f32::max(max_a[axis], max_b[axis]));
        (min, max)
    };
    let around_all = ids
        .par_iter()
        .zip(used)
        .filter(|&(_, &used)| used)
        .map(|(&id, _)| (positions[id as usize], positions[id as usize]))
        .reduce(nothing, join);
    if around_all == nothing() { Default::default() } else { around_all }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_bad_index_is_named() {
        let error = check(&[[0.0; 3]; 3], &[[0, 1, 2], [2, 3, 9], [7, 7, 7]]);
        assert_eq!(error, Err(TopologyError::IndexOutOfRange { face: 1, index: 3, vertices: 3 }));
    }

    #[test]
    fn the_first_position_that_is_not_finite_is_named() {
        let positions = [[0.0; 3], [1.0, f32::NEG_INFINITY, 0.0], [f32::NAN; 3]];
        let error = check(&positions, &[]).expect_err("an infinite position must be refused");
        assert_eq!(error.to_string(), "vertex 1 is at (1, -inf, 0): remove it or give it finite coordinates");
    }

    #[test]
    fn counts_end_where_ids_end() {
        assert_eq!(check_counts(MAX_VERTICES, MAX_FACES), Ok(()));
        assert!(matches!(check_counts(0, MAX_FACES + 1), Err(TopologyError::TooManyFaces { .. })));
        assert!(matches!(check_counts(MAX_VERTICES + 1, 0), Err(TopologyError::TooManyVertices { .. })));
        assert!(MAX_FACES < contrejour_layout::UNLIT_FACE as usize);
    }

    #[test]
    fn bounds_leave_out_what_is_not_used() {
        let positions = [[1.0, -2.0, 3.0], [4.0, 5.0, -6.0], [100.0; 3]];
        assert_eq!(bounds(&positions, &[0, 1, 2], &[true, true, false]), ([1.0, -2.0, -6.0], [4.0, 5.0, 3.0]));
        assert_eq!(bounds(&positions, &[0, 1, 2], &[false; 3]), ([0.0; 3], [0.0; 3]));
    }
}
