//! Integers that are wide enough for the determinant of any finite coordinates.

use std::ops::{Add, Mul, Sub};

/// 896 bits.
const LIMBS: usize = 14;

/// A two's complement integer of 896 bits, the lowest limb first. Arithmetic wraps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct WideInteger([u64; LIMBS]);

impl WideInteger {
    pub const ZERO: Self = Self([0; LIMBS]);

    /// `integer << shift`
    pub fn shifted(integer: u32, shift: u32) -> Self {
        let mut limbs = [0; LIMBS];
        let wide = u128::from(integer) << (shift % 64);
        let limb = (shift / 64) as usize;
        limbs[limb] = wide as u64;
        limbs[limb + 1] = (wide >> 64) as u64;
        Self(limbs)
    }

    pub fn is_positive(self) -> bool {
        let is_negative = self.0[LIMBS - 1] >> 63 != 0;
        !is_negative && self != Self::ZERO
    }
}

impl Add for WideInteger {
    type Output = Self;

    fn add(mut self, other: Self) -> Self {
        let mut carry = 0;
        for (x, y) in self.0.iter_mut().zip(other.0) {
            let sum = u128::from(*x) + u128::from(y) + carry;
            *x = sum as u64;
            carry = sum >> 64;
        }
        self
    }
}

impl Sub for WideInteger {
    type Output = Self;

    fn sub(mut self, other: Self) -> Self {
        let mut borrow = false;
        for (x, y) in self.0.iter_mut().zip(other.0) {
            let (without_borrow, first) = x.overflowing_sub(y);
            let (difference, second) = without_borrow.overflowing_sub(u64::from(borrow));
            *x = difference;
            borrow = first || second;
        }
        self
    }
}

impl Mul for WideInteger {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let mut product = [0; LIMBS];
        for (i, x) in self.0.into_iter().enumerate() {
            let mut carry = 0;
            for (limb, y) in product[i..].iter_mut().zip(other.0) {
                let sum = u128::from(x) * u128::from(y) + u128::from(*limb) + carry;
                *limb = sum as u64;
                carry = sum >> 64;
            }
        }
        Self(product)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn small(value: i32) -> WideInteger {
        let magnitude = WideInteger::shifted(value.unsigned_abs(), 0);
        if value < 0 { WideInteger::ZERO - magnitude } else { magnitude }
    }

    #[test]
    fn small_numbers_behave_like_integers() {
        let values = [-70_000, -3, -1, 0, 1, 2, 65_536, 123_456];
        for x in values {
            assert_eq!(small(x).is_positive(), x > 0);
            for y in values {
                assert_eq!(small(x) + small(y), small(x + y));
                assert_eq!(small(x) - small(y), small(x - y));
                assert_eq!(small(x % 1000) * small(y), small(x % 1000 * y));
            }
        }
    }

    #[test]
    fn products_of_shifted_numbers_shift_further() {
        let product = WideInteger::shifted(3, 250) * WideInteger::shifted(5, 253);
        assert_eq!(product, WideInteger::shifted(15, 503));
    }
}
