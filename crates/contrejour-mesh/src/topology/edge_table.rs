//! Edges with all the faces at them.

use std::ops::Range;

use contrejour_layout::{Edge, Face, INCIDENCE_LIST, INCIDENCE_NONE};
use rayon::prelude::*;

use super::error::TopologyError;
use super::faces::{check, welded_faces};
use super::half_edges::{HalfEdge, sorted_half_edges, split_by_lengths};
use super::weld::{WeldKeys, weld};

/// Edges with all the faces at them, as the triangles have them: the first half of a
/// [`TopologyAwareMesh`](super::TopologyAwareMesh), for who needs no more.
///
/// A face that names a welded vertex twice is at no edge.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EdgeTable {
    /// Edges by (low, high) vertex. Faces at an edge are in ascending order.
    pub edges: Vec<Edge>,
    /// Lists of incidence words, each after its count, for edges with more than two faces.
    pub incidences: Vec<u32>,
}

impl EdgeTable {
    /// Welds the vertices by their position bits and collects the edges of the triangles.
    ///
    /// # Errors
    ///
    /// [`TopologyError`] when an index is out of range, a position is not finite or there are too many of either.
    pub fn build(positions: &[[f32; 3]], triangles: &[[u32; 3]]) -> Result<Self, TopologyError> {
        check(positions, triangles)?;
        let ids = weld(WeldKeys::positions(positions));
        Ok(Self::of_faces(&welded_faces(triangles, &ids), positions.len()))
    }

    /// Collects the edges of welded faces.
    pub(super) fn of_faces(faces: &[Face], vertex_count: usize) -> Self {
        let (half_edges, sizes) = sorted_half_edges(faces, vertex_count, Size::of);

        let mut edges = bytemuck::zeroed_vec(sizes.iter().map(|size| size.edges).sum());
        let mut incidences = vec![0; sizes.iter().map(|size| size.list_words).sum()];
        let first_words: Vec<usize> =
            sizes.iter().scan(0, |next, size| Some(std::mem::replace(next, *next + size.list_words))).collect();
        let edge_parts = split_by_lengths(&mut edges, sizes.iter().map(|size| size.edges));
        let list_parts = split_by_lengths(&mut incidences, sizes.iter().map(|size| size.list_words));
        half_edges
            .buckets()
            .into_par_iter()
            .zip(edge_parts)
            .zip(list_parts)
            .zip(first_words)
            .for_each(|(((half_edges, edges), lists), first_word)| write_edges(half_edges, edges, lists, first_word));
        Self { edges, incidences }
    }

    /// The edge between two vertices.
    pub(super) fn find(&self, low_vertex: u32, high_vertex: u32) -> Option<usize> {
        find_edge(&self.edges, low_vertex, high_vertex)
    }

    /// The incidence words of an edge, to be changed.
    pub(super) fn words_mut(&mut self, edge_id: usize) -> &mut [u32] {
        let edge = &mut self.edges[edge_id];
        if edge.first == INCIDENCE_LIST {
            let range = list_range(edge, &self.incidences);
            &mut self.incidences[range]
        } else {
            let count = pair_length(edge);
            &mut bytemuck::cast_mut::<Edge, [u32; 4]>(edge)[PAIR_WORDS][..count]
        }
    }
}

/// Index of the edge between two vertices among edges by (low, high) vertex.
pub(super) fn find_edge(edges: &[Edge], low_vertex: u32, high_vertex: u32) -> Option<usize> {
    edges.binary_search_by_key(&(low_vertex, high_vertex), |edge| (edge.low_vertex, edge.high_vertex)).ok()
}

/// The incidence words of an edge, one for each face at it; `incidences` are the lists that belong to the edge.
///
/// # Panics
///
/// When the edge's list is not in `incidences`.
pub fn incidence_words<'a>(edge: &'a Edge, incidences: &'a [u32]) -> &'a [u32] {
    if edge.first == INCIDENCE_LIST {
        &incidences[list_range(edge, incidences)]
    } else {
        &bytemuck::cast_ref::<Edge, [u32; 4]>(edge)[PAIR_WORDS][..pair_length(edge)]
    }
}

/// Where `first` and `second` are among the words of an edge.
const PAIR_WORDS: Range<usize> = 2..4;

/// Number of incidence words in an edge that has no list.
fn pair_length(edge: &Edge) -> usize {
    [edge.first, edge.second].iter().filter(|&&word| word != INCIDENCE_NONE).count()
}

/// Where the list of an edge is, without its count.
fn list_range(edge: &Edge, incidences: &[u32]) -> Range<usize> {
    let start = edge.second as usize + 1;
    start..start + incidences[edge.second as usize] as usize
}

/// What a bucket of half edges becomes.
#[derive(Clone, Copy)]
struct Size {
    edges: usize,
    list_words: usize,
}

impl Size {
    fn of(half_edges: &[HalfEdge]) -> Self {
        half_edges.chunk_by(HalfEdge::same_edge).fold(Self { edges: 0, list_words: 0 }, |size, at_edge| Self {
            edges: size.edges + 1,
            list_words: size.list_words + list_words(at_edge.len()),
        })
    }
}

/// Words in lists that an edge with so many faces needs.
fn list_words(face_count: usize) -> usize {
    if face_count > PAIR_WORDS.len() { 1 + face_count } else { 0 }
}

/// Makes one edge of each run of half edges. The lists' first word is `first_word` of the whole.
fn write_edges(half_edges: &[HalfEdge], edges: &mut [Edge], lists: &mut [u32], first_word: usize) {
    let mut written = 0;
    for (edge, at_edge) in edges.iter_mut().zip(half_edges.chunk_by(HalfEdge::same_edge)) {
        let (first, second) = match at_edge {
            [one] => (one.incidence, INCIDENCE_NONE),
            [one, other] => (one.incidence, other.incidence),
            _ => {
                let offset = first_word + written;
                let list = &mut lists[written..][..list_words(at_edge.len())];
                written += list.len();
                list[0] = at_edge.len() as u32;
                for (word, half_edge) in list[1..].iter_mut().zip(at_edge) {
                    *word = half_edge.incidence;
                }
                (INCIDENCE_LIST, offset as u32)
            }
        };
        *edge = Edge { low_vertex: at_edge[0].low_vertex, high_vertex: at_edge[0].high_vertex, first, second };
    }
}

#[cfg(test)]
mod tests {
    use contrejour_layout::incidence;

    use super::*;

    #[test]
    fn a_fan_of_three_has_a_list() {
        //     1
        //   / | \
        //  2  |  3     4 above the paper
        //   \ | /
        //     0
        let positions = [[0.0, 0.0, 0.0], [0.0, 2.0, 0.0], [-1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 1.0]];
        let table = EdgeTable::build(&positions, &[[0, 1, 2], [1, 0, 3], [0, 1, 4]]).expect("the fan is sound");

        let pairs: Vec<_> = table.edges.iter().map(|edge| (edge.low_vertex, edge.high_vertex)).collect();
        assert_eq!(pairs, [(0, 1), (0, 2), (0, 3), (0, 4), (1, 2), (1, 3), (1, 4)]);
        assert_eq!((table.edges[0].first, table.edges[0].second), (INCIDENCE_LIST, 0));
        assert_eq!(table.incidences, [3, incidence(0, true), incidence(1, false), incidence(2, true)]);
        assert_eq!(incidence_words(&table.edges[0], &table.incidences), &table.incidences[1..]);
        assert_eq!(incidence_words(&table.edges[1], &table.incidences), [incidence(0, false)]);
    }

    #[test]
    fn lists_of_several_buckets_follow_each_other() {
        // Four triangles on each of 2 000 edges, whose low vertices fill several buckets.
        let edge_count = 2_000u32;
        let low = |edge: u32| edge;
        let high = |edge: u32| edge_count + edge;
        let faces: Vec<Face> = (0..4 * edge_count)
            .map(|i| Face { a: low(i % edge_count), b: high(i % edge_count), c: 2 * edge_count + i })
            .collect();
        let table = EdgeTable::of_faces(&faces, 6 * edge_count as usize);
        for edge in 0..edge_count {
            let id = table.find(low(edge), high(edge)).expect("every face has this edge");
            let expected: Vec<u32> = (0..4).map(|k| incidence(edge + k * edge_count, true)).collect();
            assert_eq!(incidence_words(&table.edges[id], &table.incidences), expected);
        }
        assert_eq!(table.incidences.len(), 5 * edge_count as usize);
    }

    #[test]
    fn nothing_has_no_edges() {
        assert_eq!(EdgeTable::build(&[], &[]), Ok(EdgeTable::default()));
        assert_eq!(EdgeTable::build(&[[0.0; 3]], &[[0, 0, 0]]), Ok(EdgeTable::default()));
    }
}
