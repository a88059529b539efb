//! Moves the vertices of all deforming casters: by morph targets, then by the joints of a skin.

use contrejour_layout::{DeformBlock, Influence, JointMatrix, MorphDelta, RestVertex};

/// The stage `deform_positions`: rest vertices to the positions of a pose.
pub struct DeformPositions<'a> {
    /// Vertices of a caster, and where its parts lie.
    pub blocks: &'a [DeformBlock],
    /// Vertices of all meshes before anything moves them.
    pub rest_vertices: &'a [RestVertex],
    /// Influences of all meshes.
    pub influences: &'a [Influence],
    /// Morph deltas of all meshes.
    pub morph_deltas: &'a [MorphDelta],
    /// Joint matrices of all casters.
    pub joint_matrices: &'a [JointMatrix],
    /// Weights of the morph targets of all casters.
    pub morph_weights: &'a [f32],
    /// Bits of x, y and z of each vertex.
    pub positions: &'a mut [u32],
}

impl DeformPositions<'_> {
    /// Does what the whole dispatch does.
    ///
    /// # Panics
    ///
    /// When a record names a part of a buffer that does not exist.
    pub fn run(self) {
        for block in self.blocks {
            for lane in 0..block.vertex_count {
                let vertex = &self.rest_vertices[(block.first_vertex + lane) as usize];
                let position = self.skinned(block, vertex, self.morphed(block, vertex));
                let word = (block.first_position_word + 3 * lane) as usize;
                self.positions[word..word + 3].copy_from_slice(&position.map(finite_bits));
            }
        }
    }

    fn morphed(&self, block: &DeformBlock, vertex: &RestVertex) -> [f32; 3] {
        let mut position = vertex.position;
        let first = (block.first_morph_delta + vertex.first_morph_delta) as usize;
        for morph in &self.morph_deltas[first..][..vertex.morph_delta_count as usize] {
            let weight = self.morph_weights[(block.first_morph_weight + morph.morph_id) as usize];
            for (coordinate, delta) in position.iter_mut().zip(morph.delta) {
                *coordinate += weight * delta;
            }
        }
        position
    }

    fn skinned(&self, block: &DeformBlock, vertex: &RestVertex, [x, y, z]: [f32; 3]) -> [f32; 3] {
        if vertex.influence_count == 0 {
            return [x, y, z];
        }
        let mut sum = [0.0; 3];
        let first = (block.first_influence + vertex.first_influence) as usize;
        for influence in &self.influences[first..][..vertex.influence_count as usize] {
            let JointMatrix { rows } = self.joint_matrices[(block.first_joint + influence.joint) as usize];
            for (sum, row) in sum.iter_mut().zip(rows) {
                *sum += influence.weight * (row[0] * x + row[1] * y + row[2] * z + row[3]);
            }
        }
        sum
    }
}

/// What overflows stays at the largest number.
fn finite_bits(number: f32) -> u32 {
    if number.is_finite() { number.to_bits() } else { f32::MAX.copysign(number).to_bits() }
}

#[cfg(test)]
mod tests {
    use super::*;

    const IDENTITY: JointMatrix =
        JointMatrix { rows: [[1.0, 0.0, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0]] };

    /// One caster of one vertex at (1, 2, 3), followed by a word of somebody else's.
    fn deformed(vertex: RestVertex, influences: &[Influence], morphs: &[MorphDelta], weights: &[f32]) -> [f32; 3] {
        let moved = JointMatrix { rows: [[0.0, 2.0, 0.0, 1.0], [1.0, 0.0, 0.0, 0.0], [0.0, 0.0, 1.0, -1.0]] };
        let mut positions = [7; 4];
        DeformPositions {
            blocks: &[DeformBlock { vertex_count: 1, ..Default::default() }, DeformBlock::default()],
            rest_vertices: &[RestVertex { position: [1.0, 2.0, 3.0], ..vertex }],
            influences,
            morph_deltas: morphs,
            joint_matrices: &[IDENTITY, moved],
            morph_weights: weights,
            positions: &mut positions,
        }
        .run();
        assert_eq!(positions[3], 7);
        [0, 1, 2].map(|axis| f32::from_bits(positions[axis]))
    }

    #[test]
    fn a_vertex_that_nothing_moves_stays() {
        assert_eq!(deformed(RestVertex::default(), &[], &[], &[]), [1.0, 2.0, 3.0]);
    }

    #[test]
    fn joints_share_a_vertex_by_weight_after_its_morphs() {
        let influences = [Influence { joint: 0, weight: 0.75 }, Influence { joint: 1, weight: 0.25 }];
        let morphs = [MorphDelta { delta: [0.0, 4.0, 0.0], morph_id: 1 }];
        let vertex = RestVertex { influence_count: 2, morph_delta_count: 1, ..Default::default() };
        // The morphed vertex is at (1, 4, 3), the second joint has it at (9, 1, 2).
        assert_eq!(deformed(vertex, &influences, &morphs, &[9.0, 0.5]), [3.0, 3.25, 2.75]);
    }

    #[test]
    fn what_overflows_stays_finite() {
        let morphs = [MorphDelta { delta: [f32::MAX, -f32::MAX, 0.0], morph_id: 0 }];
        let vertex = RestVertex { morph_delta_count: 1, ..Default::default() };
        assert_eq!(deformed(vertex, &[], &morphs, &[2.0]), [f32::MAX, -f32::MAX, 3.0]);
    }
}
