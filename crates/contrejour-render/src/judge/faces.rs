//! Numbers of faces.

use std::collections::HashMap;
use std::sync::Arc;

use contrejour_mesh::TriangleMesh;
use contrejour_scene::Scene;

/// The scene has more faces than can be numbered.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the scene shows {faces} faces, at most {MAX_FACES} can be told apart; simplify or split it")]
pub struct TooManyFaces {
    /// How many it shows.
    pub faces: u64,
}

/// Three corners of each face are numbered in 32 bits.
const MAX_FACES: u64 = u32::MAX as u64 / 3;

/// For each mesh of the scene the number of faces before it, and at the end the number of all.
pub(super) fn first_faces(scene: &Scene) -> Result<Vec<u32>, TooManyFaces> {
    let mut faces = 0;
    let mut first_faces = vec![0];
    for placed in &scene.meshes {
        faces += placed.mesh.triangles.len() as u64;
        first_faces.push(faces as u32);
    }
    if faces > MAX_FACES { Err(TooManyFaces { faces }) } else { Ok(first_faces) }
}

/// The same scene in which no two faces share a corner, so that a vertex's index tells its face: WebGPU's defaults have
/// no other way for a shader to know it. A mesh that stands in several places stays one mesh.
pub(super) fn with_separate_faces(scene: &Scene) -> Scene {
    let mut separated = scene.clone();
    let mut known = HashMap::new();
    for placed in &mut separated.meshes {
        let shared = Arc::clone(&placed.mesh);
        let separate = known.entry(Arc::as_ptr(&shared)).or_insert_with(|| Arc::new(separate_faces(&shared)));
        placed.mesh = Arc::clone(separate);
    }
    separated
}

fn separate_faces(mesh: &TriangleMesh) -> TriangleMesh {
    let corners = mesh.triangles.as_flattened();
    // A vertex without a normal is shaded by its face's.
    let value = |values: &[[f32; 3]], vertex: u32| values.get(vertex as usize).copied().unwrap_or_default();
    let of_corners = |values: &[[f32; 3]]| corners.iter().map(|&vertex| value(values, vertex)).collect();
    TriangleMesh {
        positions: of_corners(&mesh.positions),
        normals: of_corners(&mesh.normals),
        colors: of_corners(&mesh.colors),
        texture_coordinates: match &mesh.texture_coordinates[..] {
            [] => Vec::new(),
            coordinates => corners.iter().map(|&vertex| coordinates[vertex as usize]).collect(),
        },
        alphas: match &mesh.alphas[..] {
            [] => Vec::new(),
            alphas => corners.iter().map(|&vertex| alphas[vertex as usize]).collect(),
        },
        parts: mesh.parts.clone(),
        triangles: (0..mesh.triangles.len() as u32).map(|face| [3 * face, 3 * face + 1, 3 * face + 2]).collect(),
        ..TriangleMesh::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faces_stay_where_they_are_and_share_nothing() {
        let mut scene = Scene::built_in(Some("boxes")).expect("there is such a scene").expect("it is good");
        scene.meshes.push(scene.meshes[1].clone());
        let separated = with_separate_faces(&scene);
        assert!(Arc::ptr_eq(&separated.meshes[1].mesh, &separated.meshes[3].mesh));
        for (shared, separate) in scene.meshes.iter().zip(&separated.meshes) {
            let (shared, separate) = (&*shared.mesh, &*separate.mesh);
            assert_eq!(separate.positions.len(), 3 * shared.triangles.len());
            for (of_shared, of_separate) in shared.triangles.iter().zip(&separate.triangles) {
                for (&a, &b) in of_shared.iter().zip(of_separate) {
                    assert_eq!(shared.positions[a as usize], separate.positions[b as usize]);
                    assert_eq!(shared.normals[a as usize], separate.normals[b as usize]);
                    assert_eq!(shared.colors[a as usize], separate.colors[b as usize]);
                }
            }
        }
    }

    #[test]
    fn faces_are_numbered_through_the_meshes() {
        let mut scene = Scene::built_in(Some("boxes")).expect("there is such a scene").expect("it is good");
        scene.meshes[1].mesh = Arc::new(TriangleMesh::default());
        assert_eq!(first_faces(&scene), Ok(vec![0, 12, 12, 24]));
    }
}
