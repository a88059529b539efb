//! What moves the vertices of deforming meshes: morph targets, then skins.

use crate::shared_struct::shared_struct;

shared_struct! {
    /// A vertex of a deforming mesh before anything moves it, and where the lists of what moves it begin.
    RestVertex {
        /// Its position in the space in which the mesh was bound; without a skin in object space.
        position: [f32; 3],
        /// Where its influences begin among those of the mesh.
        first_influence: u32,
        /// Number of its influences; 0 where no joint moves it.
        influence_count: u32,
        /// Where its morph deltas begin among those of the mesh.
        first_morph_delta: u32,
        /// Number of its morph deltas.
        morph_delta_count: u32,
        /// Zero.
        unused_0: u32,
    }
}

shared_struct! {
    /// How much one joint moves one vertex.
    Influence {
        /// Index of the joint in the skin.
        joint: u32,
        /// Its weight; those of a vertex add up to 1 but for rounding.
        weight: f32,
    }
}

shared_struct! {
    /// How far one morph target at weight 1 moves one vertex.
    MorphDelta {
        /// Added to the position, times the target's weight.
        delta: [f32; 3],
        /// Index of the morph target in the mesh.
        morph_id: u32,
    }
}

shared_struct! {
    /// Object space of the deformed mesh from the space in which it was bound, as one joint has it: the upper three rows
    /// of an affine matrix.
    JointMatrix {
        /// Row by row.
        rows: [[f32; 4]; 3],
    }
}

shared_struct! {
    /// Up to [`BLOCK_SIZE`](crate::BLOCK_SIZE) vertices of one deforming caster, and where its parts lie in the pooled
    /// buffers.
    DeformBlock {
        /// Where its vertices begin in the pool of rest vertices.
        first_vertex: u32,
        /// Number of its vertices; a block of none does nothing.
        vertex_count: u32,
        /// Where the influences of its mesh begin in their pool.
        first_influence: u32,
        /// Where the morph deltas of its mesh begin in their pool.
        first_morph_delta: u32,
        /// Where the joint matrices of its caster begin in their pool.
        first_joint: u32,
        /// Where the morph weights of its caster begin in their pool.
        first_morph_weight: u32,
        /// Where the deformed positions of its vertices begin, in words; 3 words each.
        first_position_word: u32,
    }
}
