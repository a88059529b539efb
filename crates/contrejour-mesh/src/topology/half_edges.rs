//! Every face's three half edges, sorted.
//!
//! A radix sort in two steps, because memory that is written in random order costs most: the half edges are first
//! dealt into buckets of neighbouring low vertices, as many as the caches can keep open; then each bucket, which fits
//! a cache, is sorted by itself. Both steps keep equal keys in the order of the faces, so that the result does not
//! depend on the number of threads.

use std::slice;

use bytemuck::{Pod, Zeroable};
use contrejour_layout::{Face, incidence};
use rayon::prelude::*;

use super::faces::repeats_a_vertex;

/// One side of one face.
#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Eq, Pod, Zeroable)]
pub(super) struct HalfEdge {
    pub(super) low_vertex: u32,
    pub(super) high_vertex: u32,
    /// The face and how it runs along the edge.
    pub(super) incidence: u32,
}

impl HalfEdge {
    fn new(face_id: u32, from: u32, to: u32) -> Self {
        Self { low_vertex: from.min(to), high_vertex: from.max(to), incidence: incidence(face_id, from < to) }
    }

    /// Whether both are sides at the same edge.
    pub(super) fn same_edge(&self, other: &Self) -> bool {
        self.low_vertex == other.low_vertex && self.high_vertex == other.high_vertex
    }
}

/// Sorts the half edges of all faces but those that name a vertex twice, by low vertex, high vertex and face.
///
/// They come in buckets: no edge is in two of them. Also gives what `measure` finds of each bucket, which is asked
/// while the bucket is still in a cache.
pub(super) fn sorted_half_edges<Measure: Send>(
    faces: &[Face],
    vertex_count: usize,
    measure: impl Fn(&[HalfEdge]) -> Measure + Sync,
) -> (BucketedHalfEdges, Vec<Measure>) {
    let buckets = Buckets::new(vertex_count);
    let (mut half_edges, bucket_lengths) = deal(faces, buckets);
    let measures = split_by_lengths(&mut half_edges, bucket_lengths.iter().copied())
        .into_par_iter()
        .enumerate()
        .map_init(Scratch::default, |scratch, (bucket, half_edges)| {
            scratch.sort(half_edges, buckets.first_vertex(bucket), buckets.width());
            measure(half_edges)
        })
        .collect();
    (BucketedHalfEdges { half_edges, bucket_lengths }, measures)
}

/// Half edges by bucket.
pub(super) struct BucketedHalfEdges {
    half_edges: Vec<HalfEdge>,
    bucket_lengths: Vec<usize>,
}

impl BucketedHalfEdges {
    /// The buckets in order.
    pub(super) fn buckets(&self) -> Vec<&[HalfEdge]> {
        let mut rest = self.half_edges.as_slice();
        let next_bucket = |&length: &usize| {
            let (bucket, after) = rest.split_at(length);
            rest = after;
            bucket
        };
        self.bucket_lengths.iter().map(next_bucket).collect()
    }
}

/// Cuts a slice into consecutive parts, which different threads can then write.
pub(super) fn split_by_lengths<T>(mut slice: &mut [T], lengths: impl Iterator<Item = usize>) -> Vec<&mut [T]> {
    lengths
        .map(|length| {
            let (part, rest) = std::mem::take(&mut slice).split_at_mut(length);
            slice = rest;
            part
        })
        .collect()
}

/// Equal ranges of vertex ids.
#[derive(Clone, Copy)]
struct Buckets {
    count: usize,
    width_log2: u32,
}

impl Buckets {
    /// About as many streams as a second-level TLB can follow.
    const MOST: usize = 1024;
    /// With fewer vertices to a bucket, the buckets themselves would cost more than they save.
    const LEAST_WIDTH_LOG2: u32 = 8;

    fn new(vertex_count: usize) -> Self {
        let width_log2 = vertex_count.div_ceil(Self::MOST).next_power_of_two().ilog2().max(Self::LEAST_WIDTH_LOG2);
        Self { count: vertex_count.div_ceil(1 << width_log2), width_log2 }
    }

    fn of_vertex(self, vertex: u32) -> usize {
        (vertex >> self.width_log2) as usize
    }

    fn first_vertex(self, bucket: usize) -> u32 {
        (bucket as u32) << self.width_log2
    }

    fn width(self) -> usize {
        1 << self.width_log2
    }
}

/// Deals the half edges into buckets, in the order of the faces. Also gives the length of each bucket.
fn deal(faces: &[Face], buckets: Buckets) -> (Vec<HalfEdge>, Vec<usize>) {
    // Chunks are few, because each has a cursor into every bucket, and more than threads, so that none idles long.
    let chunk_length = faces.len().div_ceil(rayon::current_num_threads() * 2).max(1 << 14);
    let chunks: Vec<&[Face]> = faces.chunks(chunk_length).collect();
    let first_faces: Vec<u32> = (0..faces.len() as u32).step_by(chunk_length).collect();

    let counts: Vec<Vec<usize>> = chunks.par_iter().map(|chunk| count_by_bucket(chunk, buckets)).collect();
    let bucket_lengths: Vec<usize> =
        (0..buckets.count).map(|bucket| counts.iter().map(|of_chunk| of_chunk[bucket]).sum()).collect();

    // Each chunk has its own stretch of every bucket, after those of the chunks before it.
    let mut half_edges = bytemuck::zeroed_vec(bucket_lengths.iter().sum());
    let stretch_lengths = (0..buckets.count).flat_map(|bucket| counts.iter().map(move |of_chunk| of_chunk[bucket]));
    let mut cursors: Vec<Vec<slice::IterMut<HalfEdge>>> = chunks.iter().map(|_| Vec::new()).collect();
    for (index, stretch) in split_by_lengths(&mut half_edges, stretch_lengths).into_iter().enumerate() {
        cursors[index % chunks.len()].push(stretch.iter_mut());
    }

    chunks.into_par_iter().zip(first_faces).zip(cursors).for_each(|((chunk, first_face), mut cursors)| {
        for_each_half_edge(chunk, first_face, |half_edge| {
            if let Some(place) = cursors[buckets.of_vertex(half_edge.low_vertex)].next() {
                *place = half_edge;
            }
        });
    });
    (half_edges, bucket_lengths)
}

fn count_by_bucket(faces: &[Face], buckets: Buckets) -> Vec<usize> {
    let mut counts = vec![0; buckets.count];
    for_each_half_edge(faces, 0, |half_edge| counts[buckets.of_vertex(half_edge.low_vertex)] += 1);
    counts
}

fn for_each_half_edge(faces: &[Face], first_face: u32, mut visit: impl FnMut(HalfEdge)) {
    for (face, id) in faces.iter().zip(first_face..).filter(|(face, _)| !repeats_a_vertex(face)) {
        visit(HalfEdge::new(id, face.a, face.b));
        visit(HalfEdge::new(id, face.b, face.c));
        visit(HalfEdge::new(id, face.c, face.a));
    }
}

/// Room that a thread uses again for each bucket that it sorts.
#[derive(Default)]
struct Scratch {
    /// For each vertex of the bucket, where its next half edge goes.
    next_of_vertex: Vec<usize>,
    /// High vertex and incidence, packed so that they compare as one number.
    sorted: Vec<u64>,
}

impl Scratch {
    /// Sorts one bucket: a counting sort by low vertex, then each vertex's few half edges by the rest.
    fn sort(&mut self, half_edges: &mut [HalfEdge], first_vertex: u32, width: usize) {
        let local = |half_edge: &HalfEdge| (half_edge.low_vertex - first_vertex) as usize;

        self.next_of_vertex.clear();
        self.next_of_vertex.resize(width, 0);
        for half_edge in half_edges.iter() {
            self.next_of_vertex[local(half_edge)] += 1;
        }
        let mut start = 0;
        for next in &mut self.next_of_vertex {
            start += std::mem::replace(next, start);
        }

        self.sorted.resize(half_edges.len(), 0);
        for half_edge in half_edges.iter() {
            let next = &mut self.next_of_vertex[local(half_edge)];
            self.sorted[*next] = u64::from(half_edge.high_vertex) << 32 | u64::from(half_edge.incidence);
            *next += 1;
        }

        // Each `next` has moved on to its vertex's end.
        let mut start = 0;
        for (&end, low_vertex) in self.next_of_vertex.iter().zip(first_vertex..) {
            let of_vertex = &mut self.sorted[start..end];
            of_vertex.sort_unstable();
            for (half_edge, &packed) in half_edges[start..end].iter_mut().zip(&*of_vertex) {
                *half_edge = HalfEdge { low_vertex, high_vertex: (packed >> 32) as u32, incidence: packed as u32 };
            }
            start = end;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sorted(faces: &[Face], vertex_count: usize) -> Vec<HalfEdge> {
        let (sorted, lengths) = sorted_half_edges(faces, vertex_count, <[HalfEdge]>::len);
        assert_eq!(sorted.buckets().concat(), sorted.half_edges);
        assert_eq!(lengths, sorted.bucket_lengths);
        sorted.half_edges
    }

    #[test]
    fn two_triangles() {
        // 3---2
        // | / |
        // 0---1
        let faces = [Face { a: 0, b: 1, c: 2 }, Face { a: 0, b: 2, c: 3 }, Face { a: 1, b: 3, c: 1 }];
        let half_edge = |low_vertex, high_vertex, face, along| HalfEdge {
            low_vertex,
            high_vertex,
            incidence: incidence(face, along),
        };
        let expected = [
            half_edge(0, 1, 0, true),
            half_edge(0, 2, 0, false),
            half_edge(0, 2, 1, true),
            half_edge(0, 3, 1, false),
            half_edge(1, 2, 0, true),
            half_edge(2, 3, 1, true),
        ];
        assert_eq!(sorted(&faces, 4), expected);
    }

    #[test]
    fn no_faces_and_no_vertices() {
        assert!(sorted(&[], 0).is_empty());
        assert!(sorted(&[], 7).is_empty());
    }

    #[test]
    fn many_buckets_and_chunks_agree_with_a_plain_sort() {
        let vertex_count = 600_000u32;
        let scattered = |i: u32| (u64::from(i) * 2_654_435_761 % u64::from(vertex_count)) as u32;
        // Every third face is at vertex 5, so that one bucket is much longer than the others.
        let faces: Vec<Face> = (0..100_000)
            .map(|i| Face {
                a: if i % 3 == 0 { 5 } else { scattered(i) },
                b: scattered(i + 7),
                c: scattered(3 * i + 1),
            })
            .collect();
        let mut expected = Vec::new();
        for_each_half_edge(&faces, 0, |half_edge| expected.push(half_edge));
        expected.sort_by_key(|half_edge| (half_edge.low_vertex, half_edge.high_vertex, half_edge.incidence));
        for threads in [1, 2, 7] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be started");
            assert!(pool.install(|| sorted(&faces, vertex_count as usize)) == expected, "{threads} threads");
        }
    }
}
