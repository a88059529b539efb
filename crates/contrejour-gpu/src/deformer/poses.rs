//! The poses of a frame, before they go to the device.

use std::collections::HashMap;

use contrejour_layout::JointMatrix;
use contrejour_mesh::DeformingMesh;
use glam::DMat4;

use super::pool::Pool;
use super::{DeformError, DeformInput};
use crate::records::Records;

/// What is written each frame, where it lies.
#[derive(Debug)]
pub(super) struct Poses {
    pub joint_matrices: Records<JointMatrix>,
    pub morph_weights: Records<f32>,
}

const JOINT_MATRICES: &str = "joint matrices";
const MORPH_WEIGHTS: &str = "morph weights";

impl Poses {
    /// The poses of all casters.
    pub fn new(pool: &Pool, inputs: &[DeformInput<'_>]) -> Result<Self, DeformError> {
        let casters = &pool.casters;
        if let Some(&DeformInput { caster, .. }) = inputs.iter().find(|input| !casters.contains_key(&input.caster)) {
            return Err(DeformError::UnknownCaster { caster });
        }
        let by_caster: HashMap<_, _> = inputs.iter().map(|input| (input.caster, input)).collect();
        let mut poses = Self {
            joint_matrices: Records::filled_with(JointMatrix::default()),
            morph_weights: Records::filled_with(0.0),
        };
        for (&handle, caster) in casters {
            let input = by_caster.get(&handle).ok_or(DeformError::MissingPose { caster: handle })?;
            let [.., first_joint, first_weight] = caster.starts;
            let (matrices, weights) = checked(input, &caster.mesh)?;
            poses.joint_matrices.put(first_joint as usize, matrices);
            poses.morph_weights.put(first_weight as usize, weights);
        }
        Ok(poses)
    }
}

/// A pose in 32 bits.
fn checked(input: &DeformInput<'_>, mesh: &DeformingMesh) -> Result<(Vec<JointMatrix>, Vec<f32>), DeformError> {
    let DeformInput { caster, joint_matrices, morph_weights } = *input;
    let counts = [
        (JOINT_MATRICES, joint_matrices.len(), mesh.joint_count()),
        (MORPH_WEIGHTS, morph_weights.len(), mesh.morph_count()),
    ];
    for (what, given, needed) in counts {
        if given != needed as usize {
            return Err(DeformError::Count { caster, what, given, needed });
        }
    }
    let matrices: Vec<_> = joint_matrices.iter().map(joint_matrix).collect();
    let weights: Vec<_> = morph_weights.iter().map(|&weight| weight as f32).collect();
    if !matrices.iter().flat_map(|matrix| matrix.rows.as_flattened()).all(|number| number.is_finite()) {
        return Err(DeformError::NotFinite { caster, what: JOINT_MATRICES });
    }
    if !weights.iter().all(|weight| weight.is_finite()) {
        return Err(DeformError::NotFinite { caster, what: MORPH_WEIGHTS });
    }
    Ok((matrices, weights))
}

/// The upper three rows.
fn joint_matrix(matrix: &DMat4) -> JointMatrix {
    JointMatrix { rows: [0, 1, 2].map(|row| matrix.row(row).as_vec4().to_array()) }
}
