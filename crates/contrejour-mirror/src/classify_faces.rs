//! Decides by their stored planes which faces are lit, as far as a proven bound allows, and lists the others for
//! `recheck_faces`.
//!
//! The bound's proof stands in `shaders/compute/classify_faces.wgsl`; it holds for any rounding, so it holds here. A GPU
//! may round otherwise and list a few other faces; what both decide is equal.

use contrejour_layout::{
    BLOCK_BY_PLANES, Caster, CasterLight, FACES_PER_WORD, LIT_WORDS_PER_BLOCK, RecheckWord, SeatCounters, TestItem,
    ViewBundle,
};

use crate::bundle::{caster_light_of, first_lit_word, seats_in};

/// The bindings of `classify_faces`.
pub struct ClassifyFaces<'a> {
    /// How many views are tested.
    pub bundle: &'a ViewBundle,
    /// Blocks of faces.
    pub face_tests: &'a [TestItem],
    /// Where the parts of each caster lie.
    pub casters: &'a [Caster],
    /// The light of each seat as each caster sees it.
    pub caster_lights: &'a [CasterLight],
    /// Pool of planes: normal and distance of each face.
    pub planes: &'a [[f32; 4]],
    /// One bit a face and seat; all words of each block are written.
    pub lit: &'a mut [u32],
    /// Words with faces to recheck.
    pub recheck_words: &'a mut [RecheckWord],
    /// How many blocks there are; counts the words, and for each seat the half blocks that they are of.
    pub counters: &'a mut [SeatCounters],
}

impl ClassifyFaces<'_> {
    /// Does what the dispatch does.
    pub fn run(mut self) {
        for item in &self.face_tests[..self.counters[0].face_tests as usize] {
            for half in 0..LIT_WORDS_PER_BLOCK {
                self.classify_half(item, item.block * LIT_WORDS_PER_BLOCK + half);
            }
        }
    }

    fn classify_half(&mut self, item: &TestItem, half: u32) {
        let caster = &self.casters[item.caster as usize];
        let seat_count = self.bundle.shape.seat_count;
        let first_face_id = half * FACES_PER_WORD;
        let face_count = caster.face_count.saturating_sub(first_face_id).min(FACES_PER_WORD);
        let (mut lit, mut undecided) = ([0_u32; FACES_PER_WORD as usize], [0_u32; FACES_PER_WORD as usize]);
        for seat in seats_in(self.bundle, item.seats) {
            let caster_light = caster_light_of(self.bundle, self.caster_lights, seat as u32, item.caster);
            let [lit_faces, undecided_faces] = match scaled_light(caster_light) {
                _ if face_count == 0 => [0, 0],
                Some(light) if item.kind == BLOCK_BY_PLANES => {
                    let first_face = caster.first_face.wrapping_add(first_face_id) as usize;
                    classify_by_planes(&self.planes[first_face..][..face_count as usize], light)
                }
                _ => [0, u32::MAX >> (FACES_PER_WORD - face_count)],
            };
            for face in 0..FACES_PER_WORD as usize {
                lit[face] |= (lit_faces >> face & 1) << seat;
                undecided[face] |= (undecided_faces >> face & 1) << seat;
            }
            self.counters[seat].counts.recheck_words += u32::from(undecided_faces != 0);
        }
        // The bits of a face lie side by side.
        for word in 0..seat_count {
            let faces = FACES_PER_WORD / seat_count;
            let bits = |of_faces: &[u32; 32]| {
                (0..faces).map(|face| of_faces[(word * faces + face) as usize] << (face * seat_count)).sum::<u32>()
            };
            let place = half * seat_count + word;
            self.lit[first_lit_word(self.bundle, caster) + place as usize] = bits(&lit);
            let tests = bits(&undecided);
            if tests != 0 {
                let slot = self.counters[0].recheck_words as usize;
                self.counters[0].recheck_words += 1;
                self.recheck_words[slot] = RecheckWord { caster: item.caster, word: place, tests };
            }
        }
    }
}

/// 2^-20: what rounding can do, relative to the sum of the terms' magnitudes.
const ROUNDING: f32 = 1.0 / 1_048_576.0;

/// Bits of the lit faces and of the undecided ones.
fn classify_by_planes(planes: &[[f32; 4]], light: [f32; 4]) -> [u32; 2] {
    let (mut lit, mut not_unlit) = (0, 0);
    for (plane, bit) in planes.iter().zip(0..) {
        let terms: [f32; 4] = std::array::from_fn(|i| plane[i] * light[i]);
        let determinant = terms[0] + terms[1] + terms[2] + terms[3];
        let bound = ROUNDING * (terms[0].abs() + terms[1].abs() + terms[2].abs() + terms[3].abs());
        lit |= u32::from(determinant > bound) << bit;
        not_unlit |= u32::from(determinant > -bound) << bit;
    }
    [lit, not_unlit & !lit]
}

/// Exponent bits of the largest component of a scaled light.
const LARGEST_EXPONENT: u32 = 186;

/// So far below it the exponent of a component may be that is not zero.
const EXPONENT_RANGE: u32 = 99;

/// The light times a power of two; `None` where its components lie too far apart. A mirrored caster changes the sign.
fn scaled_light(caster_light: &CasterLight) -> Option<[f32; 4]> {
    let light = caster_light.light_object;
    let exponents = light.map(|bits| bits >> 23 & 0xff);
    let largest = exponents.into_iter().fold(0, u32::max);
    let is_zero = |bits: u32| bits << 1 == 0;
    let fits = |i: usize| is_zero(light[i]) || exponents[i] != 0 && largest - exponents[i] <= EXPONENT_RANGE;
    let sign = if caster_light.mirrored == 0 { 1.0 } else { -1.0 };
    let scale = LARGEST_EXPONENT.wrapping_sub(largest) << 23;
    let scaled = |bits: u32| if is_zero(bits) { 0.0 } else { sign * f32::from_bits(bits.wrapping_add(scale)) };
    (0..4).all(fits).then(|| light.map(scaled))
}
