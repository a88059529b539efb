//! Meshes side by side in pooled buffers, so that one dispatch and one draw serve all of them.

use std::sync::Arc;

use contrejour_layout::{Edge, Face};
use contrejour_mesh::{EdgeClass, TopologyAwareMesh};
use contrejour_plan::{BufferKind, MeshFacts, NearOne};

/// A mesh that was given to [`Shadows::add_mesh`](crate::Shadows::add_mesh).
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct MeshHandle(pub(crate) usize);

/// Where a mesh lies in the pools, and what a caster record says of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct MeshRange {
    pub first_position_word: u32,
    pub first_face: u32,
    pub face_count: u32,
    pub first_edge: u32,
    pub edge_count: u32,
    pub first_incidence: u32,
    pub first_vertex_offset_word: u32,
    pub first_vertex_edge_word: u32,
    pub near_one: NearOne,
    pub bounds_min: [f32; 3],
    pub bounds_max: [f32; 3],
}

/// All meshes. They are kept as they came; a pool is filled when the plan first asks for it.
#[derive(Debug, Default)]
pub(crate) struct MeshPool {
    meshes: Vec<Arc<TopologyAwareMesh>>,
    ranges: Vec<MeshRange>,
    facts: Vec<MeshFacts>,
    words: PoolWords,
}

/// Words in each pool.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct PoolWords {
    pub positions: u64,
    pub faces: u64,
    pub edges: u64,
    pub incidences: u64,
    pub vertex_edges: u64,
}

const WORDS_PER_POSITION: u64 = 3;
const WORDS_PER_FACE: u64 = (size_of::<Face>() / 4) as u64;
const WORDS_PER_EDGE: u64 = (size_of::<Edge>() / 4) as u64;

impl PoolWords {
    fn largest(&self) -> u64 {
        [self.positions, self.faces, self.edges, self.incidences, self.vertex_edges].into_iter().fold(0, u64::max)
    }
}

impl MeshPool {
    /// Adds a mesh; `Err` holds the words that a pool would need, more than 32 bits can index.
    pub fn add(&mut self, mesh: Arc<TopologyAwareMesh>) -> Result<MeshHandle, u64> {
        let before = self.words;
        let offsets = mesh.vertex_edge_offsets.len() as u64;
        let after = PoolWords {
            positions: before.positions + WORDS_PER_POSITION * mesh.positions.len() as u64,
            faces: before.faces + WORDS_PER_FACE * mesh.faces.len() as u64,
            edges: before.edges + WORDS_PER_EDGE * u64::from(mesh.candidate_edge_count),
            incidences: before.incidences + mesh.incidences.len() as u64,
            vertex_edges: before.vertex_edges + offsets + 2 * mesh.vertex_edges.len() as u64,
        };
        if after.largest() > u64::from(u32::MAX) {
            return Err(after.largest());
        }
        self.ranges.push(MeshRange {
            first_position_word: before.positions as u32,
            first_face: (before.faces / WORDS_PER_FACE) as u32,
            face_count: mesh.faces.len() as u32,
            first_edge: (before.edges / WORDS_PER_EDGE) as u32,
            edge_count: mesh.candidate_edge_count,
            first_incidence: before.incidences as u32,
            first_vertex_offset_word: before.vertex_edges as u32,
            first_vertex_edge_word: (before.vertex_edges + offsets) as u32,
            near_one: NearOne::of_box(mesh.bounds_min, mesh.bounds_max),
            bounds_min: mesh.bounds_min,
            bounds_max: mesh.bounds_max,
        });
        self.facts.push(mesh_facts(&mesh));
        self.words = after;
        self.meshes.push(mesh);
        Ok(MeshHandle(self.meshes.len() - 1))
    }

    /// Where a mesh lies; `None` for a handle of another object.
    pub fn range(&self, handle: MeshHandle) -> Option<&MeshRange> {
        self.ranges.get(handle.0)
    }

    /// What the frame plan needs to know of each mesh.
    pub fn facts(&self) -> &[MeshFacts] {
        &self.facts
    }

    pub fn words(&self) -> PoolWords {
        self.words
    }

    /// Writes a whole pool with `write(byte offset, bytes)`.
    pub fn fill(&self, kind: BufferKind, mut write: impl FnMut(u64, &[u8])) {
        for (mesh, range) in self.meshes.iter().zip(&self.ranges) {
            let mut put = |word: u64, bytes: &[u8]| {
                if !bytes.is_empty() {
                    write(4 * word, bytes);
                }
            };
            match kind {
                BufferKind::Positions => {
                    put(u64::from(range.first_position_word), bytemuck::cast_slice(&mesh.positions));
                }
                BufferKind::Faces => {
                    put(WORDS_PER_FACE * u64::from(range.first_face), bytemuck::cast_slice(&mesh.faces));
                }
                BufferKind::Edges => {
                    let candidates = &mesh.edges[..mesh.candidate_edge_count as usize];
                    put(WORDS_PER_EDGE * u64::from(range.first_edge), bytemuck::cast_slice(candidates));
                }
                BufferKind::Incidences => {
                    put(u64::from(range.first_incidence), bytemuck::cast_slice(&mesh.incidences));
                }
                BufferKind::VertexEdges => {
                    let offsets = bytemuck::cast_slice(&mesh.vertex_edge_offsets);
                    put(u64::from(range.first_vertex_offset_word), offsets);
                    put(u64::from(range.first_vertex_edge_word), bytemuck::cast_slice(&mesh.vertex_edges));
                }
                _ => {}
            }
        }
    }
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
    }
}
