//! What the plan is made from.

use contrejour_layout::BLOCK_SIZE;

use crate::ObjectBox;

/// Counts of a mesh with topology, as the mesh crate finds them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MeshFacts {
    /// Source vertices.
    pub vertices: u32,
    /// Faces.
    pub faces: u32,
    /// Edges with two faces that can be in a silhouette.
    pub two_face_edges: u32,
    /// Border and non-manifold edges that can be in a silhouette.
    pub other_edges: u32,
    /// Words of incidence lists.
    pub incidence_words: u32,
    /// Edges in the lists of all vertices together.
    pub vertex_edges: u32,
    /// Whether a mask cuts its faces; then it has no edges.
    pub is_masked: bool,
}

/// The masks of all meshes together.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct MaskFacts {
    /// How many there are.
    pub count: u64,
    /// Words of their vertices and pictures.
    pub words: u64,
}

/// What of a mesh lies in one page: whole blocks of its faces and of its edges. Faces and edges keep their ids.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct MeshPiece {
    /// Index into [`SceneFacts::meshes`].
    pub mesh: usize,
    /// Its first face, which begins a block.
    pub first_face: u32,
    /// Faces.
    pub faces: u32,
    /// Its first edge, which begins a block.
    pub first_edge: u32,
    /// Edges with two faces.
    pub two_face_edges: u32,
    /// Border and non-manifold edges.
    pub other_edges: u32,
    /// Where its edges' incidence lists begin among those of the mesh, in words.
    pub first_incidence_word: u32,
    /// Words of its edges' incidence lists.
    pub incidence_words: u32,
    /// Edges in the lists of its edges' vertices together, also those of other pieces.
    pub vertex_edges: u32,
}

/// A mesh that casts a shadow, where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct CasterFacts {
    /// Where its records are among those of all casters.
    pub slot: usize,
    /// What a reader of the plan calls it.
    pub name: String,
    /// Index into [`SceneFacts::meshes`].
    pub mesh: usize,
    /// Box around its positions, and its matrix. `None` where the positions are not known to the CPU: it is then
    /// taken to be in every frustum, and its matrix to be good.
    pub bounds: Option<ObjectBox>,
    /// Words of positions that the caller brings for this caster; 0 where it uses those of its mesh.
    pub own_position_words: u64,
}

/// Room that is free between what lies in the pools: what stays keeps its place when something goes. Default: none.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct PoolHoles {
    /// Words among the positions.
    pub position_words: u64,
    /// Faces; not where the scene fills several pages, which are packed.
    pub faces: u64,
    /// Edges; as for faces.
    pub edges: u64,
    /// Incidence words; as for faces.
    pub incidence_words: u64,
    /// Words of vertex edges; as for faces.
    pub vertex_edge_words: u64,
    /// Blocks of faces. Those of lit bits lie as they do.
    pub face_blocks: u64,
    /// Blocks of edges. Those of outline sides lie as they do.
    pub edge_blocks: u64,
}

/// What there is to shadow.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneFacts {
    /// Meshes with topology; several casters can share one.
    pub meshes: Vec<MeshFacts>,
    /// Pieces of the meshes that are too large for one page, by ascending mesh; none of the others.
    pub pieces: Vec<MeshPiece>,
    /// What casts.
    pub casters: Vec<CasterFacts>,
    /// Names of the meshes that only receive: they have no topology.
    pub receivers: Vec<String>,
    /// What cuts the faces of some of the meshes.
    pub masks: MaskFacts,
    /// Room that is free between them.
    pub holes: PoolHoles,
}

/// What the device can do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct DeviceFacts {
    /// Whether it blends 32-bit float targets. Default: no.
    pub float32_blendable: bool,
    /// Whether its samplers weigh 32-bit floats. Default: no.
    pub float32_filterable: bool,
    /// Largest storage buffer that a shader can see, in bytes. Default: 128 MiB, as WebGPU guarantees.
    pub max_storage_buffer_binding_size: u64,
    /// Largest buffer, in bytes. Default: 256 MiB, as WebGPU guarantees.
    pub max_buffer_size: u64,
    /// Most texels along a side of a texture. Default: 8192, as WebGPU guarantees.
    pub max_texture_dimension_2d: u32,
}

/// What the caller wants of a frame. Default: the maps.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum Outputs {
    /// The list of silhouette edges, wherever the light's frustum ends.
    Silhouettes,
    /// The maps, for the visibility function in the caller's own shader.
    #[default]
    Maps,
    /// The maps, and a full-screen texture of visibility from the caller's depth buffer.
    VisibilityTexture,
}

impl CasterFacts {
    /// Whether the planes of its faces are known. Those of positions that the caller brings are not.
    pub(super) const fn has_planes(&self) -> bool {
        self.own_position_words == 0
    }
}

impl SceneFacts {
    /// Records of casters that there are, also those that no caster has.
    pub fn caster_slots(&self) -> usize {
        self.casters.iter().map(|caster| caster.slot + 1).max().unwrap_or(0)
    }
}

impl MeshPiece {
    /// The whole mesh.
    pub fn whole(mesh: usize, facts: &MeshFacts) -> Self {
        Self {
            mesh,
            faces: facts.faces,
            two_face_edges: facts.two_face_edges,
            other_edges: facts.other_edges,
            incidence_words: facts.incidence_words,
            vertex_edges: facts.vertex_edges,
            ..Self::default()
        }
    }

    /// Its edges.
    pub const fn edges(&self) -> u32 {
        self.two_face_edges + self.other_edges
    }

    /// Blocks of its faces.
    pub const fn face_blocks(&self) -> u32 {
        self.faces.div_ceil(BLOCK_SIZE)
    }

    /// Blocks of its edges.
    pub const fn edge_blocks(&self) -> u32 {
        self.edges().div_ceil(BLOCK_SIZE)
    }
}

impl Default for DeviceFacts {
    fn default() -> Self {
        Self {
            float32_blendable: false,
            float32_filterable: false,
            max_storage_buffer_binding_size: 128 << 20,
            max_buffer_size: 256 << 20,
            max_texture_dimension_2d: 8192,
        }
    }
}
