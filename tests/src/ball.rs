//! Numbers with a bound on how far a 32-bit float computation may be off, however a device fuses, reorders or flushes.
//!
//! Running error analysis (Wilkinson 1986), done in 64 bits, where its own rounding does not matter.

use std::ops::{Add, Div, Mul, Neg, Sub};

/// Largest relative error of one operation that rounds correctly in some direction.
const UNIT: f64 = 1.0 / 8_388_608.0;

/// Largest result or input that may be flushed to zero: the smallest normal 32-bit number.
const FLUSH: f64 = f32::MIN_POSITIVE as f64;

/// A number and its error bound.
#[derive(Clone, Copy, Debug)]
pub struct Ball {
    /// The exact value.
    pub value: f64,
    /// A computed value is at most so far from it; infinite or NaN where nothing can be said.
    pub error: f64,
}

impl Ball {
    /// A 32-bit number as it is given.
    pub fn exact(value: f32) -> Self {
        Self { value: value.into(), error: if value.is_subnormal() { FLUSH } else { 0.0 } }
    }

    /// Whether two computed values are as near to each other as the bound asks.
    pub fn allows(self, first: f32, second: f32) -> bool {
        let difference = (f64::from(first) - f64::from(second)).abs();
        // NaN is allowed only where nothing can be said.
        self.error.is_nan() || difference <= 2.0 * self.error
    }

    /// -1, 1, or 0 where the computed sign is left to rounding.
    pub fn sign(self) -> i32 {
        match () {
            () if self.value > self.error => 1,
            () if -self.value > self.error => -1,
            () => 0,
        }
    }

    /// Its size.
    pub fn abs(self) -> Self {
        Self { value: self.value.abs(), ..self }
    }

    /// The larger one.
    pub fn max(self, other: Self) -> Self {
        Self { value: self.value.max(other.value), error: self.error.max(other.error) }
    }

    /// The smaller one.
    pub fn min(self, other: Self) -> Self {
        Self { value: self.value.min(other.value), error: self.error.max(other.error) }
    }

    fn rounded(value: f64, error: f64, size: f64) -> Self {
        Self { value, error: error + UNIT * (size + error) + FLUSH }
    }
}

impl Add for Ball {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        // By the size of what is added, and not of the sum: a fused or reordered sum rounds its parts.
        let size = self.value.abs() + other.value.abs();
        Self::rounded(self.value + other.value, self.error + other.error, size)
    }
}

impl Sub for Ball {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        self + -other
    }
}

impl Neg for Ball {
    type Output = Self;

    fn neg(self) -> Self {
        Self { value: -self.value, ..self }
    }
}

impl Mul for Ball {
    type Output = Self;

    fn mul(self, other: Self) -> Self {
        let value = self.value * other.value;
        let error = self.value.abs() * other.error + other.value.abs() * self.error + self.error * other.error;
        Self::rounded(value, error, value.abs())
    }
}

impl Div for Ball {
    type Output = Self;

    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        let room = other.value.abs() - other.error;
        if room > 0.0 {
            // WGSL's division may be off by two and a half units.
            return Self::rounded(value, (self.error + value.abs() * other.error) / room, 3.0 * value.abs());
        }
        Self { value, error: f64::INFINITY }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::Random;

    #[test]
    fn float_arithmetic_stays_within_the_bounds() {
        let mut random = Random::new(3);
        for _ in 0..10_000 {
            let [a, b, c] = [(); 3].map(|()| random.signed() as f32);
            let ball = (Ball::exact(a) * Ball::exact(b) - Ball::exact(c)) / Ball::exact(b);
            let plain = (a * b - c) / b;
            let fused = a.mul_add(b, -c) / b;
            assert!((f64::from(plain) - ball.value).abs() <= ball.error, "{plain} {ball:?}");
            assert!(ball.allows(plain, fused), "{plain} {fused} {ball:?}");
        }
    }

    #[test]
    fn bounds_are_tight_enough_to_find_a_wrong_digit() {
        let ball = Ball::exact(0.3) * Ball::exact(0.7) - Ball::exact(0.2);
        assert!(!ball.allows(0.3 * 0.7 - 0.2, 0.3 * 0.7 - 0.200_01));
        assert!(!ball.allows(0.01, f32::NAN));
        assert_eq!(ball.sign(), 1);
    }

    #[test]
    fn cancellation_leaves_the_sign_to_rounding() {
        assert_eq!((Ball::exact(0.1) * Ball::exact(10.0) - Ball::exact(1.0)).sign(), 0);
        assert!((Ball::exact(1.0) / Ball { value: 1e-9, error: 1e-8 }).error.is_infinite());
    }
}
