//! Meshes side by side in pooled buffers, so that one dispatch and one draw serve all of a page.

use std::collections::BTreeSet;
use std::sync::Arc;

use contrejour_layout::Caster;
use contrejour_mesh::{MaskedMesh, TopologyAwareMesh};
use contrejour_plan::{BufferKind, DeviceFacts, MeshFacts, MeshPiece, NearOne, PagePlan, PoolHoles};

use crate::error::AddMeshError;
use crate::masks::MaskPool;
use crate::pieces::{mesh_facts, mesh_pieces};
use crate::ranges::Ranges;
use crate::slots::{Key, Slots};

/// Names a mesh that was given to [`Shadows::add_mesh`](crate::Shadows::add_mesh).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct MeshHandle(pub(crate) Key);

/// All meshes. They are kept as they came; a pool is filled when the plan first asks for it. Each has a place in each pool
/// for as long as it is there.
#[derive(Debug, Default)]
pub(crate) struct MeshPool {
    pub(super) meshes: Slots<PooledMesh>,
    /// Those that callers bring lie among the positions too.
    places: PerPool<Ranges>,
    masks: MaskPool,
    /// Whether meshes came or went since [`note_filled`](Self::note_filled).
    has_changed: bool,
}

#[derive(Debug)]
pub(crate) struct PooledMesh {
    pub topology: Arc<TopologyAwareMesh>,
    /// What cuts its faces.
    mask: Option<Key>,
    pub facts: MeshFacts,
    pub near_one: NearOne,
    /// Where it begins; in a scene of several pages only among the positions.
    starts: PerPool<u64>,
    /// Where it is too large for one page; each names mesh 0.
    pieces: Vec<MeshPiece>,
    /// Whether it is in no pool yet.
    is_new: bool,
    /// Blocks of faces without planes that fit, as far as its planes have been asked for.
    pub(super) unfit_blocks: BTreeSet<u32>,
}

/// Words of positions, faces, edges, incidence words, words of vertex edges.
type PerPool<T> = [T; 5];

/// Where the positions are among them.
const POSITIONS: usize = 0;

/// Where a piece begins in the pools of its page.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct PiecePlace {
    pub face: u32,
    pub edge: u32,
    pub incidence: u32,
    pub vertex_offset_word: u32,
    pub vertex_edge_word: u32,
}

impl PiecePlace {
    /// The place of a piece; the next one lies behind it.
    fn take(&mut self, piece: &MeshPiece, mesh: &MeshFacts) -> Self {
        self.vertex_edge_word = self.vertex_offset_word + mesh.vertices + 1;
        let place = *self;
        self.face += piece.faces;
        self.edge += piece.edges();
        self.incidence += piece.incidence_words;
        self.vertex_offset_word = self.vertex_edge_word + 2 * piece.vertex_edges;
        place
    }
}

/// A piece of a mesh in the pools of its page.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PlacedPiece {
    /// Whose it is.
    pub slot: usize,
    pub piece: MeshPiece,
    pub place: PiecePlace,
}

const WORDS_PER_POSITION: u64 = 3;

impl MeshPool {
    /// Adds a mesh with a mask.
    pub fn add_masked(&mut self, mesh: &Arc<MaskedMesh>, device: &DeviceFacts) -> Result<MeshHandle, AddMeshError> {
        let mask = self.masks.add(mesh).map_err(|words| AddMeshError::MasksTooLarge { words })?;
        let added = self.add_with(Arc::clone(mesh.mesh()), Some(mask), device);
        if added.is_err() {
            self.masks.remove(mask);
        }
        added.map_err(|words| AddMeshError::PoolTooLarge { words })
    }

    /// Adds a mesh; `Err` holds the words of positions that there would be, more than 32 bits can index.
    pub fn add(&mut self, topology: Arc<TopologyAwareMesh>, device: &DeviceFacts) -> Result<MeshHandle, u64> {
        self.add_with(topology, None, device)
    }

    fn add_with(
        &mut self,
        topology: Arc<TopologyAwareMesh>,
        mask: Option<Key>,
        device: &DeviceFacts,
    ) -> Result<MeshHandle, u64> {
        let facts = MeshFacts { is_masked: mask.is_some(), ..mesh_facts(&topology) };
        let mut mesh = PooledMesh {
            facts,
            mask,
            near_one: NearOne::of_box(topology.bounds_min, topology.bounds_max),
            starts: PerPool::default(),
            pieces: mesh_pieces(&topology, 0, device),
            is_new: true,
            unfit_blocks: BTreeSet::new(),
            topology,
        };
        mesh.take_places(&mut self.places);
        let words = self.places[POSITIONS].end();
        if words > u64::from(u32::MAX) {
            mesh.give_places_back(&mut self.places);
            return Err(words);
        }
        self.has_changed = true;
        Ok(MeshHandle(self.meshes.insert(mesh)))
    }

    /// Removes a mesh, and leaves its places to later ones. False where there is none.
    pub fn remove(&mut self, handle: MeshHandle) -> bool {
        let removed = self.meshes.remove(handle.0);
        if let Some(mesh) = &removed {
            mesh.give_places_back(&mut self.places);
            mesh.mask.inspect(|mask| self.masks.remove(*mask));
            self.has_changed = true;
        }
        removed.is_some()
    }

    /// A mesh; `None` for a handle of another object.
    pub fn get(&self, handle: MeshHandle) -> Option<&PooledMesh> {
        self.meshes.get(handle.0)
    }

    /// What the frame plan needs to know of each mesh, and the pieces of those that are too large for one page.
    pub fn facts(&self) -> (Vec<MeshFacts>, Vec<MeshPiece>) {
        let meshes = || self.meshes.iter().map(|(_, mesh)| mesh);
        let pieces = meshes().enumerate().flat_map(|(index, mesh)| {
            let piece = move |piece: &MeshPiece| MeshPiece { mesh: index, ..*piece };
            mesh.pieces.iter().map(piece)
        });
        (meshes().map(|mesh| mesh.facts).collect(), pieces.collect())
    }

    /// The index of each mesh among the [`facts`](Self::facts), by its slot.
    pub fn indices(&self) -> Vec<usize> {
        let mut indices = Vec::new();
        for ((slot, _), index) in self.meshes.iter().zip(0..) {
            indices.resize(slot, usize::MAX);
            indices.push(index);
        }
        indices
    }

    /// What is free in the pools.
    pub fn holes(&self) -> PoolHoles {
        let [position_words, faces, edges, incidence_words, vertex_edge_words] =
            self.places.each_ref().map(Ranges::free);
        PoolHoles { position_words, faces, edges, incidence_words, vertex_edge_words, ..PoolHoles::default() }
    }

    /// How much of a pool is used; none for other buffers.
    pub fn used(&self, kind: BufferKind) -> Option<u64> {
        let index = match kind {
            BufferKind::Positions => POSITIONS,
            BufferKind::Faces
            | BufferKind::FaceNeighbours
            | BufferKind::StreamFaces
            | BufferKind::HalfStreamFaces
            | BufferKind::Planes => 1,
            BufferKind::Edges => 2,
            BufferKind::EdgeFans | BufferKind::Incidences => 3,
            BufferKind::VertexEdges => 4,
            BufferKind::MaskWords => return Some(self.masks.used_words()),
            _ => return None,
        };
        Some(self.places[index].used())
    }

    /// Takes a place for positions that a caller brings.
    pub fn take_position_words(&mut self, words: u64) -> u64 {
        self.places[POSITIONS].take(words)
    }

    pub fn give_back_position_words(&mut self, first: u64, words: u64) {
        self.places[POSITIONS].give_back(first, words);
    }

    /// Places all meshes side by side, and forgets the places that callers' positions had. For when nothing is in the pools.
    pub fn pack(&mut self) {
        self.places = PerPool::default();
        self.meshes.iter_mut().for_each(|(_, mesh)| mesh.take_places(&mut self.places));
        self.masks.pack();
    }

    /// The pieces of each page, and where they lie: a scene of one page has places that stay, several are packed anew.
    pub fn placed(&self, pages: &[PagePlan]) -> Vec<Vec<PlacedPiece>> {
        let meshes: Vec<_> = self.meshes.iter().collect();
        let of_page = |page: &PagePlan| {
            let mut next = PiecePlace::default();
            let place = |piece: &MeshPiece| {
                let (slot, mesh) = meshes[piece.mesh];
                let place = if pages.len() == 1 { mesh.place() } else { next.take(piece, &mesh.facts) };
                PlacedPiece { slot, piece: *piece, place }
            };
            page.pieces.iter().map(place).collect()
        };
        pages.iter().map(of_page).collect()
    }

    /// The masks of all meshes.
    pub fn masks(&self) -> &MaskPool {
        &self.masks
    }

    /// Whether the mesh of a slot is in no pool yet.
    pub fn is_new(&self, slot: usize) -> bool {
        self.meshes.at(slot).is_some_and(|mesh| mesh.is_new)
    }

    /// Whether meshes came or went since the pools were filled.
    pub fn has_changed(&self) -> bool {
        self.has_changed
    }

    /// Notes that all meshes are in the pools.
    pub fn note_filled(&mut self) {
        self.has_changed = false;
        self.masks.note_written();
        self.meshes.iter_mut().for_each(|(_, mesh)| mesh.is_new = false);
    }

    /// A caster record of a piece, without what belongs to the caster alone.
    pub fn record(&self, placed: &PlacedPiece) -> Caster {
        let PlacedPiece { slot, piece, place } = placed;
        let Some(mesh) = self.meshes.at(*slot) else { return Caster::default() };
        Caster {
            first_position_word: mesh.first_position_word() as u32,
            position_stride_words: WORDS_PER_POSITION as u32,
            first_face: place.face.wrapping_sub(piece.first_face),
            face_count: mesh.facts.faces,
            first_edge: place.edge.wrapping_sub(piece.first_edge),
            edge_count: mesh.topology.candidate_edge_count,
            first_incidence: place.incidence.wrapping_sub(piece.first_incidence_word),
            first_vertex_offset_word: place.vertex_offset_word,
            first_vertex_edge_word: place.vertex_edge_word,
            first_lit_word: 0,
            first_outline_word: 0,
            position_scale: mesh.near_one.scale,
            position_origin: mesh.near_one.origin,
            mask: mesh.mask.map_or(0, MaskPool::number),
        }
    }
}

impl PooledMesh {
    fn take_places(&mut self, places: &mut PerPool<Ranges>) {
        for ((start, place), length) in self.starts.iter_mut().zip(places).zip(lengths(&self.facts)) {
            *start = place.take(length);
        }
    }

    fn give_places_back(&self, places: &mut PerPool<Ranges>) {
        for ((start, place), length) in self.starts.iter().zip(places).zip(lengths(&self.facts)) {
            place.give_back(*start, length);
        }
    }

    /// Whether a mask cuts its faces.
    pub fn is_masked(&self) -> bool {
        self.mask.is_some()
    }

    pub fn first_position_word(&self) -> u64 {
        self.starts[POSITIONS]
    }

    /// Where it begins in a scene of one page. Where there is more than 32 bits can index, there is no plan.
    fn place(&self) -> PiecePlace {
        let [_, face, edge, incidence, vertex_offset_word] = self.starts.map(|start| start as u32);
        let vertex_edge_word = vertex_offset_word.wrapping_add(self.facts.vertices + 1);
        PiecePlace { face, edge, incidence, vertex_offset_word, vertex_edge_word }
    }

    /// Whether the planes of all faces of a block fit, as far as they have been asked for.
    pub fn has_planes(&self, block: u32) -> bool {
        !self.unfit_blocks.contains(&block)
    }
}

/// How much of each pool a mesh fills.
fn lengths(facts: &MeshFacts) -> PerPool<u64> {
    let MeshFacts { vertices, faces, two_face_edges, other_edges, incidence_words, vertex_edges, .. } = *facts;
    let [edges, vertex_edges] =
        [[two_face_edges, other_edges], [vertex_edges; 2]].map(|[a, b]| u64::from(a) + u64::from(b));
    let words = WORDS_PER_POSITION * u64::from(vertices);
    [words, faces.into(), edges, incidence_words.into(), vertex_edges + u64::from(vertices) + 1]
}
