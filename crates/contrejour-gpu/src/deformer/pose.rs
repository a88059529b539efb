//! The pose of a caster, as it goes to the device.

use contrejour_layout::JointMatrix;
use contrejour_mesh::DeformingMesh;
use glam::DMat4;

use super::{DeformHandle, SetPoseError};

/// Joint matrices and morph weights in 32 bits.
#[derive(Debug)]
pub(super) struct DevicePose {
    pub joint_matrices: Vec<JointMatrix>,
    pub morph_weights: Vec<f32>,
}

const JOINT_MATRICES: &str = "joint matrices";
const MORPH_WEIGHTS: &str = "morph weights";

impl DevicePose {
    /// # Errors
    ///
    /// The pose has other joints or morph targets than the mesh, or numbers that are not finite.
    pub fn new(
        caster: DeformHandle,
        mesh: &DeformingMesh,
        (joint_matrices, morph_weights): (&[DMat4], &[f64]),
    ) -> Result<Self, SetPoseError> {
        let counts = [
            (JOINT_MATRICES, joint_matrices.len(), mesh.joint_count()),
            (MORPH_WEIGHTS, morph_weights.len(), mesh.morph_count()),
        ];
        for (what, given, needed) in counts {
            if given != needed as usize {
                return Err(SetPoseError::Count { caster, what, given, needed });
            }
        }
        let joint_matrices: Vec<_> = joint_matrices.iter().map(joint_matrix).collect();
        let morph_weights: Vec<_> = morph_weights.iter().map(|&weight| weight as f32).collect();
        if !joint_matrices.iter().flat_map(|matrix| matrix.rows.as_flattened()).all(|number| number.is_finite()) {
            return Err(SetPoseError::NotFinite { caster, what: JOINT_MATRICES });
        }
        if !morph_weights.iter().all(|weight| weight.is_finite()) {
            return Err(SetPoseError::NotFinite { caster, what: MORPH_WEIGHTS });
        }
        Ok(Self { joint_matrices, morph_weights })
    }
}

/// The upper three rows.
fn joint_matrix(matrix: &DMat4) -> JointMatrix {
    JointMatrix { rows: [0, 1, 2].map(|row| matrix.row(row).as_vec4().to_array()) }
}
