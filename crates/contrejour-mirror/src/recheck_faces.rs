//! Decides by floats on their positions which of the faces are lit that planes leave undecided, as far as a proven bound
//! allows, and lists those that it does not decide.
//!
//! The bound's proof stands in `shaders/compute/recheck_faces.wgsl`; it holds for any rounding, so it holds here. A GPU
//! may round otherwise and list a few other faces; what both decide is equal.

use contrejour_layout::{Caster, CasterLight, FACES_PER_WORD, Face, FaceTest, RecheckWord, SeatCounters, ViewBundle};

use crate::bundle::{caster_light_of, face_of, seat_of, set_lit, undecided_capacity};
use crate::facing::{Bits3, FacingBits, NEAR_SPAN};

/// The bindings of `recheck_faces`.
pub struct RecheckFaces<'a> {
    /// The room in the list of undecided faces.
    pub bundle: &'a ViewBundle,
    /// Words with faces to recheck.
    pub recheck_words: &'a [RecheckWord],
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
    /// Undecided faces: near ones from the front, far ones from the back.
    pub undecided: &'a mut [FaceTest],
    /// How many words there are; counts the undecided faces, for each seat and together.
    pub counters: &'a mut [SeatCounters],
}

impl RecheckFaces<'_> {
    /// Does what the dispatch does.
    pub fn run(mut self) {
        for word in &self.recheck_words[..self.counters[0].recheck_words as usize] {
            for bit in (0..FACES_PER_WORD).filter(|bit| word.tests >> bit & 1 == 1) {
                self.recheck(FaceTest { caster: word.caster, test: word.word * FACES_PER_WORD + bit });
            }
        }
    }

    fn recheck(&mut self, tested: FaceTest) {
        let FaceTest { caster: caster_id, test } = tested;
        let (bundle, seat) = (self.bundle, seat_of(self.bundle, test));
        let caster = &self.casters[caster_id as usize];
        let caster_light = caster_light_of(bundle, self.caster_lights, seat, caster_id);
        let face = self.faces[caster.first_face.wrapping_add(face_of(bundle, test)) as usize];
        let capacity = undecided_capacity(bundle);
        match classify(caster, caster_light, face, self.positions) {
            Verdict::Lit => set_lit(bundle, self.lit, caster, test),
            Verdict::Unlit => {}
            Verdict::UndecidedNear => {
                let place = self.counters[0].undecided_near;
                self.counters[0].undecided_near += 1;
                self.counters[seat as usize].counts.undecided_near += 1;
                if place < capacity {
                    self.undecided[place as usize] = tested;
                }
            }
            Verdict::UndecidedFar => {
                let place = self.counters[0].undecided_far;
                self.counters[0].undecided_far += 1;
                self.counters[seat as usize].counts.undecided_far += 1;
                if place < capacity {
                    self.undecided[(capacity - 1 - place) as usize] = tested;
                }
            }
        }
    }
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Verdict {
    Unlit,
    Lit,
    UndecidedNear,
    UndecidedFar,
}

fn classify(caster: &Caster, caster_light: &CasterLight, face: Face, positions: &[u32]) -> Verdict {
    let names_a_vertex_twice = face.a == face.b || face.b == face.c || face.c == face.a;
    if names_a_vertex_twice {
        return Verdict::Unlit;
    }
    let bits = FacingBits::read(caster, caster_light, face, positions);
    match is_lit_by_floats(&bits) {
        Some(true) => Verdict::Lit,
        Some(false) => Verdict::Unlit,
        None if !may_have_volume(&bits) => Verdict::Unlit,
        None if bits.edge_span().length().max(bits.light_span().length()) <= NEAR_SPAN => Verdict::UndecidedNear,
        None => Verdict::UndecidedFar,
    }
}

/// 2^-19: what rounding can do, relative to the sum of the products' magnitudes.
const ROUNDING: f32 = 1.0 / 524_288.0;

/// 2^-61: what underflow can do, relative to the coordinates' limits.
const UNDERFLOW: f32 = 1.0 / (1_u64 << 61) as f32;

/// Exponent bits of the largest coordinate for which the bound is proven.
const EXPONENTS: std::ops::RangeInclusive<u32> = 108..=166;

/// `None`: the bound does not allow a decision.
fn is_lit_by_floats(bits: &FacingBits) -> Option<bool> {
    let edge_exponent = max_exponent([bits.a, bits.b, bits.c].as_flattened());
    let light_exponent = max_exponent([bits.light, bits.light_origin].as_flattened());
    if !EXPONENTS.contains(&edge_exponent) || !EXPONENTS.contains(&light_exponent) {
        return None;
    }
    let p = float_difference(bits.b, bits.a);
    let q = float_difference(bits.c, bits.a);
    let r = float_difference(bits.light, bits.light_origin);
    let mut determinant = 0.0;
    let mut size = 0.0;
    for (x, y, z) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
        let first = q[y] * r[z];
        let second = q[z] * r[y];
        determinant += p[x] * (first - second);
        size += p[x].abs() * (first.abs() + second.abs());
    }
    let edge_limit = power_above(edge_exponent);
    let bound = ROUNDING * size + UNDERFLOW * edge_limit * edge_limit * power_above(light_exponent);
    (determinant.abs() > bound).then_some(determinant > 0.0)
}

fn float_difference(x: Bits3, y: Bits3) -> [f32; 3] {
    std::array::from_fn(|i| f32::from_bits(x[i]) - f32::from_bits(y[i]))
}

/// The exponent bits of the largest coordinate.
fn max_exponent(coordinates: &[u32]) -> u32 {
    let largest = coordinates.iter().map(|bits| bits & 0x7fff_ffff).max();
    largest.unwrap_or(0) >> 23
}

/// The power of two above all numbers with these exponent bits.
fn power_above(exponent: u32) -> f32 {
    f32::from_bits((exponent + 1) << 23)
}

/// False when each of the determinant's six products has a factor that is exactly zero.
fn may_have_volume(bits: &FacingBits) -> bool {
    let p = differs(bits.b, bits.a);
    let q = differs(bits.c, bits.a);
    let r = differs(bits.light, bits.light_origin);
    [(0, 1, 2), (1, 2, 0), (2, 0, 1)].into_iter().any(|(x, y, z)| p[x] && (q[y] && r[z] || q[z] && r[y]))
}

fn differs(x: Bits3, y: Bits3) -> [bool; 3] {
    let are_zeros = |i: usize| (x[i] | y[i]) << 1 == 0;
    std::array::from_fn(|i| x[i] != y[i] && !are_zeros(i))
}
