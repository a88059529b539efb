//! Decides by short integers the undecided faces whose coordinates have exponents close together.

use contrejour_layout::{Caster, CasterLight, Face, FaceTest, SeatCounters, ViewBundle};

use crate::bundle::{caster_light_of, face_of, seat_of, set_lit, undecided_capacity};
use crate::facing::{Bits3, FacingBits, grid_shift, is_negative, mantissa};

/// The bindings of `refine_faces`.
pub struct RefineFaces<'a> {
    /// The room in the list of undecided faces.
    pub bundle: &'a ViewBundle,
    /// Undecided faces: near ones from the front.
    pub undecided: &'a [FaceTest],
    /// How many near ones there are.
    pub counters: &'a [SeatCounters],
    /// Where the parts of each caster lie.
    pub casters: &'a [Caster],
    /// The light of each seat as each caster sees it.
    pub caster_lights: &'a [CasterLight],
    /// Pool of faces.
    pub faces: &'a [Face],
    /// Pool of positions, as bits.
    pub positions: &'a [u32],
    /// One bit a face and seat; those of lit faces are set.
    pub lit: &'a mut [u32],
}

impl RefineFaces<'_> {
    /// Does what the dispatch does.
    pub fn run(self) {
        let count = self.counters[0].undecided_near.min(undecided_capacity(self.bundle));
        for &FaceTest { caster: caster_id, test } in &self.undecided[..count as usize] {
            let caster = &self.casters[caster_id as usize];
            let caster_light = caster_light_of(self.bundle, self.caster_lights, seat_of(self.bundle, test), caster_id);
            let face = self.faces[caster.first_face.wrapping_add(face_of(self.bundle, test)) as usize];
            let bits = FacingBits::read(caster, caster_light, face, self.positions);
            if is_determinant_positive(&bits) {
                set_lit(self.bundle, self.lit, caster, test);
            }
        }
    }
}

/// Coordinates have 61 bits and differences 62, so the minors of q and r are below 2^125, and the determinant is below
/// 2^189. It is summed as a high part and a low part of 64 bits.
fn is_determinant_positive(bits: &FacingBits) -> bool {
    let edge_begin = bits.edge_span().begin;
    let light_begin = bits.light_span().begin;
    let p = difference(bits.b, bits.a, edge_begin);
    let q = difference(bits.c, bits.a, edge_begin);
    let r = difference(bits.light, bits.light_origin, light_begin);
    let mut high = 0_i128;
    let mut low = 0_i128;
    for (x, y, z) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        let minor = q[y] * r[z] - q[z] * r[y];
        let minor_low = minor & LOW_MASK;
        let minor_high = minor >> 64;
        let product_low = p[x] * minor_low;
        high += p[x] * minor_high + (product_low >> 64);
        low += product_low & LOW_MASK;
    }
    high += low >> 64;
    low &= LOW_MASK;
    high > 0 || high == 0 && low > 0
}

const LOW_MASK: i128 = (1 << 64) - 1;

/// `x - y` as integers on the grid that begins at this grid bit.
fn difference(x: Bits3, y: Bits3, begin: u32) -> [i128; 3] {
    std::array::from_fn(|i| i128::from(aligned(x[i], begin) - aligned(y[i], begin)))
}

fn aligned(bits: u32, begin: u32) -> i64 {
    let integer = i64::from(mantissa(bits));
    let shift = grid_shift(bits);
    let magnitude = match integer {
        0 => 0,
        // Bits of the mantissa below the grid's begin are zeros.
        _ if shift < begin => integer >> (begin - shift),
        _ => integer << (shift - begin),
    };
    if is_negative(bits) { -magnitude } else { magnitude }
}
