//! Exact scaling.

/// The exponent of the power of two at or below a normal positive number; -1023 below the normal ones.
pub(super) fn exponent_of(value: f64) -> i32 {
    const EXPONENT_BIAS: i32 = 1023;
    (value.to_bits() >> (f64::MANTISSA_DIGITS - 1)) as i32 - EXPONENT_BIAS
}

#[cfg(test)]
mod tests {
    use super::exponent_of;

    #[test]
    fn exponents_are_exact() {
        for (value, exponent) in [(1.0, 0), (1.999_999, 0), (2.0, 1), (0.5, -1), (f64::MAX, 1023), (1e-320, -1023)] {
            assert_eq!(exponent_of(value), exponent, "{value}");
        }
    }
}
