//! Which face is across an edge.

use std::collections::{HashMap, VecDeque};

use contrejour_layout::{Edge, INCIDENCE_ALONG, UNLIT_FACE, incidence};
use glam::DVec3;
use rayon::prelude::*;

use crate::topology::repeats_a_vertex;
use crate::{TopologyAwareMesh, incidence_words};

/// Which words of an edge's are asked together, where it has more than two.
#[derive(Default)]
pub(super) struct Pairs(HashMap<(usize, u32), u32>);

impl Pairs {
    pub fn new(mesh: &TopologyAwareMesh) -> Self {
        let candidates = mesh.edges[..mesh.candidate_edge_count as usize].iter().enumerate();
        let words = candidates.map(|(edge_id, edge)| (edge_id, incidence_words(edge, &mesh.incidences)));
        let listed = words.filter(|(_, words)| words.len() > 2);
        let pairs = listed.flat_map(|(edge_id, words)| {
            let third = |word| third_vertex(mesh, &mesh.edges[edge_id], word);
            pairs(words, third).into_iter().map(move |pair| (edge_id, pair))
        });
        let both_ways = pairs.flat_map(|(edge_id, [one, other])| [((edge_id, one), other), ((edge_id, other), one)]);
        Self(both_ways.collect())
    }

    /// The other word of a word's pair.
    fn other(&self, edge_id: usize, words: &[u32], word: u32) -> Option<u32> {
        match *words {
            [first, second] => Some(if first == word { second } else { first }),
            _ => self.0.get(&(edge_id, word)).copied(),
        }
    }
}

/// Pairs of an edge's words: each that runs along the edge with one that does not, then what is left two by two. An odd one
/// is in none. A face is paired with its own back only where there is no other: so the two sides of a sheet each ask their
/// own neighbours, and agree.
fn pairs<T: PartialEq>(words: &[u32], third: impl Fn(u32) -> T) -> Vec<[u32; 2]> {
    let (along, mut against): (VecDeque<u32>, VecDeque<u32>) = words.iter().partition(|&&word| is_along(word));
    let mut pairs = Vec::new();
    let mut left = Vec::new();
    for word in along {
        let other = against.iter().position(|&other| third(other) != third(word));
        match against.remove(other.unwrap_or(0)) {
            Some(other) => pairs.push([word, other]),
            None => left.push(word),
        }
    }
    left.extend(against);
    pairs.extend(left.chunks_exact(2).map(|pair| [pair[0], pair[1]]));
    pairs
}

/// The corner of a word's face that is not on the edge; none for a face without a sign, or one that is not at the edge itself.
fn third_vertex(mesh: &TopologyAwareMesh, edge: &Edge, word: u32) -> Option<u32> {
    let face = mesh.faces.get((word >> 1) as usize)?;
    let mut corners = [face.a, face.b, face.c].into_iter();
    corners.find(|corner| *corner != edge.low_vertex && *corner != edge.high_vertex)
}

/// What is across an edge of a face.
#[derive(Clone, Copy)]
pub(super) enum Across {
    /// Nothing that matters: the edge is never in the silhouette.
    Never,
    /// Nothing, or a face without a sign of its own: the edge is always in the silhouette.
    Nothing,
    /// A face.
    Face {
        id: u32,
        /// Whether it runs along the edge as the face here does: then one of the two is wound the wrong way.
        along: bool,
    },
}

/// What is across the edge from a corner of a face with area to the next.
pub(super) fn across(mesh: &TopologyAwareMesh, face_id: u32, corner: usize, pairs: &Pairs) -> Across {
    let [from, to] = edge_of_face(mesh, face_id, corner);
    let edge_id = mesh.edge_between(from.min(to), from.max(to));
    let Some(edge_id) = edge_id.filter(|edge_id| *edge_id < mesh.candidate_edge_count as usize) else {
        return Across::Never;
    };
    let words = incidence_words(&mesh.edges[edge_id], &mesh.incidences);
    let word = incidence(face_id, from < to);
    match pairs.other(edge_id, words, word).map(|other| (other, other >> 1)) {
        None | Some((_, UNLIT_FACE)) => Across::Nothing,
        Some((other, id)) => Across::Face { id, along: is_along(other) == is_along(word) },
    }
}

pub(super) fn edge_of_face(mesh: &TopologyAwareMesh, face_id: u32, corner: usize) -> [u32; 2] {
    let face = mesh.faces[face_id as usize];
    let vertices = [face.a, face.b, face.c];
    [vertices[corner], vertices[(corner + 1) % 3]]
}

/// How long a normal across is where the face here draws the edge also while it is unlit, since the other one may not.
const DRAWN_UNLIT: f64 = 2.0;

/// The same where the edge is in the silhouette whatever the light.
const ALWAYS_DRAWN: f64 = 4.0;

/// The normals across the three edges of a face with area; `None` where no edge can be in a silhouette.
pub(super) fn neighbour_normals(
    mesh: &TopologyAwareMesh,
    face_id: u32,
    normals: &[DVec3],
    pairs: &Pairs,
) -> Option<[[f32; 3]; 3]> {
    let normal = normals[face_id as usize];
    let normal_across = |corner| match across(mesh, face_id, corner, pairs) {
        Across::Never => None,
        Across::Nothing => Some(-ALWAYS_DRAWN * normal),
        Across::Face { id, along: false } => {
            let across = normals[id as usize];
            // One beyond a face without area draws nothing there.
            let draws_too = has_edge(mesh, id, edge_of_face(mesh, face_id, corner));
            Some(if draws_too { across } else { DRAWN_UNLIT * across })
        }
        // The face a second time.
        Across::Face { id, along: true } if normals[id as usize] == normal => Some(-ALWAYS_DRAWN * normal),
        Across::Face { id, along: true } => Some(-DRAWN_UNLIT * normals[id as usize]),
    };
    let found: [Option<DVec3>; 3] = std::array::from_fn(normal_across);
    let stored = |normal: Option<DVec3>| normal.unwrap_or_default().as_vec3().to_array();
    found.iter().any(Option::is_some).then(|| found.map(stored))
}

pub(super) fn has_edge(mesh: &TopologyAwareMesh, face_id: u32, edge: [u32; 2]) -> bool {
    let face = mesh.faces[face_id as usize];
    edge.iter().all(|vertex| [face.a, face.b, face.c].contains(vertex))
}

/// Which faces have an area.
pub(super) fn has_area(mesh: &TopologyAwareMesh) -> Vec<bool> {
    let mut has_area: Vec<bool> = mesh.faces.par_iter().map(|face| !repeats_a_vertex(face)).collect();
    mesh.partners.iter().for_each(|partner| has_area[partner.face as usize] = false);
    has_area
}

/// Edges of more than two faces, but where all pairs lie in the same planes, so that they have the same answer; and edges with
/// a face that has no sign to take.
pub(super) fn overdrawn_edges(mesh: &TopologyAwareMesh) -> u32 {
    let candidates = &mesh.edges[..mesh.candidate_edge_count as usize];
    let disagrees = |edge: &Edge, words: &[u32]| {
        let third = |word| third_vertex(mesh, edge, word);
        let planes = |[one, other]: [u32; 2]| {
            let mut planes = [third(one), third(other)];
            planes.sort_unstable();
            planes
        };
        let mut planes_of_pairs = pairs(words, third).into_iter().map(planes);
        let first = planes_of_pairs.next();
        !words.len().is_multiple_of(2) || planes_of_pairs.any(|planes| Some(planes) != first)
    };
    let is_overdrawn = |edge: &&Edge| {
        let words = incidence_words(edge, &mesh.incidences);
        words.iter().any(|word| word >> 1 == UNLIT_FACE) || (words.len() > 2 && disagrees(edge, words))
    };
    candidates.iter().filter(is_overdrawn).count() as u32
}

pub(super) fn is_along(word: u32) -> bool {
    word & INCIDENCE_ALONG != 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opposite_ways_are_paired_first() {
        let along = |face| incidence(face, true);
        let against = |face| incidence(face, false);
        let itself = |word| word;
        let found = pairs(&[along(0), along(1), against(2), along(3), along(4)], itself);
        assert_eq!(found, [[along(0), against(2)], [along(1), along(3)]]);
        assert!(pairs(&[along(7)], itself).is_empty());
    }

    #[test]
    fn a_face_is_not_paired_with_its_back() {
        let [front, back, next, back_of_next] =
            [incidence(0, true), incidence(1, false), incidence(2, false), incidence(3, true)];
        let plane = |word: u32| word >> 2;
        let found = pairs(&[front, back, next, back_of_next], plane);
        assert_eq!(found, [[front, next], [back_of_next, back]]);
        assert_eq!(pairs(&[front, back], plane), [[front, back]]);
    }
}
