//! Which face is across an edge.

use contrejour_layout::{INCIDENCE_ALONG, UNLIT_FACE, incidence};
use glam::DVec3;

use crate::{TopologyAwareMesh, incidence_words};

/// The normals across the three edges of a face with area; `None` where no edge can be in a silhouette.
pub(super) fn neighbour_normals(mesh: &TopologyAwareMesh, face_id: u32, normals: &[DVec3]) -> Option<[[f32; 3]; 3]> {
    let face = mesh.faces[face_id as usize];
    let own = normals[face_id as usize];
    let vertices = [face.a, face.b, face.c];
    let across = |turn: usize| -> Option<DVec3> {
        let (from, to) = (vertices[turn], vertices[(turn + 1) % 3]);
        let edge_id = mesh.edge_between(from.min(to), from.max(to))?;
        if edge_id >= mesh.candidate_edge_count as usize {
            return None;
        }
        let words = incidence_words(&mesh.edges[edge_id], &mesh.incidences);
        let word = incidence(face_id, from < to);
        match pair_of(words, word).map(|other| (other, other >> 1)) {
            None | Some((_, UNLIT_FACE)) => Some(-own),
            Some((other, other_face)) => {
                let normal = normals[other_face as usize];
                Some(if is_along(other) == is_along(word) { -normal } else { normal })
            }
        }
    };
    let found: [Option<DVec3>; 3] = std::array::from_fn(across);
    let stored = |normal: Option<DVec3>| normal.unwrap_or_default().as_vec3().to_array();
    found.iter().any(Option::is_some).then(|| found.map(stored))
}

/// Edges of more than one pair, or with a face that has no sign to take.
pub(super) fn overdrawn_edges(mesh: &TopologyAwareMesh) -> u32 {
    let candidates = &mesh.edges[..mesh.candidate_edge_count as usize];
    let is_overdrawn = |words: &[u32]| words.len() > 2 || words.iter().any(|word| word >> 1 == UNLIT_FACE);
    candidates.iter().filter(|edge| is_overdrawn(incidence_words(edge, &mesh.incidences))).count() as u32
}

/// The word that is asked together with one of an edge's: each that runs along the edge with one that does not, then what
/// is left two by two. An odd one has none.
fn pair_of(words: &[u32], word: u32) -> Option<u32> {
    let index = words.iter().position(|&other| other == word)?;
    let alike = || words.iter().filter(|&&other| is_along(other) == is_along(word));
    let mut others = words.iter().filter(|&&other| is_along(other) != is_along(word));
    let opposite_count = others.clone().count();
    let rank = words[..index].iter().filter(|&&other| is_along(other) == is_along(word)).count();
    if rank < opposite_count {
        return others.nth(rank).copied();
    }
    alike().nth(opposite_count + ((rank - opposite_count) ^ 1)).copied()
}

fn is_along(word: u32) -> bool {
    word & INCIDENCE_ALONG != 0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn opposite_ways_are_paired_first() {
        let along = |face| incidence(face, true);
        let against = |face| incidence(face, false);
        let words = [along(0), along(1), against(2), along(3), along(4)];
        let pairs: Vec<_> = words.iter().map(|&word| pair_of(&words, word)).collect();
        let expected = [Some(against(2)), Some(along(3)), Some(along(0)), Some(along(1)), None];
        assert_eq!(pairs, expected);
        assert_eq!(pair_of(&[along(7)], along(7)), None);
        assert_eq!(pair_of(&[along(7)], against(7)), None);
    }
}
