//! Sums without rounding: a number as a sum of `f64` terms that do not overlap (Shewchuk 1997).
//!
//! Products of up to three `f32` coordinates, and all that rounding leaves of them, lie far inside the exponent range of
//! `f64`, so nothing here overflows or underflows.

/// Terms by ascending magnitude; no term when the number is zero.
#[derive(Debug, Default)]
pub(super) struct Expansion {
    terms: Vec<f64>,
}

impl Expansion {
    /// `x - y`.
    pub fn difference(x: f64, y: f64) -> Self {
        let mut difference = Self::default();
        difference.add(x);
        difference.add(-y);
        difference
    }

    /// Adds `sign * x * y`, where the sign is 1 or -1.
    pub fn add_product(&mut self, sign: f64, x: &Self, y: &Self) {
        for x in &x.terms {
            for y in &y.terms {
                let product = x * y;
                let rest = x.mul_add(*y, -product);
                self.add(sign * rest);
                self.add(sign * product);
            }
        }
    }

    /// The number, off by less than 2^-50 of itself; zero only when it is zero.
    pub fn value(&self) -> f64 {
        self.terms.iter().sum()
    }

    /// Grow-Expansion (Shewchuk 1997, figure 6), without the zeros.
    fn add(&mut self, x: f64) {
        let mut sum = x;
        let mut kept = 0;
        for index in 0..self.terms.len() {
            let (next, rest) = two_sum(sum, self.terms[index]);
            sum = next;
            if rest != 0.0 {
                self.terms[kept] = rest;
                kept += 1;
            }
        }
        self.terms.truncate(kept);
        if sum != 0.0 {
            self.terms.push(sum);
        }
    }
}

/// The rounded sum and what rounding left (Knuth).
fn two_sum(x: f64, y: f64) -> (f64, f64) {
    let sum = x + y;
    let y_part = sum - x;
    let x_part = sum - y_part;
    (sum, (x - x_part) + (y - y_part))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(values: &[f64]) -> Expansion {
        let mut expansion = Expansion::default();
        values.iter().for_each(|value| expansion.add(*value));
        expansion
    }

    #[test]
    fn what_rounding_would_lose_is_kept() {
        assert_eq!(of(&[1e30, 1.0, -1e30]).value(), 1.0);
        assert_eq!(of(&[1e-40, 1e40, 3.0, -1e40, -3.0]).value(), 1e-40);
        assert_eq!(Expansion::difference(1.0, 2_f64.powi(-140)).terms, [-(2_f64.powi(-140)), 1.0]);
    }

    #[test]
    fn zero_has_no_term() {
        assert!(of(&[]).terms.is_empty());
        assert!(of(&[0.1, 0.2, -0.2, -0.1]).terms.is_empty());
    }

    #[test]
    fn products_cancel_exactly() {
        // (1 + e)^2 - (1 + 2 e) = e^2, far below the last place of 1.
        let e = 2_f64.powi(-30);
        let x = of(&[1.0, e]);
        let mut square = Expansion::default();
        square.add_product(1.0, &x, &x);
        square.add_product(-1.0, &of(&[1.0]), &of(&[1.0, 2.0 * e]));
        assert_eq!(square.value(), e * e);
    }
}
