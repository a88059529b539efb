//! Meshes side by side in pooled buffers, so that one dispatch and one draw serve all of a page.

use std::collections::BTreeSet;
use std::sync::Arc;

use contrejour_layout::{BLOCK_SIZE, Caster, Edge, Face, VertexEdge};
use contrejour_mesh::{EdgeClass, FacePlanes, MaskedMesh, TopologyAwareMesh};
use contrejour_plan::{BufferKind, DeviceFacts, MeshFacts, MeshPiece, NearOne, PagePlan};

use crate::error::AddMeshError;
use crate::masks::MaskPool;
use crate::pieces::{mesh_pieces, vertex_edges_of_piece};

/// A mesh that was given to [`Shadows::add_mesh`](crate::Shadows::add_mesh).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct MeshHandle(pub(crate) usize);

/// All meshes. They are kept as they came; a pool is filled when the plan first asks for it.
#[derive(Debug, Default)]
pub(crate) struct MeshPool {
    meshes: Vec<PooledMesh>,
    facts: Vec<MeshFacts>,
    pieces: Vec<MeshPiece>,
    position_words: u64,
    masks: MaskPool,
}

#[derive(Debug)]
pub(crate) struct PooledMesh {
    pub topology: Arc<TopologyAwareMesh>,
    /// The number of what cuts its faces; 0 for nothing.
    mask: u32,
    pub first_position_word: u32,
    pub near_one: NearOne,
    /// Blocks of faces without planes that fit, as far as its planes have been asked for.
    unfit_blocks: BTreeSet<u32>,
}

/// Where a piece begins in the pools of its page.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PiecePlace {
    face: u32,
    edge: u32,
    incidence: u32,
    vertex_offset_word: u32,
    vertex_edge_word: u32,
}

const WORDS_PER_POSITION: u64 = 3;

impl MeshPool {
    /// Adds a mesh with a mask.
    pub fn add_masked(&mut self, mesh: &Arc<MaskedMesh>, device: &DeviceFacts) -> Result<MeshHandle, AddMeshError> {
        self.words_with(mesh.mesh()).map_err(|words| AddMeshError::PoolTooLarge { words })?;
        let mask = self.masks.add(mesh).map_err(|words| AddMeshError::MasksTooLarge { words })?;
        self.add_with(Arc::clone(mesh.mesh()), mask, device).map_err(|words| AddMeshError::PoolTooLarge { words })
    }

    /// Adds a mesh; `Err` holds the words of positions that there would be, more than 32 bits can index.
    pub fn add(&mut self, topology: Arc<TopologyAwareMesh>, device: &DeviceFacts) -> Result<MeshHandle, u64> {
        self.add_with(topology, 0, device)
    }

    fn add_with(
        &mut self,
        topology: Arc<TopologyAwareMesh>,
        mask: u32,
        device: &DeviceFacts,
    ) -> Result<MeshHandle, u64> {
        let words = self.words_with(&topology)?;
        let index = self.meshes.len();
        self.facts.push(MeshFacts { is_masked: mask > 0, ..mesh_facts(&topology) });
        self.pieces.extend(mesh_pieces(&topology, index, device));
        self.meshes.push(PooledMesh {
            first_position_word: self.position_words as u32,
            near_one: NearOne::of_box(topology.bounds_min, topology.bounds_max),
            topology,
            mask,
            unfit_blocks: BTreeSet::new(),
        });
        self.position_words = words;
        Ok(MeshHandle(index))
    }

    /// Words of positions with another mesh.
    fn words_with(&self, topology: &TopologyAwareMesh) -> Result<u64, u64> {
        let words = self.position_words + WORDS_PER_POSITION * topology.positions.len() as u64;
        if words > u64::from(u32::MAX) { Err(words) } else { Ok(words) }
    }

    /// A mesh; `None` for a handle of another object.
    pub fn get(&self, handle: MeshHandle) -> Option<&PooledMesh> {
        self.meshes.get(handle.0)
    }

    /// What the frame plan needs to know of each mesh.
    pub fn facts(&self) -> &[MeshFacts] {
        &self.facts
    }

    /// The pieces of the meshes that are too large for one page.
    pub fn pieces(&self) -> &[MeshPiece] {
        &self.pieces
    }

    /// Words of all meshes' own positions.
    pub fn position_words(&self) -> u64 {
        self.position_words
    }

    /// Where each piece of a page begins.
    pub fn places(&self, page: &PagePlan) -> Vec<PiecePlace> {
        let mut next = PiecePlace::default();
        let place = |piece: &MeshPiece| {
            let offsets = self.facts[piece.mesh].vertices + 1;
            next.vertex_edge_word = next.vertex_offset_word + offsets;
            let place = next;
            next.face += piece.faces;
            next.edge += piece.edges();
            next.incidence += piece.incidence_words;
            next.vertex_offset_word += offsets + 2 * piece.vertex_edges;
            place
        };
        page.pieces.iter().map(place).collect()
    }

    /// A caster record of a piece, without what belongs to the caster alone.
    pub fn record(&self, piece: &MeshPiece, place: &PiecePlace) -> Caster {
        let mesh = &self.meshes[piece.mesh];
        Caster {
            first_position_word: mesh.first_position_word,
            position_stride_words: WORDS_PER_POSITION as u32,
            first_face: place.face.wrapping_sub(piece.first_face),
            face_count: mesh.topology.faces.len() as u32,
            first_edge: place.edge.wrapping_sub(piece.first_edge),
            edge_count: mesh.topology.candidate_edge_count,
            first_incidence: place.incidence.wrapping_sub(piece.first_incidence_word),
            first_vertex_offset_word: place.vertex_offset_word,
            first_vertex_edge_word: place.vertex_edge_word,
            first_lit_word: 0,
            first_outline_word: 0,
            position_scale: mesh.near_one.scale,
            position_origin: mesh.near_one.origin,
            mask: mesh.mask,
        }
    }

    /// Writes all meshes' own positions with `write(byte offset, bytes)`.
    pub fn fill_positions(&self, mut write: impl FnMut(u64, &[u8])) {
        for mesh in &self.meshes {
            write(4 * u64::from(mesh.first_position_word), bytemuck::cast_slice(&mesh.topology.positions));
        }
    }

    /// The masks of all meshes.
    pub fn masks(&self) -> &MaskPool {
        &self.masks
    }

    /// Whether a mask cuts the faces of a mesh.
    pub fn is_masked(&self, handle: MeshHandle) -> bool {
        self.meshes[handle.0].mask > 0
    }

    /// Whether the planes of all faces of a block fit, as far as they have been asked for.
    pub fn has_planes(&self, handle: MeshHandle, block: u32) -> bool {
        !self.meshes[handle.0].unfit_blocks.contains(&block)
    }

    /// Works out and writes the planes of a page's faces with `write(byte offset, bytes)`. They are not kept: pools are
    /// filled when meshes come, and seldom else.
    pub fn fill_planes(&mut self, page: &PagePlan, mut write: impl FnMut(u64, &[u8])) {
        for (piece, place) in page.pieces.iter().zip(self.places(page)) {
            let PooledMesh { topology, unfit_blocks, mask, .. } = &mut self.meshes[piece.mesh];
            // No stage tests its faces.
            if *mask > 0 {
                continue;
            }
            let faces = &topology.faces[piece.first_face as usize..][..piece.faces as usize];
            let planes = FacePlanes::new(&topology.positions, faces);
            write(size_of::<[f32; 4]>() as u64 * u64::from(place.face), bytemuck::cast_slice(&planes.planes));
            unfit_blocks.extend(planes.unfit_blocks.iter().map(|block| piece.first_face / BLOCK_SIZE + block));
        }
    }

    /// Writes a whole pool of a page with `write(byte offset, bytes)`.
    pub fn fill(&self, kind: BufferKind, page: &PagePlan, mut write: impl FnMut(u64, &[u8])) {
        for (piece, place) in page.pieces.iter().zip(self.places(page)) {
            let mesh = &*self.meshes[piece.mesh].topology;
            match kind {
                BufferKind::Faces => {
                    let faces = &mesh.faces[piece.first_face as usize..][..piece.faces as usize];
                    write(size_of::<Face>() as u64 * u64::from(place.face), bytemuck::cast_slice(faces));
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
                    if *piece == MeshPiece::whole(piece.mesh, &self.facts[piece.mesh]) {
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
}

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
