//! What of a mesh lies in each pool. Each is written with `write(byte offset, bytes)`.

use contrejour_layout::{BLOCK_SIZE, Edge, Face, FaceNeighbours, VertexEdge};
use contrejour_mesh::{FacePlanes, edge_fans, face_neighbours};
use contrejour_plan::{BufferKind, MeshPiece};

use crate::pieces::vertex_edges_of_piece;
use crate::pool::{MeshPool, PlacedPiece};

/// The pools that meshes fill page by page, but for planes.
pub(crate) const MESH_POOLS: [BufferKind; 6] = [
    BufferKind::Faces,
    BufferKind::FaceNeighbours,
    BufferKind::EdgeFans,
    BufferKind::Edges,
    BufferKind::Incidences,
    BufferKind::VertexEdges,
];

impl MeshPool {
    /// Writes meshes' own positions, all or those of meshes that are new.
    pub fn write_positions(&self, all: bool, mut write: impl FnMut(u64, &[u8])) {
        for (_, mesh) in self.meshes.iter().filter(|(slot, _)| all || self.is_new(*slot)) {
            write(4 * mesh.first_position_word(), bytemuck::cast_slice(&mesh.topology.positions));
        }
    }

    /// Works out and writes the planes of a piece's faces. They are not kept: pools are filled when meshes come, and seldom
    /// else.
    pub fn write_planes(&mut self, placed: &PlacedPiece, mut write: impl FnMut(u64, &[u8])) {
        let PlacedPiece { slot, piece, place } = placed;
        // No stage tests masked faces.
        let Some(mesh) = self.meshes.at_mut(*slot).filter(|mesh| !mesh.is_masked()) else { return };
        let faces = &mesh.topology.faces[piece.first_face as usize..][..piece.faces as usize];
        let planes = FacePlanes::new(&mesh.topology.positions, faces);
        write(size_of::<[f32; 4]>() as u64 * u64::from(place.face), bytemuck::cast_slice(&planes.planes));
        mesh.unfit_blocks.extend(planes.unfit_blocks.iter().map(|block| piece.first_face / BLOCK_SIZE + block));
    }

    /// Writes what of a piece lies in a pool.
    pub fn write_piece(&self, kind: BufferKind, placed: &PlacedPiece, mut write: impl FnMut(u64, &[u8])) {
        let PlacedPiece { slot, piece, place } = placed;
        let Some(pooled) = self.meshes.at(*slot) else { return };
        let mesh = &*pooled.topology;
        match kind {
            BufferKind::Faces => {
                let faces = &mesh.faces[piece.first_face as usize..][..piece.faces as usize];
                write(size_of::<Face>() as u64 * u64::from(place.face), bytemuck::cast_slice(faces));
            }
            // No vertex stage asks masked faces.
            BufferKind::FaceNeighbours | BufferKind::EdgeFans if pooled.is_masked() => {}
            BufferKind::FaceNeighbours => {
                let first = piece.first_face;
                let neighbours = face_neighbours(mesh, first..first + piece.faces);
                let offset = size_of::<FaceNeighbours>() as u64 * u64::from(place.face);
                write(offset, bytemuck::cast_slice(&neighbours));
            }
            // Faces around an edge may be in several pieces, so there they are asked in pairs.
            BufferKind::EdgeFans if *piece != MeshPiece::whole(piece.mesh, &pooled.facts) => {}
            BufferKind::EdgeFans => write(4 * u64::from(place.incidence), bytemuck::cast_slice(&edge_fans(mesh))),
            BufferKind::Edges => {
                let edges = &mesh.edges[piece.first_edge as usize..][..piece.edges() as usize];
                write(size_of::<Edge>() as u64 * u64::from(place.edge), bytemuck::cast_slice(edges));
            }
            BufferKind::Incidences => {
                let lists = &mesh.incidences[piece.first_incidence_word as usize..];
                let lists = &lists[..piece.incidence_words as usize];
                write(4 * u64::from(place.incidence), bytemuck::cast_slice(lists));
            }
            BufferKind::VertexEdges => {
                let mut put = |offsets: &[u32], lists: &[VertexEdge]| {
                    write(4 * u64::from(place.vertex_offset_word), bytemuck::cast_slice(offsets));
                    write(4 * u64::from(place.vertex_edge_word), bytemuck::cast_slice(lists));
                };
                if *piece == MeshPiece::whole(piece.mesh, &pooled.facts) {
                    put(&mesh.vertex_edge_offsets, &mesh.vertex_edges);
                } else {
                    let (offsets, lists) = vertex_edges_of_piece(mesh, piece);
                    put(&offsets, &lists);
                }
            }
            _ => {}
        }
    }
}
