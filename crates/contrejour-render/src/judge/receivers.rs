//! The points on which shadow falls, as the CPU gets them.

use glam::Vec3;

/// The points on which the picture shows shadow, one for each pixel that has one.
#[derive(Clone, Debug, PartialEq)]
pub struct Receivers {
    /// Width and height of the picture, in pixels.
    pub size: [u32; 2],
    /// Rows from the top; `None` where the picture shows nothing, or a mesh that receives no shadow.
    pub points: Vec<Option<Receiver>>,
    /// For each mesh of the scene, in its order, the number of faces of the meshes before it; at the end the number of all
    /// faces. So mesh `k` has the face ids from `first_faces[k]` up to `first_faces[k + 1]`.
    pub first_faces: Vec<u32>,
}

/// The point of a face that a pixel's centre shows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Receiver {
    /// Where it is, [local space](crate::LocalSpace).
    pub position: Vec3,
    /// Unit normal of the flat face, turned to the eye, as the visibility function gets it. It is found from the points
    /// of neighbouring pixels, so on faces far from the local space's origin it is rounded more coarsely than a normal
    /// from the face's corners.
    pub normal: Vec3,
    /// The face, by its number through all meshes of the scene: [`Receivers::first_faces`] and its place in its mesh.
    pub face_id: u32,
}

impl Receivers {
    /// Index of a face's mesh in the scene, and of the face in its mesh. `None` for a number that no face has.
    pub fn mesh_and_face(&self, face_id: u32) -> Option<(usize, usize)> {
        let following = self.first_faces.partition_point(|&first| first <= face_id);
        let mesh = following.checked_sub(1).filter(|_| following < self.first_faces.len())?;
        Some((mesh, (face_id - self.first_faces[mesh]) as usize))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_names_one_face_of_one_mesh() {
        // The second mesh has no faces.
        let receivers = Receivers { size: [0, 0], points: Vec::new(), first_faces: vec![0, 2, 2, 5] };
        let found: Vec<_> = (0..6).map(|face_id| receivers.mesh_and_face(face_id)).collect();
        assert_eq!(found, [Some((0, 0)), Some((0, 1)), Some((2, 0)), Some((2, 1)), Some((2, 2)), None]);
    }
}
