//! How large each buffer is.

use contrejour_layout::{LIT_WORDS_PER_BLOCK, OUTLINE_WORDS_PER_BLOCK};

use super::capacity::expected_outline_edges;
use super::{
    BufferKind, BufferPlan, Capacity, DeviceFacts, MaskFacts, MeshFacts, MeshPiece, PlanError, PoolHoles, SceneFacts,
};

/// Entries of item, refine and extrude arguments: each serves two stages.
const INDIRECT_DISPATCHES: u64 = 2;

/// Faces, quads, corners and masked faces.
const INDIRECT_DRAWS: u64 = 4;

/// A bundle has 1, 2, 4 or 8 seats.
const BUNDLE_SHAPES: u64 = 4;

/// Sizes of the buffers that serve all pages, with room for all casters of a scene, whether the light sees them or not:
/// it may in the next frame, and nothing is to be created then.
pub(super) struct SceneSizes {
    casters: u64,
    views: u64,
    position_words: u64,
    face_blocks: u64,
    edge_blocks: u64,
    masks: MaskFacts,
}

/// Sizes of the buffers of one page, which has room for all its casters too.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct PageSizes {
    /// Those of the scene: the same index names a caster on each page.
    casters: u64,
    /// Sums over the pieces.
    pool_faces: u64,
    pool_edges: u64,
    incidence_words: u64,
    vertex_edge_words: u64,
    /// Sums over the casters of the pieces.
    faces: u64,
    edges: u64,
    face_blocks: u64,
    edge_blocks: u64,
    /// Blocks of nobody between theirs.
    free_face_blocks: u64,
    free_edge_blocks: u64,
    /// No caster has planes.
    lacks_planes: bool,
    /// No stage looks at edges.
    lacks_edges: bool,
    /// No stage tests faces.
    lacks_tests: bool,
    outline_edges: u64,
    /// Room in lists that earlier frames are known to need.
    floor: Capacity,
}

impl SceneSizes {
    pub fn new(scene: &SceneFacts, views: usize) -> Self {
        let mesh_words: u64 = scene.meshes.iter().map(|mesh| 3 * u64::from(mesh.vertices)).sum();
        let own_words: u64 = scene.casters.iter().map(|caster| caster.own_position_words).sum();
        let cast = scene.casters.iter().map(|caster| MeshPiece::whole(caster.mesh, &scene.meshes[caster.mesh]));
        Self {
            casters: scene.caster_slots() as u64,
            views: views as u64,
            position_words: mesh_words + own_words + scene.holes.position_words,
            face_blocks: cast.clone().map(|mesh| u64::from(mesh.face_blocks())).sum::<u64>() + scene.holes.face_blocks,
            edge_blocks: cast.map(|mesh| u64::from(mesh.edge_blocks())).sum::<u64>() + scene.holes.edge_blocks,
            masks: scene.masks,
        }
    }

    /// The views of the light, as a page has them.
    pub fn light_views(&self, page: usize) -> BufferPlan {
        BufferPlan::new(BufferKind::LightView, page, self.views)
    }

    /// A buffer that serves all pages.
    ///
    /// # Errors
    ///
    /// The device allows less, or shaders can't count so far.
    pub fn buffer(&self, kind: BufferKind, device: &DeviceFacts) -> Result<BufferPlan, PlanError> {
        let items = match kind {
            BufferKind::Positions => self.position_words,
            BufferKind::Masks => self.masks.count,
            BufferKind::MaskWords => self.masks.words,
            BufferKind::CasterPlaces | BufferKind::CasterLights => self.casters,
            BufferKind::ReceiverView => self.views,
            BufferKind::Lit => self.face_blocks * u64::from(LIT_WORDS_PER_BLOCK),
            BufferKind::OutlineSides => self.edge_blocks * u64::from(OUTLINE_WORDS_PER_BLOCK),
            _ => 1,
        };
        allowed(BufferPlan::new(kind, 0, items), device)
    }
}

impl PageSizes {
    /// Sizes of a page without pieces.
    pub fn new(scene: &SceneFacts, kinds: &[BufferKind], floor: Capacity, lacks_planes: bool) -> Self {
        let lacks_edges = !kinds.contains(&BufferKind::Edges);
        let lacks_tests = !kinds.contains(&BufferKind::Lit);
        Self { casters: scene.caster_slots() as u64, lacks_planes, lacks_edges, lacks_tests, floor, ..Self::default() }
    }

    /// Makes room for what is free between pieces and between blocks.
    pub fn add_holes(&mut self, holes: &PoolHoles) {
        self.pool_faces += holes.faces;
        self.pool_edges += holes.edges;
        self.incidence_words += holes.incidence_words;
        self.vertex_edge_words += holes.vertex_edge_words;
        self.free_face_blocks += holes.face_blocks;
        self.free_edge_blocks += holes.edge_blocks;
    }

    /// Makes room for a piece in the pools.
    pub fn add_piece(&mut self, piece: &MeshPiece, mesh: &MeshFacts) {
        self.pool_faces += u64::from(piece.faces);
        self.pool_edges += u64::from(piece.edges());
        self.incidence_words += u64::from(piece.incidence_words);
        // Offsets have one more than there are vertices; an entry is an edge and a vertex.
        self.vertex_edge_words += u64::from(mesh.vertices) + 1 + 2 * u64::from(piece.vertex_edges);
    }

    /// Makes room for what the stages write about so many casters of a piece.
    pub fn add_casters(&mut self, piece: &MeshPiece, mesh: &MeshFacts, count: u64) {
        self.faces += count * u64::from(piece.faces);
        self.edges += count * u64::from(piece.edges());
        self.face_blocks += count * u64::from(piece.face_blocks());
        self.edge_blocks += count * u64::from(piece.edge_blocks());
        self.outline_edges += count * expected_outline_edges(mesh.faces, piece.two_face_edges, piece.other_edges);
    }

    /// Blocks that the page lists from: those of faces, and those of edges where a stage looks at them.
    pub fn blocks(&self) -> [u32; 2] {
        [BufferKind::FaceBlocks, BufferKind::EdgeBlocks].map(|kind| self.items(kind) as u32)
    }

    /// Records, or words, that the scene is expected to need, whatever earlier frames did.
    pub fn expected_items(&self, kind: BufferKind) -> u64 {
        Self { floor: Capacity::default(), ..*self }.items(kind)
    }

    /// Records, or words, of a buffer.
    fn items(&self, kind: BufferKind) -> u64 {
        let capacity = Capacity::expecting(self.outline_edges, self.edges, self.floor);
        match kind {
            BufferKind::Faces | BufferKind::FaceNeighbours | BufferKind::StreamFaces | BufferKind::HalfStreamFaces => {
                self.pool_faces
            }
            BufferKind::Planes if self.lacks_planes => 0,
            BufferKind::Planes => self.pool_faces,
            BufferKind::Edges => self.pool_edges,
            BufferKind::EdgeFans | BufferKind::Incidences => self.incidence_words,
            BufferKind::VertexEdges => self.vertex_edge_words,
            BufferKind::Casters => self.casters,
            // Masked ones lie at the back of as long a list.
            BufferKind::FaceBlocks | BufferKind::FaceItems => self.face_blocks + self.free_face_blocks,
            BufferKind::FaceTests if self.lacks_tests => 0,
            BufferKind::FaceTests => self.face_blocks,
            BufferKind::EdgeBlocks | BufferKind::EdgeTests if self.lacks_edges => 0,
            BufferKind::EdgeBlocks => self.edge_blocks + self.free_edge_blocks,
            BufferKind::EdgeTests => self.edge_blocks,
            BufferKind::RecheckWords => self.face_blocks * u64::from(LIT_WORDS_PER_BLOCK),
            BufferKind::Undecided => self.faces,
            BufferKind::Silhouettes => capacity.silhouettes.into(),
            BufferKind::Quads => capacity.quads.into(),
            BufferKind::Corners => capacity.corners.into(),
            BufferKind::ItemArgs | BufferKind::RefineArgs | BufferKind::ExtrudeArgs => INDIRECT_DISPATCHES,
            BufferKind::DrawArgs => INDIRECT_DRAWS,
            BufferKind::BundleShapes => BUNDLE_SHAPES,
            _ => 1,
        }
    }

    /// A buffer of a page.
    ///
    /// # Errors
    ///
    /// The device allows less, or shaders can't count so far.
    pub fn buffer(&self, kind: BufferKind, page: usize, device: &DeviceFacts) -> Result<BufferPlan, PlanError> {
        allowed(BufferPlan::new(kind, page, self.items(kind)), device)
    }

    /// Whether the device allows all paged buffers among these kinds.
    pub fn fit(&self, kinds: &[BufferKind], device: &DeviceFacts) -> bool {
        let mut paged = kinds.iter().filter(|kind| kind.is_paged());
        paged.all(|kind| self.buffer(*kind, 0, device).is_ok())
    }
}

/// Most records, or words, that a buffer may have.
pub(super) fn most_items(kind: BufferKind, device: &DeviceFacts) -> u64 {
    let bytes = device.max_storage_buffer_binding_size.min(device.max_buffer_size);
    (bytes / kind.item_bytes()).min(u32::MAX.into())
}

pub(super) fn allowed(plan: BufferPlan, device: &DeviceFacts) -> Result<BufferPlan, PlanError> {
    let BufferPlan { kind, items, bytes, .. } = plan;
    if items.saturating_mul(plan.seats.into()) > u64::from(u32::MAX) {
        return Err(PlanError::TooManyRecords { buffer: kind, needed: items });
    }
    let limits = [
        (device.max_storage_buffer_binding_size, "max_storage_buffer_binding_size"),
        (device.max_buffer_size, "max_buffer_size"),
    ];
    for (limit, limit_name) in limits {
        if bytes > limit {
            return Err(PlanError::BufferTooLarge { buffer: kind, needed: bytes, limit, limit_name });
        }
    }
    Ok(plan)
}
