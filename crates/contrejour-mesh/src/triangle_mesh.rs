//! Triangles as they come from a file or a generator, before any topology.

use std::borrow::Cow;
use std::ops::Range;
use std::sync::Arc;

use glam::{DMat4, DVec3};

use crate::{FileCamera, FileLight, Texture};

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
    /// Alpha of each vertex, 0..1; as many as positions, or none where no part is cut by alpha.
    pub alphas: Vec<f32>,
    /// Texture coordinates of each vertex, (0, 0) at the upper left corner of a picture and (1, 1) at the lower right one;
    /// as many as positions, or none where no part has a texture.
    pub texture_coordinates: Vec<[f32; 2]>,
    /// The triangles that have a texture or are cut by alpha; ascending, and no triangle is in two of them. A vertex of what
    /// is cut is in no part with another cutoff.
    pub parts: Vec<MaterialPart>,
    /// Vertex indices of each triangle, counter-clockwise from its front.
    pub triangles: Vec<[u32; 3]>,
    /// Number of each vertex in its file; of vertices with the same position the lowest stands for all.
    pub vertex_numbers: Vec<u32>,
    /// Vertices of the file that no face uses and that are not in `positions`.
    pub unlisted_vertices: u32,
}

impl TriangleMesh {
    /// Linear base colour where a file says nothing: a light grey.
    pub const DEFAULT_COLOR: [f32; 3] = [0.8; 3];

    /// The triangles that no alpha cuts: those with silhouettes.
    pub fn uncut_triangles(&self) -> Cow<'_, [[u32; 3]]> {
        if self.cut_parts().next().is_none() {
            return Cow::Borrowed(&self.triangles);
        }
        let mut uncut = Vec::new();
        let mut next = 0;
        for (part, _) in self.cut_parts() {
            uncut.extend_from_slice(&self.triangles[next..part.triangles.start as usize]);
            next = part.triangles.end as usize;
        }
        uncut.extend_from_slice(&self.triangles[next..]);
        Cow::Owned(uncut)
    }

    /// The triangles of a part.
    ///
    /// # Panics
    ///
    /// When the mesh has no such triangles.
    pub fn triangles_of(&self, part: &MaterialPart) -> &[[u32; 3]] {
        &self.triangles[part.triangles.start as usize..part.triangles.end as usize]
    }

    /// Alpha of a vertex; 1 where the mesh has none.
    pub fn alpha(&self, vertex: u32) -> f32 {
        self.alphas.get(vertex as usize).copied().unwrap_or(1.0)
    }

    /// How many triangles alpha cuts.
    pub fn cut_triangle_count(&self) -> usize {
        self.cut_parts().map(|(part, _)| part.triangles.len()).sum()
    }

    /// The parts that alpha cuts, each with its cutoff.
    pub fn cut_parts(&self) -> impl Iterator<Item = (&MaterialPart, f32)> {
        self.parts.iter().filter_map(|part| Some((part, part.alpha_cutoff?)))
    }
}

/// Triangles of a mesh that one material colours or cuts.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialPart {
    /// Which of the mesh's triangles.
    pub triangles: Range<u32>,
    /// What colours and alphas of vertices are multiplied by.
    pub texture: Option<Arc<Texture>>,
    /// Alpha below which there is nothing, more than 0; none where alpha does not matter.
    pub alpha_cutoff: Option<f32>,
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
    /// Cameras of a glTF file's scene, in depth-first order; other formats bring none.
    pub cameras: Vec<FileCamera>,
    /// Lights of a glTF file's scene, in the same order.
    pub lights: Vec<FileLight>,
    /// What the file holds and the loader leaves out or replaces, one line each; empty when nothing is lost.
    pub warnings: Vec<String>,
}

impl MeshFile {
    /// A file of one mesh that stands at the origin of its world.
    pub fn single(mesh: TriangleMesh, warnings: Vec<String>) -> Self {
        let node = MeshNode { mesh: 0, world_from_object: DMat4::IDENTITY };
        Self { meshes: vec![mesh], nodes: vec![node], warnings, ..Self::default() }
    }

    /// Number of triangles in the file's world: those of each node's mesh.
    pub fn triangle_count(&self) -> usize {
        self.nodes.iter().map(|node| self.meshes[node.mesh].triangles.len()).sum()
    }

    /// Smallest and largest corner of the box around all corners of triangles, in world space; `None` without triangles.
    pub fn bounds_world(&self) -> Option<(DVec3, DVec3)> {
        let corners_world = self.nodes.iter().flat_map(|node| {
            let mesh = &self.meshes[node.mesh];
            mesh.triangles.as_flattened().iter().map(|&vertex| {
                let position = mesh.positions[vertex as usize].map(f64::from);
                node.world_from_object.transform_point3(position.into())
            })
        });
        corners_world.map(|corner| (corner, corner)).reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
    }
}
