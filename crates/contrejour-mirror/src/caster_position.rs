//! Positions of a caster, brought near 1 by its origin and its power of two. Never used for facing. Subnormal numbers need
//! no care here: CPUs keep them.

use contrejour_layout::Caster;
use glam::Vec3;

pub(crate) fn scaled_position(caster: &Caster, positions: &[u32], vertex: u32) -> Vec3 {
    let word = (caster.first_position_word + vertex * caster.position_stride_words) as usize;
    let position = Vec3::new(
        f32::from_bits(positions[word]),
        f32::from_bits(positions[word + 1]),
        f32::from_bits(positions[word + 2]),
    );
    (position - Vec3::from(caster.position_origin)) * caster.position_scale
}
