//! Triangles as they come from a file or a generator, before any topology.

use glam::DMat4;

/// Triangles with what a renderer needs to shade them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TriangleMesh {
    /// Name in the file; may be empty.
    pub name: String,
    /// Position of each vertex, in object space.
    pub positions: Vec<[f32; 3]>,
    /// Unit normal of each vertex; as many as positions.
    pub normals: Vec<[f32; 3]>,
    /// Linear base colour of each vertex, 0..1; as many as positions.
    pub colors: Vec<[f32; 3]>,
    /// Vertex indices of each triangle, counter-clockwise from its front.
    pub triangles: Vec<[u32; 3]>,
    /// Number of each vertex in its file; of vertices with the same position the lowest stands for all.
    pub vertex_numbers: Vec<u32>,
    /// Vertices of the file that no face uses and that are not in `positions`.
    pub unlisted_vertices: u32,
}

/// A mesh placed in its file's world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MeshNode {
    /// Index into [`MeshFile::meshes`].
    pub mesh: usize,
    /// World space from the mesh's object space.
    pub world_from_object: DMat4,
}

/// What one file brings.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct MeshFile {
    /// Meshes; OBJ, PLY and STL bring one, glTF one for each mesh node, in depth-first order of its scene.
    pub meshes: Vec<TriangleMesh>,
    /// Where the meshes stand.
    pub nodes: Vec<MeshNode>,
}
