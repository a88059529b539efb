//! Facing in exact arithmetic: `robust` decides for points, big integers for directions.

use num_bigint::{BigInt, Sign};
use robust::Coord3D;

/// Whether a face is lit by the homogeneous light `(L, w)`; `w` is 1 for a point and 0 for a direction. The mesh is
/// mirrored by its instance's matrix when that matrix has a negative determinant.
///
/// # Panics
///
/// When a number is not finite or `w` is neither 0 nor 1.
pub fn lit(a: [f32; 3], b: [f32; 3], c: [f32; 3], light: [f32; 4], mirrored: bool) -> bool {
    let [x, y, z, w] = light;
    assert!(w == 0.0 || w == 1.0, "w is {w}");
    let determinant = if w == 1.0 {
        let coord = |[x, y, z]: [f32; 3]| Coord3D { x, y, z };
        // orient3d is det(a - d, b - d, c - d) = -det(b - a, c - a, d - a).
        -sign(robust::orient3d(coord(a), coord(b), coord(c), coord([x, y, z])))
    } else {
        determinant(a, b, c, [x, y, z].map(integer))
    };
    if mirrored { determinant < 0 } else { determinant > 0 }
}

fn sign(value: f64) -> i32 {
    i32::from(value > 0.0) - i32::from(value < 0.0)
}

/// The sign of `det(b - a, c - a, towards_light)`.
fn determinant(a: [f32; 3], b: [f32; 3], c: [f32; 3], towards_light: [BigInt; 3]) -> i32 {
    let [x, y, z] = cross(&difference(b, a), &difference(c, a));
    let [dx, dy, dz] = towards_light;
    match (x * dx + y * dy + z * dz).sign() {
        Sign::Minus => -1,
        Sign::NoSign => 0,
        Sign::Plus => 1,
    }
}

/// Whether three points lie on one line.
pub(crate) fn is_collinear(a: [f32; 3], b: [f32; 3], c: [f32; 3]) -> bool {
    cross(&difference(b, a), &difference(c, a)).iter().all(|component| component.sign() == Sign::NoSign)
}

fn difference(p: [f32; 3], q: [f32; 3]) -> [BigInt; 3] {
    std::array::from_fn(|axis| integer(p[axis]) - integer(q[axis]))
}

fn cross(p: &[BigInt; 3], q: &[BigInt; 3]) -> [BigInt; 3] {
    [&p[1] * &q[2] - &p[2] * &q[1], &p[2] * &q[0] - &p[0] * &q[2], &p[0] * &q[1] - &p[1] * &q[0]]
}

/// A finite `f32` times 2^149.
fn integer(value: f32) -> BigInt {
    assert!(value.is_finite(), "{value} has no place on a grid");
    // An f32 times 2^149 is an integer below 2^277, which f64 holds exactly.
    let scaled = f64::from(value) * 149_f64.exp2();
    let bits = scaled.abs().to_bits();
    let exponent = (bits >> 52) as i64 - 1075;
    if scaled == 0.0 {
        return BigInt::ZERO;
    }
    let mantissa = BigInt::from(bits & ((1 << 52) - 1) | 1 << 52);
    let magnitude = if exponent < 0 { mantissa >> -exponent } else { mantissa << exponent };
    if scaled < 0.0 { -magnitude } else { magnitude }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const A: [f32; 3] = [0.0, 0.0, 0.0];
    const B: [f32; 3] = [1.0, 0.0, 0.0];
    const C: [f32; 3] = [0.0, 1.0, 0.0];

    #[test]
    fn counter_clockwise_faces_are_lit_from_their_front() {
        for w in [0.0, 1.0] {
            assert!(lit(A, B, C, [0.0, 0.0, 1.0, w], false));
            assert!(!lit(A, B, C, [0.0, 0.0, -1.0, w], false));
            assert!(!lit(A, B, C, [0.0, 0.0, 1.0, w], true));
            assert!(lit(A, B, C, [0.0, 0.0, -1.0, w], true));
        }
    }

    #[test]
    fn exactly_edge_on_is_unlit() {
        for w in [0.0, 1.0] {
            for mirrored in [false, true] {
                assert!(!lit(A, B, C, [1.0, 1.0, 0.0, w], mirrored));
            }
        }
    }

    #[test]
    fn the_smallest_number_counts() {
        let tiny = f32::from_bits(1);
        for w in [0.0, 1.0] {
            assert!(lit(A, B, C, [f32::MAX, f32::MAX, tiny, w], false));
            assert!(!lit(A, B, C, [f32::MAX, f32::MAX, -tiny, w], false));
        }
    }

    fn coordinate() -> impl Strategy<Value = f32> {
        let any_finite = any::<u32>().prop_map(f32::from_bits).prop_filter("finite", |value| value.is_finite());
        prop_oneof![any_finite, -1.0_f32..1.0, (-3..4_i8).prop_map(f32::from), Just(f32::from_bits(1)), Just(f32::MAX)]
    }

    fn point() -> impl Strategy<Value = [f32; 3]> {
        [coordinate(), coordinate(), coordinate()]
    }

    proptest! {
        #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(4000) })]

        #[test]
        fn expansions_and_big_integers_agree_on_points(
            [a, b, c, anywhere] in [point(), point(), point(), point()],
            in_plane in prop::option::weighted(0.8, (-2..3_i8, -2..3_i8)),
        ) {
            let light = in_plane.map_or(anywhere, |(s, t)| [0, 1, 2].map(|axis| {
                let [a, b, c] = [a, b, c].map(|corner| f64::from(corner[axis]));
                let place = (a + f64::from(s) * (b - a) + f64::from(t) * (c - a)) as f32;
                if place.is_finite() { place } else { 0.0 }
            }));
            let [x, y, z] = light;
            let expected = determinant(a, b, c, difference(light, a));
            prop_assert_eq!(lit(a, b, c, [x, y, z, 1.0], false), expected > 0);
            prop_assert_eq!(lit(a, b, c, [x, y, z, 1.0], true), expected < 0);
        }
    }

    #[test]
    fn integers_are_exact() {
        assert_eq!(integer(f32::from_bits(1)), BigInt::from(1));
        assert_eq!(integer(-f32::from_bits(3)), BigInt::from(-3));
        assert_eq!(integer(1.0), BigInt::from(1) << 149);
        assert_eq!(integer(f32::MAX), BigInt::from((1 << 24) - 1) << 253);
        assert_eq!(integer(-0.0), BigInt::ZERO);
    }
}
