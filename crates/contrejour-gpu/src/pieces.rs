//! Cuts a mesh that is too large for one page into pieces.

use contrejour_layout::{BLOCK_SIZE, INCIDENCE_LIST, VertexEdge};
use contrejour_mesh::{EdgeClass, TopologyAwareMesh};
use contrejour_plan::{DeviceFacts, MeshFacts, MeshPiece};

use crate::pool::mesh_facts;

/// The pieces of the mesh of this index, none where it fits as it is: as large as the device allows, a block at least.
pub fn mesh_pieces(mesh: &TopologyAwareMesh, index: usize, device: &DeviceFacts) -> Vec<MeshPiece> {
    let facts = &mesh_facts(mesh);
    let whole = MeshPiece::whole(index, facts);
    if whole.fits(facts, device) {
        return Vec::new();
    }
    let mut pieces = Vec::new();
    let mut next = MeshPiece { mesh: index, ..MeshPiece::default() };
    while next.first_face < whole.faces || next.first_edge < whole.edges() {
        let mut piece = next;
        grow(&mut piece, |piece| with_next_faces(piece, facts), facts, device);
        let mut vertices = vec![false; mesh.positions.len()];
        grow(&mut piece, |piece| with_next_edges(piece, mesh, &mut vertices), facts, device);
        next.first_face += piece.faces;
        next.first_edge += piece.edges();
        next.first_incidence_word += piece.incidence_words;
        pieces.push(piece);
    }
    pieces
}

/// Adds block after block as long as the piece fits.
fn grow(
    piece: &mut MeshPiece,
    mut with_next: impl FnMut(&MeshPiece) -> Option<MeshPiece>,
    facts: &MeshFacts,
    device: &DeviceFacts,
) {
    let mut is_first = true;
    while let Some(larger) = with_next(piece).filter(|larger| is_first || larger.fits(facts, device)) {
        *piece = larger;
        is_first = false;
    }
}

fn with_next_faces(piece: &MeshPiece, facts: &MeshFacts) -> Option<MeshPiece> {
    let left = facts.faces - piece.first_face - piece.faces;
    (left > 0).then(|| MeshPiece { faces: piece.faces + left.min(BLOCK_SIZE), ..*piece })
}

/// `vertices` are marked that the piece has the edges of.
fn with_next_edges(piece: &MeshPiece, mesh: &TopologyAwareMesh, vertices: &mut [bool]) -> Option<MeshPiece> {
    let begin = piece.first_edge + piece.edges();
    let end = mesh.candidate_edge_count.min(begin + BLOCK_SIZE);
    let mut larger = *piece;
    for edge_id in begin as usize..end as usize {
        let edge = &mesh.edges[edge_id];
        match mesh.edge_classes[edge_id] {
            EdgeClass::Border | EdgeClass::NonManifold => larger.other_edges += 1,
            _ => larger.two_face_edges += 1,
        }
        if edge.first == INCIDENCE_LIST {
            larger.incidence_words += 1 + mesh.incidences[edge.second as usize];
        }
        for vertex in [edge.low_vertex, edge.high_vertex] {
            if !std::mem::replace(&mut vertices[vertex as usize], true) {
                larger.vertex_edges += mesh.edges_of_vertex(vertex).len() as u32;
            }
        }
    }
    (begin < end).then_some(larger)
}

/// Offsets and lists of the vertices at the edges of a piece; those of other vertices are empty.
pub(crate) fn vertex_edges_of_piece(mesh: &TopologyAwareMesh, piece: &MeshPiece) -> (Vec<u32>, Vec<VertexEdge>) {
    let mut is_listed = vec![false; mesh.positions.len()];
    for edge in &mesh.edges[piece.first_edge as usize..][..piece.edges() as usize] {
        is_listed[edge.low_vertex as usize] = true;
        is_listed[edge.high_vertex as usize] = true;
    }
    let mut offsets = Vec::with_capacity(mesh.vertex_edge_offsets.len());
    let mut lists = Vec::with_capacity(piece.vertex_edges as usize);
    for (is_listed, vertex) in is_listed.into_iter().zip(0..) {
        offsets.push(lists.len() as u32);
        if is_listed {
            lists.extend(mesh.edges_of_vertex(vertex));
        }
    }
    offsets.push(lists.len() as u32);
    (offsets, lists)
}
