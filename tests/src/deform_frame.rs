//! All buffers of the stage `deform_positions` on the CPU.

use bytemuck::cast_slice;
use contrejour_layout::{BLOCK_SIZE, DeformBlock, Influence, JointMatrix, MorphDelta, RestVertex};
use contrejour_mesh::{DeformingMesh, PartPose};
use contrejour_mirror::DeformPositions;
use glam::DMat4;

/// The buffers of the stage `deform_positions`, named as it names them, pooled without the library's own pooling.
#[derive(Clone, Debug, Default)]
#[allow(missing_docs, reason = "the fields are the bindings, and the stage's file says what they hold")]
pub struct DeformFrame {
    pub blocks: Vec<DeformBlock>,
    pub rest_vertices: Vec<RestVertex>,
    pub influences: Vec<Influence>,
    pub morph_deltas: Vec<MorphDelta>,
    pub joint_matrices: Vec<JointMatrix>,
    pub morph_weights: Vec<f32>,
    pub positions: Vec<u32>,
    /// Where the positions of each caster begin, in words.
    pub first_words: Vec<usize>,
}

/// Records that lie between the parts of a pool and mean nothing: a stage that reads them goes wrong.
const GAP: usize = 3;

impl DeformFrame {
    /// One caster for each mesh and pose.
    pub fn new(casters: &[(&DeformingMesh, &PartPose)]) -> Self {
        let mut frame = Self::default();
        for (mesh, pose) in casters {
            frame.add(mesh, pose);
        }
        frame.blocks.reverse();
        frame
    }

    fn add(&mut self, mesh: &DeformingMesh, pose: &PartPose) {
        let far = JointMatrix { rows: [[1e9; 4]; 3] };
        self.influences.extend([Influence { joint: 0, weight: 1e9 }; GAP]);
        self.morph_deltas.extend([MorphDelta { delta: [1e9; 3], morph_id: 0 }; GAP]);
        self.joint_matrices.extend([far; GAP]);
        self.morph_weights.extend([1e9; GAP]);
        self.positions.extend([7; GAP]);
        self.first_words.push(self.positions.len());
        for (vertices, first) in mesh.vertices().chunks(BLOCK_SIZE as usize).zip((0..).step_by(BLOCK_SIZE as usize)) {
            self.blocks.push(DeformBlock {
                first_vertex: self.rest_vertices.len() as u32 + first,
                vertex_count: vertices.len() as u32,
                first_influence: self.influences.len() as u32,
                first_morph_delta: self.morph_deltas.len() as u32,
                first_joint: self.joint_matrices.len() as u32,
                first_morph_weight: self.morph_weights.len() as u32,
                first_position_word: self.positions.len() as u32 + 3 * first,
            });
        }
        self.rest_vertices.extend(mesh.vertices());
        self.influences.extend(mesh.influences());
        self.morph_deltas.extend(mesh.morph_deltas());
        let rows = |matrix: &DMat4| [0, 1, 2].map(|row| matrix.row(row).as_vec4().to_array());
        self.joint_matrices.extend(pose.joint_matrices.iter().map(|matrix| JointMatrix { rows: rows(matrix) }));
        self.morph_weights.extend(pose.morph_weights.iter().map(|&weight| weight as f32));
        self.positions.resize(self.positions.len() + 3 * mesh.vertices().len(), 0);
    }

    /// Names and bytes of the bindings.
    pub fn inputs(&self) -> [(&'static str, &[u8]); 7] {
        [
            ("blocks", cast_slice(&self.blocks)),
            ("rest_vertices", cast_slice(&self.rest_vertices)),
            ("influences", cast_slice(&self.influences)),
            ("morph_deltas", cast_slice(&self.morph_deltas)),
            ("joint_matrices", cast_slice(&self.joint_matrices)),
            ("morph_weights", cast_slice(&self.morph_weights)),
            ("positions", cast_slice(&self.positions)),
        ]
    }

    /// Runs the stage's twin.
    pub fn run_mirror(&mut self) {
        DeformPositions {
            blocks: &self.blocks,
            rest_vertices: &self.rest_vertices,
            influences: &self.influences,
            morph_deltas: &self.morph_deltas,
            joint_matrices: &self.joint_matrices,
            morph_weights: &self.morph_weights,
            positions: &mut self.positions,
        }
        .run();
    }

    /// The positions of a caster with so many vertices in words like [`Self::positions`].
    pub fn positions_of(&self, words: &[u32], caster: usize, count: usize) -> Vec<[f32; 3]> {
        let words = &words[self.first_words[caster]..][..3 * count];
        words.as_chunks::<3>().0.iter().map(|position| position.map(f32::from_bits)).collect()
    }
}
