//! What stops a mesh from being built.

/// Most faces of one mesh: 715 827 882, so that both ends of three edges a face can be counted in a `u32`.
pub const MAX_FACES: usize = u32::MAX as usize / 6;

/// Most source vertices of one mesh: 2^31, so that the weld table's slots can be numbered in a `u32`.
pub const MAX_VERTICES: usize = 1 << 31;

/// Why a topology-aware mesh could not be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TopologyError {
    /// A face names a vertex that does not exist.
    #[error(
        "face {face} names vertex {index}, but there are {vertices} vertices: \
         correct the index or add the missing vertices"
    )]
    IndexOutOfRange {
        /// The first face that does.
        face: u32,
        /// The index.
        index: u32,
        /// Number of source vertices.
        vertices: u32,
    },
    /// A position is infinite or not a number.
    #[error("vertex {vertex} is at ({}, {}, {}): remove it or give it finite coordinates", .position[0], .position[1], .position[2])]
    NonFinitePosition {
        /// The first vertex that is.
        vertex: u32,
        /// Its position.
        position: [f32; 3],
    },
    /// More faces than ids.
    #[error("{faces} faces are more than the {MAX_FACES} that one mesh can have: split the mesh")]
    TooManyFaces {
        /// Number of faces.
        faces: usize,
    },
    /// More vertices than ids.
    #[error("{vertices} vertices are more than the {MAX_VERTICES} that one mesh can have: split the mesh")]
    TooManyVertices {
        /// Number of source vertices.
        vertices: usize,
    },
    /// The weld data does not have the same number of bytes for every vertex.
    #[error(
        "{bytes} bytes of weld data can't be shared equally by {vertices} vertices: \
         give every vertex the same number of bytes"
    )]
    UnevenWeldData {
        /// Length of the weld data.
        bytes: usize,
        /// Number of source vertices.
        vertices: usize,
    },
    /// The weld distance is negative, infinite or not a number.
    #[error("the weld distance is {distance}: give a finite distance that is not negative, or none")]
    WeldDistance {
        /// The distance.
        distance: f32,
    },
}
