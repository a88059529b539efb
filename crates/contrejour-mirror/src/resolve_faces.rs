//! Decides by full integers the undecided faces that are left: coordinates as far apart as `f32` allows.

use contrejour_layout::{Caster, CasterLight, Counters, Face, FaceRef, LightView};

use crate::facing::{Bits3, FacingBits, grid_shift, is_negative, mantissa, set_lit};
use crate::wide_integer::WideInteger;

/// The bindings of `resolve_faces`.
pub struct ResolveFaces<'a> {
    /// The room in the list of undecided faces.
    pub view: &'a LightView,
    /// Undecided faces: far ones from the back.
    pub undecided: &'a [FaceRef],
    /// How many far ones there are.
    pub counters: &'a Counters,
    /// Where the parts of each caster lie.
    pub casters: &'a [Caster],
    /// The light as each caster sees it.
    pub caster_lights: &'a [CasterLight],
    /// Pool of faces.
    pub faces: &'a [Face],
    /// Pool of positions, as bits.
    pub positions: &'a [u32],
    /// One bit a face; those of lit faces are set.
    pub lit: &'a mut [u32],
}

impl ResolveFaces<'_> {
    /// Does what the dispatch does.
    pub fn run(self) {
        let capacity = self.view.undecided_capacity as usize;
        let count = (self.counters.undecided_far as usize).min(capacity);
        for face_ref in self.undecided[capacity - count..capacity].iter().rev() {
            let caster = &self.casters[face_ref.caster as usize];
            let caster_light = &self.caster_lights[face_ref.caster as usize];
            let face = self.faces[caster.first_face.wrapping_add(face_ref.face_id) as usize];
            let bits = FacingBits::read(caster, caster_light, face, self.positions);
            if is_determinant_positive(&bits) {
                set_lit(self.lit, caster, *face_ref);
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
