//! Numbers and points that are hard for exact arithmetic, from a fuzzer's bytes.

use arbitrary::{Result, Unstructured};

pub(crate) type Point = [f32; 3];

/// The edges of the type, ones that round, and zeros of both signs.
const EXTREMES: [f32; 14] = [
    0.0,
    -0.0,
    f32::from_bits(1),
    -f32::from_bits(1),
    f32::MIN_POSITIVE,
    f32::from_bits(0x7f_ffff),
    f32::MAX,
    f32::MIN,
    f32::MAX / 3.0,
    1.0,
    -1.0,
    1.0 + f32::EPSILON,
    1.0 - f32::EPSILON / 2.0,
    16_777_216.0,
];

/// Any finite number; often a small whole one, which lies in a plane with others, or an extreme one.
pub(crate) fn number(bytes: &mut Unstructured) -> Result<f32> {
    Ok(match bytes.int_in_range(0..=7)? {
        0..=3 => f32::from(bytes.int_in_range(-4_i8..=4)?),
        4 => *bytes.choose(&EXTREMES)?,
        // Around the ends of the ranges in which the facing test's tiers work.
        5 => with_exponent(bytes.arbitrary()?, bytes.int_in_range(100..=170)?),
        _ => finite(f32::from_bits(bytes.arbitrary()?), 0.5),
    })
}

fn with_exponent(bits: u32, exponent: u32) -> f32 {
    f32::from_bits(bits & 0x807f_ffff | exponent << 23)
}

/// A point by its own coordinates, or one that depends on the points before it: the same, with other zeros, on a line
/// or in a plane with them, or a few floats beside.
pub(crate) fn point(bytes: &mut Unstructured, before: &[Point]) -> Result<Point> {
    let mut point = match bytes.int_in_range(0..=7)? {
        0..=3 => [number(bytes)?, number(bytes)?, number(bytes)?],
        4 => one_of(bytes, before)?,
        5 => one_of(bytes, before)?.map(|coordinate| if coordinate == 0.0 { -coordinate } else { coordinate }),
        6 => combined(bytes, before, 1)?,
        _ => combined(bytes, before, 2)?,
    };
    if bytes.ratio(1, 4)? {
        let axis = bytes.choose_index(3)?;
        point[axis] = beside(point[axis], bytes.int_in_range(-3..=3)?);
    }
    Ok(point)
}

fn one_of(bytes: &mut Unstructured, points: &[Point]) -> Result<Point> {
    if points.is_empty() { Ok([0.0; 3]) } else { Ok(*bytes.choose(points)?) }
}

/// A point plus shares of the ways from it to others, rounded once an axis.
fn combined(bytes: &mut Unstructured, points: &[Point], ways: usize) -> Result<Point> {
    let origin = one_of(bytes, points)?;
    let mut sum = origin.map(f64::from);
    for _ in 0..ways {
        let other = one_of(bytes, points)?;
        let share = f64::from(bytes.int_in_range(-8_i8..=8)?) / 4.0;
        for axis in 0..3 {
            sum[axis] += share * (f64::from(other[axis]) - f64::from(origin[axis]));
        }
    }
    Ok(std::array::from_fn(|axis| finite(sum[axis] as f32, origin[axis])))
}

/// The float so many steps away; the same where there is none.
fn beside(float: f32, steps: i32) -> f32 {
    finite(f32::from_bits(float.to_bits().wrapping_add_signed(steps)), float)
}

fn finite(float: f32, otherwise: f32) -> f32 {
    if float.is_finite() { float } else { otherwise }
}
