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
}

/// A mesh that casts a shadow, where it stands.
#[derive(Clone, Debug, PartialEq)]
pub struct CasterFacts {
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

/// What there is to shadow.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SceneFacts {
    /// Meshes with topology; several casters can share one.
    pub meshes: Vec<MeshFacts>,
    /// What casts.
    pub casters: Vec<CasterFacts>,
    /// Names of the meshes that only receive: they have no topology.
    pub receivers: Vec<String>,
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

impl MeshFacts {
    /// Edges that can be in a silhouette.
    pub const fn edges(&self) -> u64 {
        self.two_face_edges as u64 + self.other_edges as u64
    }

    pub(super) const fn face_blocks(&self) -> u64 {
        (self.faces as u64).div_ceil(BLOCK_SIZE as u64)
    }

    pub(super) const fn edge_blocks(&self) -> u64 {
        self.edges().div_ceil(BLOCK_SIZE as u64)
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
