//! Deforming meshes side by side, and the poses of a frame, before they go to the device.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use contrejour_layout::{BLOCK_SIZE, DeformBlock, Influence, JointMatrix, MorphDelta, RestVertex};
use contrejour_mesh::DeformingMesh;
use glam::DMat4;

use super::{AddDeformingError, DeformError, DeformHandle, DeformInput};

/// What is written when meshes come or go.
#[derive(Debug, Default)]
pub(super) struct Tables {
    /// Each mesh once, however many casters share it.
    pub meshes: Vec<Arc<DeformingMesh>>,
    pub blocks: Vec<DeformBlock>,
    /// Where the positions of each caster begin.
    pub first_position_words: Vec<u32>,
    /// Numbers of records in the pools.
    pub sizes: Sizes,
}

/// Numbers of records in the pools.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Sizes {
    pub vertices: u64,
    pub influences: u64,
    pub morph_deltas: u64,
    pub joints: u64,
    pub morph_weights: u64,
    pub position_words: u64,
}

impl Tables {
    /// The casters in the order of their handles. Where something does not fit, [`check_sizes`](Self::check_sizes) tells;
    /// places beyond 32 bits mean nothing.
    pub fn new<'a>(casters: impl Iterator<Item = &'a Arc<DeformingMesh>>) -> Self {
        let mut tables = Self::default();
        let mut known = HashMap::new();
        for mesh in casters {
            let first = *known.entry(Arc::as_ptr(mesh)).or_insert_with(|| tables.place(mesh));
            tables.place_caster(mesh, first);
        }
        tables
    }

    /// Puts a mesh behind the others; returns where it begins.
    fn place(&mut self, mesh: &Arc<DeformingMesh>) -> Sizes {
        let first = self.sizes;
        self.sizes.vertices += mesh.vertices().len() as u64;
        self.sizes.influences += mesh.influences().len() as u64;
        self.sizes.morph_deltas += mesh.morph_deltas().len() as u64;
        self.meshes.push(Arc::clone(mesh));
        first
    }

    fn place_caster(&mut self, mesh: &DeformingMesh, mesh_first: Sizes) {
        let first = self.sizes;
        let vertex_count = mesh.vertices().len() as u32;
        self.first_position_words.push(first.position_words as u32);
        for first_vertex in (0..vertex_count).step_by(BLOCK_SIZE as usize) {
            self.blocks.push(DeformBlock {
                first_vertex: mesh_first.vertices as u32 + first_vertex,
                vertex_count: BLOCK_SIZE.min(vertex_count - first_vertex),
                first_influence: mesh_first.influences as u32,
                first_morph_delta: mesh_first.morph_deltas as u32,
                first_joint: first.joints as u32,
                first_morph_weight: first.morph_weights as u32,
                first_position_word: (first.position_words as u32).wrapping_add(3 * first_vertex),
            });
        }
        self.sizes.joints += u64::from(mesh.joint_count());
        self.sizes.morph_weights += u64::from(mesh.morph_count());
        self.sizes.position_words += 3 * u64::from(vertex_count);
    }

    /// Bytes of each pool, and what it holds.
    pub fn pool_bytes(&self) -> [(&'static str, u64); 7] {
        let sizes = &self.sizes;
        [
            ("blocks", (self.blocks.len() * size_of::<DeformBlock>()) as u64),
            ("vertices", sizes.vertices * size_of::<RestVertex>() as u64),
            ("influences", sizes.influences * size_of::<Influence>() as u64),
            ("morph deltas", sizes.morph_deltas * size_of::<MorphDelta>() as u64),
            ("joints", sizes.joints * size_of::<JointMatrix>() as u64),
            ("morph weights", sizes.morph_weights * size_of::<f32>() as u64),
            ("positions", sizes.position_words * 4),
        ]
    }

    /// Bytes of all pools.
    pub fn bytes(&self) -> u64 {
        self.pool_bytes().iter().map(|(_, bytes)| bytes).sum()
    }

    /// Each pool fits a binding, and so 32-bit indices fit all pools.
    pub fn check_sizes(&self, most: u64) -> Result<(), AddDeformingError> {
        // Words are indexed too.
        let most = most.min(4 * u64::from(u32::MAX));
        match self.pool_bytes().into_iter().find(|&(_, bytes)| bytes > most) {
            Some((what, bytes)) => Err(AddDeformingError::TooLarge { what, bytes, most }),
            None => Ok(()),
        }
    }
}

/// What is written each frame.
#[derive(Debug, Default)]
pub(super) struct Poses {
    pub joint_matrices: Vec<JointMatrix>,
    pub morph_weights: Vec<f32>,
}

const JOINT_MATRICES: &str = "joint matrices";
const MORPH_WEIGHTS: &str = "morph weights";

impl Poses {
    /// The poses in the order of the casters.
    pub fn new(
        casters: &BTreeMap<DeformHandle, Arc<DeformingMesh>>,
        inputs: &[DeformInput<'_>],
    ) -> Result<Self, DeformError> {
        if let Some(&DeformInput { caster, .. }) = inputs.iter().find(|input| !casters.contains_key(&input.caster)) {
            return Err(DeformError::UnknownCaster { caster });
        }
        let by_caster: HashMap<_, _> = inputs.iter().map(|input| (input.caster, input)).collect();
        let mut poses = Self::default();
        for (&caster, mesh) in casters {
            let input = by_caster.get(&caster).ok_or(DeformError::MissingPose { caster })?;
            poses.add(input, mesh)?;
        }
        Ok(poses)
    }

    fn add(&mut self, input: &DeformInput<'_>, mesh: &DeformingMesh) -> Result<(), DeformError> {
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
        let (first_joint, first_weight) = (self.joint_matrices.len(), self.morph_weights.len());
        self.joint_matrices.extend(joint_matrices.iter().map(joint_matrix));
        self.morph_weights.extend(morph_weights.iter().map(|&weight| weight as f32));
        let mut numbers = self.joint_matrices[first_joint..].iter().flat_map(|matrix| matrix.rows.as_flattened());
        if !numbers.all(|number| number.is_finite()) {
            return Err(DeformError::NotFinite { caster, what: JOINT_MATRICES });
        }
        if !self.morph_weights[first_weight..].iter().all(|weight| weight.is_finite()) {
            return Err(DeformError::NotFinite { caster, what: MORPH_WEIGHTS });
        }
        Ok(())
    }
}

/// The upper three rows.
fn joint_matrix(matrix: &DMat4) -> JointMatrix {
    JointMatrix { rows: [0, 1, 2].map(|row| matrix.row(row).as_vec4().to_array()) }
}
