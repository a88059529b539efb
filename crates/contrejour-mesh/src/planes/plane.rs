//! The plane of one face, as exact as `f32` holds it.

use glam::DVec3;

use super::expansion::Expansion;

/// The two axes of each coordinate plane, by the axis across it.
const ACROSS: [(usize, usize); 3] = [(1, 2), (2, 0), (0, 1)];

/// Smallest and largest magnitude of a stored component that is not zero: 2^-60 and 2^60.
const SMALLEST: f64 = 1.0 / LARGEST;
const LARGEST: f64 = (1_u64 << 60) as f64;

/// The plane `(n, d)` of the face `a`, `b`, `c`: `n = (b - a) x (c - a)` and `d = -n . a`, times a power of two that
/// brings the largest component of `n` to 1 or more and below 2.
///
/// Each component is off by at most 2^-23 of itself, and is zero only where the exact one is. `None` where one would
/// not be zero and yet below 2^-60 or above 2^60. A face without area has four zeros.
pub(super) fn stored_plane(a: [f32; 3], b: [f32; 3], c: [f32; 3]) -> Option<[f32; 4]> {
    let [a, b, c] = [a, b, c].map(|corner| corner.map(f64::from));
    let plane = plane(a, b, c);
    let largest = largest_of(&plane[..3]);
    if largest == 0.0 {
        return Some([0.0; 4]);
    }
    let scaled = plane.map(|component| component * power_of_two_for(largest));
    let fits = |component: &f64| *component == 0.0 || (SMALLEST..=LARGEST).contains(&component.abs());
    // Rounding to f32 adds 2^-24 to the 2^-26 that components are off by.
    scaled.iter().all(fits).then(|| scaled.map(|component| component as f32))
}

/// The unit normal of the face `a`, `b`, `c`; zeros where it has no area.
pub(crate) fn unit_normal(corners: [[f32; 3]; 3]) -> DVec3 {
    let [a, b, c] = corners.map(|corner| corner.map(f64::from));
    let [x, y, z, _] = plane(a, b, c);
    let largest = largest_of(&[x, y, z]);
    if largest == 0.0 { DVec3::ZERO } else { (DVec3::new(x, y, z) * power_of_two_for(largest)).normalize() }
}

/// Its components are off by less than 2^-26 of themselves.
fn plane(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> [f64; 4] {
    rounded_plane(a, b, c).unwrap_or_else(|| exact_plane(a, b, c))
}

fn largest_of(components: &[f64]) -> f64 {
    components.iter().fold(0.0, |largest, component| largest.max(component.abs()))
}

/// In plain arithmetic, where that loses so little that each component is off by less than 2^-26 of itself, and gives
/// zero only for zeros.
///
/// With v = 2^-53, a difference is off by v of itself and a product by 3.1 v, so `n` is off by 4.2 v of `sizes`; a product
/// of `n` and a coordinate by 5.3 v of its part of `d_size`, so `d` by 7.4 v of all of it. Where these are 2^24 times
/// larger than a component at most, it is off by 2^-26 of itself.
fn rounded_plane(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> Option<[f64; 4]> {
    const KEPT: f64 = 1.0 / (1 << 24) as f64;
    let p: [f64; 3] = std::array::from_fn(|axis| b[axis] - a[axis]);
    let q: [f64; 3] = std::array::from_fn(|axis| c[axis] - a[axis]);
    let products = ACROSS.map(|(y, z)| (p[y] * q[z], p[z] * q[y]));
    let n = products.map(|(first, second)| first - second);
    let sizes = products.map(|(first, second)| first.abs() + second.abs());
    let d = -(n[0] * a[0] + n[1] * a[1] + n[2] * a[2]);
    let d_size = sizes[0] * a[0].abs() + sizes[1] * a[1].abs() + sizes[2] * a[2].abs();
    let keeps = |value: f64, size: f64| value.abs() >= KEPT * size;
    let is_kept = keeps(n[0], sizes[0]) && keeps(n[1], sizes[1]) && keeps(n[2], sizes[2]) && keeps(d, d_size);
    is_kept.then_some([n[0], n[1], n[2], d])
}

/// Without any rounding but the last.
fn exact_plane(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> [f64; 4] {
    let p: [Expansion; 3] = std::array::from_fn(|axis| Expansion::difference(b[axis], a[axis]));
    let q: [Expansion; 3] = std::array::from_fn(|axis| Expansion::difference(c[axis], a[axis]));
    let n = ACROSS.map(|(y, z)| {
        let mut component = Expansion::default();
        component.add_product(1.0, &p[y], &q[z]);
        component.add_product(-1.0, &p[z], &q[y]);
        component
    });
    let mut d = Expansion::default();
    for (component, coordinate) in n.iter().zip(a) {
        d.add_product(-1.0, component, &Expansion::difference(coordinate, 0.0));
    }
    let [x, y, z] = n.map(|component| component.value());
    [x, y, z, d.value()]
}

/// The power of two that brings a positive normal number to 1 or more and below 2.
fn power_of_two_for(value: f64) -> f64 {
    const BIAS: u64 = 1023;
    const MANTISSA_BITS: u32 = 52;
    f64::from_bits((2 * BIAS - (value.to_bits() >> MANTISSA_BITS)) << MANTISSA_BITS)
}

#[cfg(test)]
mod tests {
    use num_bigint::BigInt;

    use super::*;

    /// A finite `f32` times 2^149.
    fn integer(value: f32) -> BigInt {
        let mantissa = BigInt::from((value.to_bits() & 0x7f_ffff) | if value.is_normal() { 1 << 23 } else { 0 });
        let magnitude = mantissa << ((value.to_bits() >> 23 & 0xff).max(1) - 1);
        if value.is_sign_negative() { -magnitude } else { magnitude }
    }

    fn magnitude(value: &BigInt) -> BigInt {
        BigInt::from(value.magnitude().clone())
    }

    /// Normal times 2^298 and `d` times 2^447.
    fn exact([a, b, c]: [[f32; 3]; 3]) -> ([BigInt; 3], BigInt) {
        let [a, b, c] = [a, b, c].map(|corner| corner.map(integer));
        let minus = |x: &[BigInt; 3]| -> [BigInt; 3] { std::array::from_fn(|axis| &x[axis] - &a[axis]) };
        let (p, q) = (minus(&b), minus(&c));
        let n = ACROSS.map(|(y, z)| &p[y] * &q[z] - &p[z] * &q[y]);
        let d = -(&n[0] * &a[0] + &n[1] * &a[1] + &n[2] * &a[2]);
        (n, d)
    }

    /// Whether the plane is the exact one times a power of two, each component off by 2^-23 of itself at most.
    fn is_right(plane: [f32; 4], corners: [[f32; 3]; 3]) -> bool {
        let (n, d) = exact(corners);
        let largest = n.iter().map(magnitude).max().expect("three components");
        let is_close = |stored: f32, exact: &BigInt, shift: u64| {
            // Both times 2^149, so that the stored one is an integer.
            let (stored, exact) = (integer(stored) << shift, exact << 149_u32);
            let is_zero = |value: &BigInt| *value == BigInt::ZERO;
            is_zero(&stored) == is_zero(&exact) && magnitude(&(&stored - &exact)) << 23_u32 <= magnitude(&exact)
        };
        // Where the largest component is next to a power of two, rounding may choose the next scale.
        (0..2).any(|more| {
            let shift = (largest.bits() + more).saturating_sub(1);
            plane[..3].iter().zip(&n).all(|(stored, exact)| is_close(*stored, exact, shift))
                && is_close(plane[3], &d, shift + 149)
        })
    }

    struct Random(u64);

    impl Random {
        /// SplitMix64 (Steele, Lea and Flood 2014).
        fn word(&mut self) -> u64 {
            self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
            let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
            let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
            z ^ (z >> 31)
        }

        /// With exponents around that of 1, and a short mantissa or a zero now and then.
        fn coordinate(&mut self, exponents: u64) -> f32 {
            let word = self.word();
            let exponent = 127 - exponents / 2 + word % (exponents + 1);
            let cut = (word >> 16) % 24;
            let mantissa = (word >> 24 & 0x7f_ffff) >> cut << cut;
            match (word >> 56) % 6 {
                0 => 0.0,
                _ => f32::from_bits(((word >> 63) << 31 | exponent << 23 | mantissa) as u32),
            }
        }
    }

    #[test]
    fn components_are_right_to_the_last_place() {
        let mut random = Random(1);
        for exponents in [0, 1, 4, 20, 60, 250] {
            let mut stored = 0;
            for round in 0..3000 {
                let mut corners = [(); 3].map(|()| [(); 3].map(|()| random.coordinate(exponents)));
                if round % 3 == 0 {
                    // All but collinear.
                    let [a, b, _] = corners;
                    corners[2] = std::array::from_fn(|axis| (0.5 * (a[axis] + b[axis])).next_up());
                }
                if corners.as_flattened().iter().any(|coordinate| !coordinate.is_finite()) {
                    continue;
                }
                let [a, b, c] = corners;
                let Some(plane) = stored_plane(a, b, c) else { continue };
                stored += 1;
                assert!(is_right(plane, corners), "{corners:?} have not the plane {plane:?}");
            }
            assert!(stored > 300, "{stored} planes fit with exponents over {exponents}");
        }
    }

    #[test]
    fn zero_is_zero_only_where_it_is_exact() {
        let tilted = [[0.1, 0.7, -0.4], [0.3, -0.2, 0.6], [-0.5, 0.4, 0.9]];
        let [a, b, c] = tilted;
        assert!(stored_plane(a, b, c).is_some_and(|plane| plane.iter().all(|component| *component != 0.0)));
        // On one line, and a step beside it.
        let collinear = [[0.1, 0.2, 0.3], [0.2, 0.4, 0.6], [0.4, 0.8, 1.2]];
        assert_eq!(stored_plane(collinear[0], collinear[1], collinear[2]), Some([0.0; 4]));
        let beside = stored_plane(collinear[0], collinear[1], [0.4, 0.8, 1.2_f32.next_up()]);
        assert!(beside.is_some_and(|plane| plane[0] != 0.0 && plane[1] != 0.0 && plane[2] == 0.0));
        // Both products of a component are the same number that is not zero.
        let steep = stored_plane([1.0, 1.0, 0.0], [4.0, 4.0, 0.0], [4.0, 4.0, 7.0]);
        assert_eq!(steep, Some([1.3125, -1.3125, 0.0, 0.0]));
    }

    #[test]
    fn what_does_not_fit_has_no_plane() {
        let flat = |z: f32| stored_plane([0.0, 0.0, 1.0], [1.0, 0.0, 1.0], [0.0, 1.0, 1.0 + z]);
        assert!(flat(f32::EPSILON).is_some());
        let far = |z: f32| stored_plane([0.0, 0.0, z], [1.0, 0.0, z], [0.0, 1.0, z]);
        assert_eq!(far(2_f32.powi(60)), Some([0.0, 0.0, 1.0, -(2_f32.powi(60))]));
        assert_eq!(far(2_f32.powi(61)), None);
        assert_eq!(far(2_f32.powi(-60)), Some([0.0, 0.0, 1.0, -(2_f32.powi(-60))]));
        assert_eq!(far(2_f32.powi(-61)), None);
        let sheer = |z: f32| stored_plane([0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, z]);
        assert!(sheer(2_f32.powi(-60)).is_some() && sheer(2_f32.powi(-61)).is_none());
    }

    #[test]
    fn the_comparer_finds_a_wrong_plane() {
        let corners = [[0.1, 0.7, -0.4], [0.3, -0.2, 0.6], [-0.5, 0.4, 0.9]];
        let [a, b, c] = corners;
        let plane = stored_plane(a, b, c).expect("common numbers fit");
        assert!(is_right(plane, corners));
        for component in 0..4 {
            let mut wrong = plane;
            wrong[component] = f32::from_bits(plane[component].to_bits() + 3);
            assert!(!is_right(wrong, corners));
            wrong[component] = 0.0;
            assert!(!is_right(wrong, corners));
        }
    }
}
