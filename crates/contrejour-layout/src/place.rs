//! What is written when a caster moves.

use crate::shared_struct::shared_struct;

shared_struct! {
    /// Where one caster stands, for all lights.
    ///
    /// Matrices are 64-bit floats as two words, the low one first: columns of x, y, z. A stage brings each light into the
    /// caster's space with them and rounds once, as the CPU would, so that a light that moves uploads nothing for each
    /// caster and a caster that moves nothing for each light.
    CasterPlace {
        /// Object space from world space, without the translation.
        object_from_world: [[u32; 2]; 9],
        /// The object space's origin in the world.
        origin_world: [[u32; 2]; 3],
        /// World space from the caster's scaled object space: three columns and the translation.
        world_from_scaled: [[u32; 2]; 12],
        /// Middle of the box around the scaled positions.
        box_middle: [f32; 3],
        /// 1 when the matrix mirrors (its determinant is negative), else 0.
        mirrored: u32,
        /// Half the size of the box.
        box_half: [f32; 3],
        /// [`CASTER_NEVER`], [`CASTER_ALWAYS`] or [`CASTER_IN_VIEW`].
        casts: u32,
    }
}

/// The caster casts for no light: there is none in the slot, it has no faces, or its matrix is singular.
pub const CASTER_NEVER: u32 = 0;

/// The caster casts for every view: nobody knows where its positions are.
pub const CASTER_ALWAYS: u32 = 1;

/// The caster casts for the views that may see its box.
pub const CASTER_IN_VIEW: u32 = 2;
