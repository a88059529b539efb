//! Meshes whose faces are hard for the facing test, each with the light that they are hard for.

use crate::object_light::ObjectLight;
use crate::random::Random;

/// Separate faces, under one light.
#[derive(Clone, Debug)]
pub struct HostileCaster {
    /// What is hard about it.
    pub kind: Hardness,
    /// Three positions a face.
    pub faces: Vec<[[f32; 3]; 3]>,
    /// The light in the faces' space.
    pub light: ObjectLight,
}

/// What is hard about faces and light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hardness {
    /// Any finite bits.
    AnyBits,
    /// Ordinary numbers: the light lies in, or a rounding beside, the planes of most faces.
    Coplanar,
    /// Small whole numbers, whose determinants are often exactly zero.
    SmallIntegers,
    /// Slivers that the light all but grazes.
    Grazing,
    /// Numbers around the smallest normal one.
    Subnormal,
    /// Faces in the planes of axes, a light along axes.
    AxisAligned,
    /// Faces without area, and faces that touch the light or point at it.
    Degenerate,
    /// The largest and the smallest numbers, ones, and zeros.
    Extreme,
    /// About 2^-18 along x, so that floats are asked, and about 2^-65 across, so that their products underflow.
    Underflow,
    /// Two long sides and a short one, which lie in the light's plane but for rounding. The short side's products with the
    /// light lie around the smallest normal number: devices that flush what is below lose some of them.
    Flush,
    /// Coordinates about 2^-125 and about 2^125 in one face and light.
    FarApart,
    /// Biased exponents in these ranges, ends included.
    Exponents {
        /// Of the light.
        light: [u32; 2],
        /// Of the faces.
        faces: [u32; 2],
    },
}

impl Hardness {
    /// All kinds; the ranges of exponents lie around those where the tiers of the facing test change.
    pub const ALL: [Self; 23] = [
        Self::AnyBits,
        Self::Coplanar,
        Self::SmallIntegers,
        Self::Grazing,
        Self::Subnormal,
        Self::AxisAligned,
        Self::Degenerate,
        Self::Extreme,
        Self::Underflow,
        Self::Flush,
        Self::FarApart,
        Self::Exponents { light: [127, 140], faces: [90, 130] },
        Self::Exponents { light: [1, 254], faces: [0, 254] },
        Self::Exponents { light: [100, 112], faces: [100, 112] },
        Self::Exponents { light: [160, 170], faces: [160, 170] },
        Self::Exponents { light: [80, 90], faces: [80, 90] },
        Self::Exponents { light: [60, 100], faces: [60, 100] },
        // Spans about as long as those of the lights and planes that the first tier takes.
        Self::Exponents { light: [28, 130], faces: [100, 130] },
        Self::Exponents { light: [127, 130], faces: [85, 130] },
        Self::Exponents { light: [0, 24], faces: [0, 24] },
        Self::Exponents { light: [230, 254], faces: [230, 254] },
        Self::Exponents { light: [1, 4], faces: [251, 254] },
        Self::Exponents { light: [251, 254], faces: [1, 4] },
    ];
}

impl HostileCaster {
    /// Random faces around a random light. The same in every run.
    pub fn new(kind: Hardness, is_point: bool, mirrored: bool, face_count: usize) -> Self {
        // A sequence of its own for each kind, whose name is as good as a number.
        let name = format!("{kind:?}{is_point}{mirrored}");
        let mut random = Random::new(name.bytes().fold(0, |hash, byte| 31 * hash % (1 << 40) + u64::from(byte)));
        let light = loop {
            let light = light_of(kind, &mut random);
            if is_point || light != [0.0; 3] {
                break light;
            }
        };
        let faces = (0..face_count).map(|_| face(&mut random, kind, light, is_point)).collect();
        let [x, y, z] = light;
        let light_object = [x, y, z, if is_point { 1.0 } else { 0.0 }];
        Self { kind, faces, light: ObjectLight { light_object, mirrored } }
    }
}

fn light_of(kind: Hardness, random: &mut Random) -> [f32; 3] {
    match kind {
        Hardness::Underflow => underflowing(random),
        Hardness::Flush => [(); 3].map(|()| with_exponent(random, [108, 111])),
        Hardness::AxisAligned => {
            let axis = random.below(3);
            let mut light = [0.0; 3];
            light[axis] = random.signed() as f32;
            if random.below(2) == 0 {
                light[(axis + 1) % 3] = random.signed() as f32;
            }
            light
        }
        Hardness::Exponents { light, .. } => [(); 3].map(|()| with_exponent(random, light)),
        Hardness::Coplanar | Hardness::Grazing | Hardness::Degenerate => [(); 3].map(|()| 4.0 * random.signed() as f32),
        _ => [(); 3].map(|()| coordinate(random, kind)),
    }
}

fn coordinate(random: &mut Random, kind: Hardness) -> f32 {
    match kind {
        Hardness::AnyBits => random.any_finite(),
        Hardness::SmallIntegers => random.below(17) as f32 - 8.0,
        Hardness::Subnormal => f32::from_bits(random.word() & 0x81ff_ffff),
        Hardness::Extreme => extreme(random),
        Hardness::FarApart if random.below(2) == 0 => with_exponent(random, [1, 4]),
        Hardness::FarApart => with_exponent(random, [251, 254]),
        Hardness::Exponents { faces, .. } => with_exponent(random, faces),
        _ => random.signed() as f32,
    }
}

/// A random sign and mantissa; the mantissa is often short.
fn with_exponent(random: &mut Random, [low, high]: [u32; 2]) -> f32 {
    let exponent = low + random.below((high - low + 1) as usize) as u32;
    let cut = random.below(24);
    let mantissa = (random.word() & 0x7f_ffff) >> cut << cut;
    f32::from_bits((random.word() & 1) << 31 | exponent << 23 | mantissa)
}

fn underflowing(random: &mut Random) -> [f32; 3] {
    [[108, 110], [60, 64], [60, 64]].map(|exponents| with_exponent(random, exponents))
}

fn extreme(random: &mut Random) -> f32 {
    let size = match random.below(10) {
        0 | 1 => 0.0,
        2 => f32::from_bits(1),
        3 => f32::MAX,
        4 => 1.0,
        5 => f32::MIN_POSITIVE,
        6 => random.any_finite(),
        7 => 1.0 + f32::EPSILON,
        8 => f32::MAX / 3.0,
        _ => f32::from_bits(random.word() & 0xff),
    };
    if random.below(2) == 0 { size } else { -size }
}

/// In or beside the light's plane in most of many ways.
fn face(random: &mut Random, kind: Hardness, light: [f32; 3], is_point: bool) -> [[f32; 3]; 3] {
    if kind == Hardness::Flush {
        let long = [(); 3].map(|()| with_exponent(random, [125, 128]));
        let [along, towards] = [-108.0_f64, -90.0].map(|exponent| exponent.exp2() * random.signed());
        let short = at([0.0; 3], long.map(f64::from), along, light.map(f64::from), towards);
        return [[0.0; 3], long, short];
    }
    let [mut a, mut b, mut c] = [(); 3].map(|()| match kind {
        Hardness::Underflow => underflowing(random),
        _ => [(); 3].map(|()| coordinate(random, kind)),
    });
    if kind == Hardness::AnyBits {
        return [a, b, c];
    }
    let to_light = if is_point { minus(light, a) } else { light.map(f64::from) };
    let edge = minus(b, a);
    let choice = if kind == Hardness::Degenerate { 8 + random.below(8) } else { random.below(12) };
    match (kind, choice) {
        (Hardness::AxisAligned, 0..=5) => {
            let axis = random.below(3);
            (b[axis], c[axis]) = (a[axis], a[axis]);
            if choice > 3 {
                b[(axis + 1) % 3] = a[(axis + 1) % 3];
            }
        }
        (_, 0) => {}
        (_, 1) => c = at(a, edge, 0.5, to_light, 0.25),
        (_, 2) => {
            let share = random.signed();
            c = at(a, edge, share, to_light, share / 2.0);
        }
        (_, 3) => {
            let [along, towards] = [(); 2].map(|()| random.below(5) as f64 - 2.0);
            c = at(a, edge, along, to_light, towards);
        }
        (_, 4) => {
            let axis = random.below(3);
            (b[axis], c[axis]) = (a[axis], a[axis]);
        }
        // The light is on a vertex.
        (_, 8) if is_point => c = light,
        (_, 9) if is_point => a = light,
        // It is on the line of an edge.
        (_, 8) => c = at(b, to_light, 1.0, edge, 0.0),
        (_, 9 | 10) => c = at(a, to_light, [0.5, -1.0, 2.0][random.below(3)], edge, 0.0),
        // The face has no area.
        (_, 11) => c = at(a, edge, [0.5, 2.0][random.below(2)], edge, 0.0),
        (_, 12) => (b, c) = (at(a, to_light, 3.0, edge, 0.0), at(a, to_light, -1.0, edge, 0.0)),
        (_, 13) => c = b,
        (Hardness::Grazing, _) => {
            let small = (-(random.below(24) as f64)).exp2();
            c = at(a, edge, small * random.signed(), to_light, small * random.signed());
            b = at(a, edge, small, edge, 0.0);
        }
        _ => c = at(a, edge, random.signed(), to_light, random.signed()),
    }
    if random.below(3) == 0 {
        c = c.map(|coordinate| nudged(random, coordinate));
    }
    if random.below(6) == 0 {
        let axis = random.below(3);
        b[axis] = nudged(random, b[axis]);
    }
    [a, b, c]
}

fn minus(p: [f32; 3], q: [f32; 3]) -> [f64; 3] {
    std::array::from_fn(|axis| f64::from(p[axis]) - f64::from(q[axis]))
}

/// `origin + s p + t q`, rounded once an axis; the origin's coordinate where that has no place in 32 bits.
fn at(origin: [f32; 3], p: [f64; 3], s: f64, q: [f64; 3], t: f64) -> [f32; 3] {
    std::array::from_fn(|axis| {
        let place = (f64::from(origin[axis]) + s * p[axis] + t * q[axis]) as f32;
        if place.is_finite() { place } else { origin[axis] }
    })
}

/// One of the three floats on either side, or the same.
fn nudged(random: &mut Random, float: f32) -> f32 {
    let steps = random.below(7) as i32 - 3;
    let nudged = f32::from_bits(float.to_bits().wrapping_add_signed(steps));
    if nudged.is_finite() { nudged } else { float }
}
