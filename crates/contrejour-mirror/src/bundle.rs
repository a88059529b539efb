//! What the stages know of the seats of a bundle: the twin of `shared/bundle.wgsl`.

use contrejour_layout::{Caster, CasterLight, ViewBundle};

/// The seats whose bit is set.
pub(crate) fn seats_in(bundle: &ViewBundle, seats: u32) -> impl Iterator<Item = usize> + use<> {
    (0..bundle.shape.seat_count as usize).filter(move |seat| seats >> seat & 1 == 1)
}

/// The face of a test.
pub(crate) fn face_of(bundle: &ViewBundle, test: u32) -> u32 {
    test / bundle.shape.seat_count
}

/// The seat of a test.
pub(crate) fn seat_of(bundle: &ViewBundle, test: u32) -> u32 {
    test % bundle.shape.seat_count
}

/// Where the lit bits of a caster begin, in words.
pub(crate) fn first_lit_word(bundle: &ViewBundle, caster: &Caster) -> usize {
    (caster.first_lit_word * bundle.shape.seat_count) as usize
}

/// The light of a seat as a caster sees it.
pub(crate) fn caster_light_of<'a>(
    bundle: &ViewBundle,
    caster_lights: &'a [CasterLight],
    seat: u32,
    caster: u32,
) -> &'a CasterLight {
    &caster_lights[(seat * bundle.shape.caster_stride + caster) as usize]
}

/// The room in the list of undecided faces.
pub(crate) fn undecided_capacity(bundle: &ViewBundle) -> u32 {
    bundle.views[0].undecided_capacity * bundle.shape.seat_count
}

/// Whether a lit bit is set.
pub(crate) fn is_lit(bundle: &ViewBundle, lit: &[u32], caster: &Caster, test: u32) -> bool {
    lit[first_lit_word(bundle, caster) + test as usize / 32] >> (test % 32) & 1 == 1
}

/// Sets a lit bit.
pub(crate) fn set_lit(bundle: &ViewBundle, lit: &mut [u32], caster: &Caster, test: u32) {
    lit[first_lit_word(bundle, caster) + test as usize / 32] |= 1 << (test % 32);
}
