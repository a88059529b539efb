//! Decides by full integers the undecided faces that are left: coordinates as far apart as `f32` allows.

use contrejour_layout::{Caster, CasterLight, Face, FaceTest, SeatCounters, ViewBundle};

use crate::bundle::{caster_light_of, face_of, seat_of, set_lit, undecided_capacity};
use crate::facing::{Bits3, FacingBits, grid_shift, is_negative, mantissa};
use crate::wide_integer::WideInteger;

/// The bindings of `resolve_faces`.
pub struct ResolveFaces<'a> {
    /// The room in the list of undecided faces.
    pub bundle: &'a ViewBundle,
    /// Undecided faces: far ones from the back.
    pub undecided: &'a [FaceTest],
    /// How many far ones there are.
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

impl ResolveFaces<'_> {
    /// Does what the dispatch does.
    pub fn run(self) {
        let capacity = undecided_capacity(self.bundle) as usize;
        let count = (self.counters[0].undecided_far as usize).min(capacity);
        for &FaceTest { caster: caster_id, test } in self.undecided[capacity - count..capacity].iter().rev() {
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

/// On the whole grid of 2^-149 the determinant has 837 bits and a sign.
fn is_determinant_positive(bits: &FacingBits) -> bool {
    let p = difference(bits.b, bits.a);
    let q = difference(bits.c, bits.a);
    let r = difference(bits.light, bits.light_origin);
    let mut determinant = WideInteger::ZERO;
    for (x, y, z) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        let minor = q[y] * r[z] - q[z] * r[y];
        determinant = determinant + p[x] * minor;
    }
    determinant.is_positive()
}

fn difference(x: Bits3, y: Bits3) -> [WideInteger; 3] {
    std::array::from_fn(|i| coordinate(x[i]) - coordinate(y[i]))
}

fn coordinate(bits: u32) -> WideInteger {
    let magnitude = WideInteger::shifted(mantissa(bits), grid_shift(bits));
    if is_negative(bits) { WideInteger::ZERO - magnitude } else { magnitude }
}
