//! Counts a mesh, and cuts one that is too large for one page into pieces.

use contrejour_layout::{BLOCK_SIZE, INCIDENCE_LIST, VertexEdge};
use contrejour_mesh::{EdgeClass, MaskedMesh, TopologyAwareMesh};
use contrejour_plan::{DeviceFacts, MeshFacts, MeshPiece};

/// What the frame plan needs to know of a mesh with a mask.
pub fn masked_mesh_facts(mesh: &MaskedMesh) -> MeshFacts {
    MeshFacts { is_masked: true, ..mesh_facts(mesh.mesh()) }
}

/// What the frame plan needs to know of a mesh.
pub fn mesh_facts(mesh: &TopologyAwareMesh) -> MeshFacts {
    let candidates = &mesh.edge_classes[..mesh.candidate_edge_count as usize];
    let is_other = |class: &&EdgeClass| matches!(class, EdgeClass::Border | EdgeClass::NonManifold);
    let other_edges = candidates.iter().filter(is_other).count() as u32;
    MeshFacts {
        vertices: mesh.positions.len() as u32,
        faces: mesh.faces.len() as u32,
        two_face_edges: mesh.candidate_edge_count - other_edges,
        other_edges,
        incidence_words: mesh.incidences.len() as u32,
        vertex_edges: mesh.vertex_edges.len() as u32,
        is_masked: false,
    }
}

/// The pieces of the mesh of this index, as large as the device allows. None where the mesh fits as it is, and where it
/// can't be cut because a block alone is too large: a vertex has more edges than a buffer holds.
pub fn mesh_pieces(mesh: &TopologyAwareMesh, index: usize, device: &DeviceFacts) -> Vec<MeshPiece> {
    let facts = &mesh_facts(mesh);
    let fits = |piece: &MeshPiece| piece.fits(facts, device);
    let whole = MeshPiece::whole(index, facts);
    if fits(&whole) {
        return Vec::new();
    }
    let mut pieces = Vec::new();
    let mut next = MeshPiece { mesh: index, ..MeshPiece::default() };
    let mut listed_by = vec![0; mesh.positions.len()];
    while next.first_face < whole.faces || next.first_edge < whole.edges() {
        let mut piece = next;
        let mut blocks = 0;
        while let Some(larger) = with_next_faces(&piece, facts).filter(fits) {
            piece = larger;
            blocks += 1;
        }
        while let Some(larger) = with_next_edges(&piece, mesh, &mut listed_by, pieces.len() + 1).filter(fits) {
            piece = larger;
            blocks += 1;
        }
        if blocks == 0 {
            return Vec::new();
        }
        next.first_face += piece.faces;
        next.first_edge += piece.edges();
        next.first_incidence_word += piece.incidence_words;
        pieces.push(piece);
    }
    pieces
}

fn with_next_faces(piece: &MeshPiece, facts: &MeshFacts) -> Option<MeshPiece> {
    let left = facts.faces - piece.first_face - piece.faces;
    (left > 0).then(|| MeshPiece { faces: piece.faces + left.min(BLOCK_SIZE), ..*piece })
}

/// `listed_by` holds for each vertex the last piece that lists its edges; this one is `number`.
fn with_next_edges(
    piece: &MeshPiece,
    mesh: &TopologyAwareMesh,
    listed_by: &mut [usize],
    number: usize,
) -> Option<MeshPiece> {
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
            if std::mem::replace(&mut listed_by[vertex as usize], number) != number {
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
