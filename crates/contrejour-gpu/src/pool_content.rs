//! What of a mesh lies in each pool. Each is written with `write(byte offset, bytes)`.

use contrejour_layout::{BLOCK_SIZE, Edge, Face, FaceNeighbours, VertexEdge};
use contrejour_mesh::{
    FacePlanes, TamOptions, TamPrecision, TamStream, edge_fans, face_neighbours, face_neighbours_in_pairs,
};
use contrejour_plan::{BufferKind, MeshPiece, NearOne};

use crate::pieces::vertex_edges_of_piece;
use crate::pool::{MeshPool, PlacedPiece};

/// The pools that meshes fill page by page, but for planes.
pub(crate) const MESH_POOLS: [BufferKind; 8] = [
    BufferKind::Faces,
    BufferKind::FaceNeighbours,
    BufferKind::EdgeFans,
    BufferKind::StreamFaces,
    BufferKind::HalfStreamFaces,
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
        let is_whole = *piece == MeshPiece::whole(piece.mesh, &pooled.facts);
        match kind {
            BufferKind::Faces => {
                let faces = &mesh.faces[piece.first_face as usize..][..piece.faces as usize];
                write(size_of::<Face>() as u64 * u64::from(place.face), bytemuck::cast_slice(faces));
            }
            // No vertex stage asks masked faces.
            BufferKind::FaceNeighbours
            | BufferKind::EdgeFans
            | BufferKind::StreamFaces
            | BufferKind::HalfStreamFaces
                if pooled.is_masked() => {}
            BufferKind::FaceNeighbours => {
                let neighbours = if is_whole {
                    face_neighbours(mesh)
                } else {
                    face_neighbours_in_pairs(mesh, piece.first_face..piece.first_face + piece.faces)
                };
                let offset = size_of::<FaceNeighbours>() as u64 * u64::from(place.face);
                write(offset, bytemuck::cast_slice(&neighbours));
            }
            // Faces around an edge may be in several pieces, so there they are asked in pairs.
            BufferKind::EdgeFans if !is_whole => {}
            BufferKind::EdgeFans => write(4 * u64::from(place.incidence), bytemuck::cast_slice(&edge_fans(mesh))),
            BufferKind::StreamFaces | BufferKind::HalfStreamFaces => {
                let precision = if kind == BufferKind::StreamFaces { TamPrecision::Full } else { TamPrecision::Half };
                // As the matrices expect positions: near 1, so halves hold them and no record is refused.
                let NearOne { origin, scale } = pooled.near_one;
                let stream = TamStream::new(mesh, &TamOptions { origin, scale });
                let faces = piece.first_face..piece.first_face + piece.faces;
                let Ok(records) = stream.records_in_place(faces, precision) else { return };
                write(kind.item_bytes() * u64::from(place.face), &records);
            }
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
                if is_whole {
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

#[cfg(test)]
mod tests {
    use std::sync::Arc;

    use contrejour_layout::{ACROSS_ALONE, ACROSS_ALONG, ACROSS_FAN, HALF_STREAM_FACE_WORDS, STREAM_FACE_WORDS};
    use contrejour_mesh::{BuildOptions, TopologyAwareMesh};
    use contrejour_plan::DeviceFacts;

    use super::*;
    use crate::pool::PiecePlace;

    fn book_of_three() -> MeshPool {
        let positions = [[0.0; 3], [0.0, 1.0, 0.0], [1.0, 0.5, 0.0], [0.0, 0.5, 1.0], [-1.0, 0.5, 0.0]];
        let pages = [[0, 1, 2], [1, 0, 3], [0, 1, 4]];
        let mesh = TopologyAwareMesh::build(&positions, &pages, &BuildOptions::default()).expect("a good mesh");
        let mut pool = MeshPool::default();
        pool.add(Arc::new(mesh), &DeviceFacts::default()).expect("it fits");
        pool
    }

    fn words(pool: &MeshPool, kind: BufferKind, piece: MeshPiece) -> Vec<u32> {
        let mut words: Vec<u32> = Vec::new();
        let placed = PlacedPiece { slot: 0, piece, place: PiecePlace::default() };
        pool.write_piece(kind, &placed, |_, bytes| words.extend(bytemuck::pod_collect_to_vec::<u8, u32>(bytes)));
        words
    }

    #[test]
    fn a_piece_without_all_edges_has_no_fans_and_asks_none() {
        let pool = book_of_three();
        let whole = MeshPiece::whole(0, &pool.facts().0[0]);
        // All faces fit the page, and of the edges a part.
        let cut = MeshPiece { other_edges: 1, ..whole };
        let is_fan = |word: &&u32| *word & (ACROSS_ALONG | ACROSS_ALONE) == ACROSS_FAN;
        let asking = |piece| words(&pool, BufferKind::FaceNeighbours, piece).iter().filter(is_fan).count();
        assert_eq!((asking(whole), words(&pool, BufferKind::EdgeFans, whole).len()), (1, 4));
        assert_eq!((asking(cut), words(&pool, BufferKind::EdgeFans, cut).len()), (0, 0));
    }

    #[test]
    fn a_piece_has_its_part_of_a_stream() {
        let pool = book_of_three();
        let whole = MeshPiece::whole(0, &pool.facts().0[0]);
        let last_two = MeshPiece { first_face: 1, faces: 2, ..whole };
        for (kind, face_words) in
            [(BufferKind::StreamFaces, STREAM_FACE_WORDS), (BufferKind::HalfStreamFaces, HALF_STREAM_FACE_WORDS)]
        {
            let all = words(&pool, kind, whole);
            assert_eq!(all.len(), 3 * face_words as usize);
            assert!(all.chunks(face_words as usize).all(|face| face.iter().any(|word| *word != 0)));
            assert_eq!(words(&pool, kind, last_two), all[face_words as usize..]);
        }
    }
}
