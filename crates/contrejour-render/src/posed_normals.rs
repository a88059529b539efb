//! Normals of meshes that deform.

use std::collections::HashMap;

use contrejour_mesh::TriangleMesh;
use glam::{DVec3, Vec3};

/// Cosine up to which normals at one place are one: rounding apart, those of a seam in textures.
const SAME_NORMAL: f32 = 0.999;

/// Which vertices of a mesh share a normal: those with the same place and normal at rest. So what is smooth at rest stays
/// smooth, and what has a crease keeps it.
#[derive(Clone, Debug)]
pub(crate) struct PosedNormals {
    group_of_vertex: Vec<usize>,
    group_count: usize,
}

impl PosedNormals {
    pub fn new(rest: &TriangleMesh) -> Self {
        let mut groups_at: HashMap<[u32; 3], Vec<(Vec3, usize)>> = HashMap::new();
        let mut group_count = 0;
        let mut group_of = |(position, normal): (&[f32; 3], &[f32; 3])| {
            let normal = Vec3::from(*normal);
            let groups = groups_at.entry(position.map(|coordinate| (coordinate + 0.0).to_bits())).or_default();
            if let Some(&(_, group)) = groups.iter().find(|(other, _)| other.dot(normal) > SAME_NORMAL) {
                return group;
            }
            groups.push((normal, group_count));
            group_count += 1;
            group_count - 1
        };
        let group_of_vertex = rest.positions.iter().zip(&rest.normals).map(&mut group_of).collect();
        Self { group_of_vertex, group_count }
    }

    /// The normals where the vertices are now: of each group the mean of its faces' normals, by their area.
    pub fn at(&self, positions: &[DVec3], triangles: &[[u32; 3]]) -> Vec<[f32; 3]> {
        let mut sums = vec![DVec3::ZERO; self.group_count];
        for triangle in triangles {
            let [a, b, c] = triangle.map(|vertex| positions[vertex as usize]);
            let normal = (b - a).cross(c - a);
            triangle.iter().for_each(|&vertex| sums[self.group_of_vertex[vertex as usize]] += normal);
        }
        // One of no length is shaded by its face's.
        let unit: Vec<[f32; 3]> = sums.iter().map(|sum| sum.normalize_or_zero().as_vec3().to_array()).collect();
        self.group_of_vertex.iter().map(|&group| unit[group]).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn seams_stay_smooth_and_creases_sharp() {
        // Two faces in one plane that a seam parts, and a third one that stands on them.
        let up = [0.0, 0.0, 1.0];
        let side = [1.0, 0.0, 0.0];
        let mesh = TriangleMesh {
            positions: vec![
                [0.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
                [-1.0, 0.0, 0.0],
                [0.0, 0.0, 0.0],
                [1.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
                [0.0, 0.0, 0.0],
                [0.0, 1.0, 0.0],
                [0.0, 0.0, 1.0],
            ],
            normals: vec![up, up, up, up, up, up, side, side, side],
            triangles: vec![[0, 1, 2], [3, 4, 5], [6, 7, 8]],
            ..TriangleMesh::default()
        };
        let mut positions: Vec<_> = mesh.positions.iter().map(|p| DVec3::from(p.map(f64::from))).collect();
        positions[4].z = 1.0;
        let normals = PosedNormals::new(&mesh).at(&positions, &mesh.triangles);
        assert_eq!(normals[0], normals[3]);
        assert_eq!(normals[1], normals[5]);
        assert!(normals[0][0] < -0.1 && normals[0][2] > 0.1, "{:?}", normals[0]);
        assert_eq!(normals[2], up);
        assert_eq!(normals[6], side);
    }
}
