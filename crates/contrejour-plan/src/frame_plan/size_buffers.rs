//! How large each buffer is.

use contrejour_layout::{LIT_WORDS_PER_BLOCK, OUTLINE_WORDS_PER_BLOCK};

use super::{BufferKind, BufferPlan, Capacity, DeviceFacts, MeshFacts, PlanError, SceneFacts};

/// Entries of refine, extrude and draw arguments: each serves two stages or draws.
const INDIRECT_ENTRIES: u64 = 2;

/// Sums over all casters of a scene, whether the light sees them or not: it may in the next frame, and nothing is to
/// be created then.
pub(super) struct SceneSizes {
    casters: u64,
    faces: u64,
    edges: u64,
    face_blocks: u64,
    edge_blocks: u64,
    own_position_words: u64,
    pool: PoolSizes,
    pub capacity: Capacity,
}

/// Sums over all meshes of a scene.
#[derive(Default)]
struct PoolSizes {
    vertices: u64,
    faces: u64,
    edges: u64,
    incidence_words: u64,
    vertex_edge_words: u64,
}

impl SceneSizes {
    /// `cast_meshes` are the meshes of the casters, with repetition.
    pub fn new<'a>(
        scene: &SceneFacts,
        cast_meshes: impl Iterator<Item = &'a MeshFacts> + Clone,
        floor: Capacity,
    ) -> Self {
        let sum = |size: fn(&MeshFacts) -> u64| cast_meshes.clone().map(size).sum();
        Self {
            casters: scene.casters.len() as u64,
            faces: sum(|mesh| mesh.faces.into()),
            edges: sum(MeshFacts::edges),
            face_blocks: sum(MeshFacts::face_blocks),
            edge_blocks: sum(MeshFacts::edge_blocks),
            own_position_words: scene.casters.iter().map(|caster| caster.own_position_words).sum(),
            pool: PoolSizes::new(&scene.meshes),
            capacity: Capacity::of_casters(cast_meshes.clone(), floor),
        }
    }

    /// Records, or words, of a buffer.
    pub fn items(&self, kind: BufferKind) -> u64 {
        match kind {
            BufferKind::Positions => 3 * self.pool.vertices + self.own_position_words,
            BufferKind::Faces => self.pool.faces,
            BufferKind::Edges => self.pool.edges,
            BufferKind::Incidences => self.pool.incidence_words,
            BufferKind::VertexEdges => self.pool.vertex_edge_words,
            BufferKind::Casters | BufferKind::CasterLights => self.casters,
            BufferKind::FaceItems => self.face_blocks,
            BufferKind::EdgeItems => self.edge_blocks,
            BufferKind::LightView | BufferKind::ReceiverView | BufferKind::Counters => 1,
            BufferKind::Lit => self.face_blocks * u64::from(LIT_WORDS_PER_BLOCK),
            BufferKind::Undecided => self.faces,
            BufferKind::Silhouettes => self.edges,
            BufferKind::OutlineSides => self.edge_blocks * u64::from(OUTLINE_WORDS_PER_BLOCK),
            BufferKind::Quads => self.capacity.quads.into(),
            BufferKind::Corners => self.capacity.corners.into(),
            BufferKind::RefineArgs | BufferKind::ExtrudeArgs | BufferKind::DrawArgs => INDIRECT_ENTRIES,
        }
    }

    /// A buffer with room for everything.
    ///
    /// # Errors
    ///
    /// The device allows less, or shaders can't count so far.
    pub fn buffer(&self, kind: BufferKind, device: &DeviceFacts) -> Result<BufferPlan, PlanError> {
        let plan = BufferPlan::new(kind, self.items(kind));
        if plan.items > u64::from(u32::MAX) {
            return Err(PlanError::TooManyRecords { buffer: kind, needed: plan.items });
        }
        let limits = [
            (device.max_storage_buffer_binding_size, "max_storage_buffer_binding_size"),
            (device.max_buffer_size, "max_buffer_size"),
        ];
        for (limit, limit_name) in limits {
            if plan.bytes > limit {
                return Err(PlanError::BufferTooLarge { buffer: kind, needed: plan.bytes, limit, limit_name });
            }
        }
        Ok(plan)
    }
}

impl PoolSizes {
    fn new(meshes: &[MeshFacts]) -> Self {
        let mut sizes = Self::default();
        for mesh in meshes {
            sizes.vertices += u64::from(mesh.vertices);
            sizes.faces += u64::from(mesh.faces);
            sizes.edges += mesh.edges();
            sizes.incidence_words += u64::from(mesh.incidence_words);
            // Offsets have one more than there are vertices; an entry is an edge and a vertex.
            sizes.vertex_edge_words += u64::from(mesh.vertices) + 1 + 2 * u64::from(mesh.vertex_edges);
        }
        sizes
    }
}
