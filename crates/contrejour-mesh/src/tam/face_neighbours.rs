//! What is across the edges of faces, as a vertex stage asks it that knows the corners of all faces: the form of a
//! topology-aware vertex stream that follows positions which deform.

use std::collections::HashMap;
use std::ops::Range;

use contrejour_layout::{
    ACROSS_ALONE, ACROSS_ALONG, ACROSS_FAN, ACROSS_NEVER, ACROSS_NOTHING, Edge, FAN_UNLIT, FaceNeighbours,
    INCIDENCE_LIST, UNLIT_FACE,
};
use glam::DVec3;
use rayon::prelude::*;

use super::neighbours::{Across, Pairs, across, edge_of_face, has_area, has_edge, is_along};
use crate::{TopologyAwareMesh, incidence_words};

/// What is across the edges of all faces. Faces without area have nothing to draw, and one face at each edge of more than two
/// asks the edge's [fan](edge_fans).
pub fn face_neighbours(mesh: &TopologyAwareMesh) -> Vec<FaceNeighbours> {
    let has_area = has_area(mesh);
    asking(mesh, 0..mesh.faces.len() as u32, &has_area, &Pairs::default(), &fans(mesh, &has_area))
}

/// What is across the edges of some faces, for whoever has no [fans](edge_fans): at an edge of more than two each face asks
/// another one, pair by pair, and where several pairs are in the silhouette they may all draw the edge.
pub fn face_neighbours_in_pairs(mesh: &TopologyAwareMesh, face_ids: Range<u32>) -> Vec<FaceNeighbours> {
    asking(mesh, face_ids, &has_area(mesh), &Pairs::new(mesh), &HashMap::new())
}

/// What is across the edges of some faces: the fan of an edge that has one here, else the face of its pair.
fn asking(
    mesh: &TopologyAwareMesh,
    face_ids: Range<u32>,
    has_area: &[bool],
    pairs: &Pairs,
    fans: &HashMap<[u32; 2], Fan>,
) -> Vec<FaceNeighbours> {
    let word_across = |face_id, corner| {
        let [from, to] = edge_of_face(mesh, face_id, corner);
        if let Some(fan) = fans.get(&[from.min(to), from.max(to)]) {
            return if fan.drawer == Some(face_id) { ACROSS_FAN | fan.offset } else { ACROSS_NEVER };
        }
        word_of(mesh, face_id, [from, to], across(mesh, face_id, corner, pairs))
    };
    let neighbours = |face_id: u32| {
        let [across_ab, across_bc, across_ca] = if has_area[face_id as usize] {
            [0, 1, 2].map(|corner| word_across(face_id, corner))
        } else {
            [ACROSS_NEVER; 3]
        };
        FaceNeighbours { across_ab, across_bc, across_ca }
    };
    face_ids.into_par_iter().map(neighbours).collect()
}

fn word_of(mesh: &TopologyAwareMesh, face_id: u32, edge: [u32; 2], across: Across) -> u32 {
    match across {
        Across::Never => ACROSS_NEVER,
        Across::Nothing => ACROSS_NOTHING,
        // A face without area between takes the sign of the face here, or the opposite one.
        Across::Face { id, along: true } if id == face_id => ACROSS_NOTHING,
        Across::Face { id, along: false } if id == face_id => ACROSS_NEVER,
        Across::Face { id, along } => {
            let along_bit = if along { ACROSS_ALONG } else { 0 };
            // One beyond a face without area does not have the edge, and draws nothing there.
            let alone_bit = if along || !has_edge(mesh, id, edge) { ACROSS_ALONE } else { 0 };
            opposite_vertex(mesh, edge, id) | along_bit | alone_bit
        }
    }
}

/// The faces around each edge that has more than two, in the place of its list among the mesh's incidence words: a count,
/// then for each face its third corner, or [`FAN_UNLIT`], with [`ACROSS_ALONG`] where its sign counts as it is.
pub fn edge_fans(mesh: &TopologyAwareMesh) -> Vec<u32> {
    let mut fans = mesh.incidences.clone();
    for edge in listed_edges(mesh) {
        let words = incidence_words(edge, &mesh.incidences).iter().map(|&word| {
            let third = match word >> 1 {
                UNLIT_FACE => FAN_UNLIT,
                face_id => opposite_vertex(mesh, [edge.low_vertex, edge.high_vertex], face_id),
            };
            third | if is_along(word) { ACROSS_ALONG } else { 0 }
        });
        let first = edge.second as usize + 1;
        fans[first..].iter_mut().zip(words).for_each(|(place, word)| *place = word);
    }
    fans
}

/// Candidate edges of more than two faces.
fn listed_edges(mesh: &TopologyAwareMesh) -> impl Iterator<Item = &Edge> {
    let candidates = &mesh.edges[..mesh.candidate_edge_count as usize];
    candidates.iter().filter(|edge| edge.first == INCIDENCE_LIST)
}

struct Fan {
    offset: u32,
    /// The face that draws the edge, whether it is lit or not; none where all are without area.
    drawer: Option<u32>,
}

/// The fan of each edge that has one, by its vertices.
fn fans(mesh: &TopologyAwareMesh, has_area: &[bool]) -> HashMap<[u32; 2], Fan> {
    let fan = |edge: &Edge| {
        let vertices = [edge.low_vertex, edge.high_vertex];
        let mut faces = incidence_words(edge, &mesh.incidences).iter().map(|word| word >> 1);
        let can_draw = |id: &u32| *id != UNLIT_FACE && has_area[*id as usize] && has_edge(mesh, *id, vertices);
        (vertices, Fan { offset: edge.second, drawer: faces.find(can_draw) })
    };
    listed_edges(mesh).map(fan).collect()
}

/// The corner of a face that is farthest from an edge. The face is at the edge, or beyond faces without area that lie on it.
fn opposite_vertex(mesh: &TopologyAwareMesh, [from, to]: [u32; 2], face_id: u32) -> u32 {
    let face = mesh.faces[face_id as usize];
    let vertices = [face.a, face.b, face.c];
    let others: Vec<u32> = vertices.into_iter().filter(|vertex| *vertex != from && *vertex != to).collect();
    if let [vertex] = others[..] {
        return vertex;
    }
    let position = |vertex: u32| DVec3::from(mesh.positions[vertex as usize].map(f64::from));
    let origin = position(from);
    let along = (position(to) - origin).normalize_or_zero();
    let distance = |vertex: u32| along.cross(position(vertex) - origin).length();
    let farther = |one: &&u32, other: &&u32| distance(**one).total_cmp(&distance(**other));
    others.iter().max_by(farther).copied().unwrap_or(face.c)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::BuildOptions;

    /// Pages that share an edge, wound one way and the other, and a face without area.
    fn book() -> TopologyAwareMesh {
        let positions = [[0.0; 3], [0.0, 1.0, 0.0], [1.0, 0.5, 0.0], [0.0, 0.5, 1.0], [-1.0, 0.5, 0.0]];
        let triangles = [[0, 1, 1], [0, 1, 2], [1, 0, 3], [0, 1, 4]];
        TopologyAwareMesh::build(&positions, &triangles, &BuildOptions::default()).expect("the book is a mesh")
    }

    #[test]
    fn one_face_draws_an_edge_of_many() {
        let found = face_neighbours(&book());
        let at_spine: Vec<u32> = found.iter().map(|neighbours| neighbours.across_ab).collect();
        assert_eq!(at_spine, [ACROSS_NEVER, ACROSS_FAN, ACROSS_NEVER, ACROSS_NEVER]);
        let others = found[1..].iter().flat_map(|neighbours| [neighbours.across_bc, neighbours.across_ca]);
        assert!(others.into_iter().all(|word| word == ACROSS_NOTHING));
    }

    #[test]
    fn a_fan_has_all_faces_around() {
        let mut fan = edge_fans(&book());
        assert_eq!(fan.remove(0) as usize, fan.len());
        assert_eq!(fan, [2 | ACROSS_ALONG, 3, 4 | ACROSS_ALONG]);
    }

    #[test]
    fn a_part_of_a_mesh_is_asked_in_pairs() {
        let found = face_neighbours_in_pairs(&book(), 1..3);
        assert_eq!(found[0].across_ab, 3);
        assert_eq!(found[1].across_ab, 2);
    }
}
