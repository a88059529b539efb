//! A surface under construction.

use contrejour_mesh::TriangleMesh;
use glam::DVec3;

/// Linear base colour of generated shapes; a scene's material usually replaces it.
const BASE_COLOR: [f32; 3] = [0.8; 3];

/// Vertices with normals, and triangles counter-clockwise from their front.
#[derive(Default)]
pub(super) struct Surface {
    pub positions: Vec<DVec3>,
    pub normals: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
}

impl Surface {
    /// Adds a vertex and returns its index.
    pub fn vertex(&mut self, position: DVec3, normal: DVec3) -> u32 {
        let index = self.positions.len() as u32;
        self.positions.push(position);
        self.normals.push(normal);
        index
    }

    /// Adds the two triangles of a quad whose corners are given counter-clockwise.
    pub fn quad(&mut self, [a, b, c, d]: [u32; 4]) {
        self.triangles.push([a, b, c]);
        self.triangles.push([a, c, d]);
    }

    /// Adds a quad with four vertices of its own and one flat normal.
    pub fn flat_quad(&mut self, corners: [DVec3; 4]) {
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize_or_zero();
        let quad = corners.map(|corner| self.vertex(corner, normal));
        self.quad(quad);
    }

    /// The finished mesh.
    pub fn into_mesh(self, name: &str) -> TriangleMesh {
        let vertex_count = self.positions.len();
        TriangleMesh {
            name: name.to_owned(),
            positions: self.positions.iter().map(|position| position.as_vec3().to_array()).collect(),
            normals: self.normals.iter().map(|normal| normal.as_vec3().to_array()).collect(),
            colors: vec![BASE_COLOR; vertex_count],
            triangles: self.triangles,
            vertex_numbers: (0..vertex_count as u32).collect(),
            ..TriangleMesh::default()
        }
    }
}
