//! How a figure grows.

/// `y = factor * x^exponent`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PowerLaw {
    /// y where x is 1.
    pub factor: f64,
    /// How fast y grows with x.
    pub exponent: f64,
}

impl PowerLaw {
    /// y at x.
    pub fn at(&self, x: f64) -> f64 {
        self.factor * x.powf(self.exponent)
    }
}

/// The power law that fits best: least squares of the logarithms. None where fewer than two different x, or no
/// logarithm of some value, are given.
pub fn power_law(points: &[[f64; 2]]) -> Option<PowerLaw> {
    let logarithms: Vec<[f64; 2]> = points.iter().map(|point| point.map(f64::ln)).collect();
    if !logarithms.as_flattened().iter().all(|logarithm| logarithm.is_finite()) {
        return None;
    }
    let count = logarithms.len() as f64;
    let mean = [0, 1].map(|axis| logarithms.iter().map(|point| point[axis]).sum::<f64>() / count);
    let deviations = logarithms.iter().map(|[x, y]| [x - mean[0], y - mean[1]]);
    let squares: f64 = deviations.clone().map(|[x, _]| x * x).sum();
    let products: f64 = deviations.map(|[x, y]| x * y).sum();
    let exponent = products / squares;
    (squares > 0.0).then(|| PowerLaw { factor: (mean[1] - exponent * mean[0]).exp(), exponent })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_power_law_is_found_again() {
        let points = [1e3, 1e4, 2e5, 1e6].map(|x: f64| [x, 0.7 * x.powf(0.8)]);
        let law = power_law(&points).expect("there is a law");
        assert!((law.factor - 0.7).abs() < 1e-12 && (law.exponent - 0.8).abs() < 1e-12, "{law:?}");
        assert!((law.at(1e5) - 7000.0).abs() < 1e-8);
        // Another law is told apart.
        let other = power_law(&points.map(|[x, y]| [x, y * x.powf(0.01)])).expect("there is a law");
        assert!((other.exponent - 0.81).abs() < 1e-12);
    }

    #[test]
    fn no_law_without_two_places() {
        assert_eq!(power_law(&[]), None);
        assert_eq!(power_law(&[[2.0, 3.0], [2.0, 4.0]]), None);
        assert_eq!(power_law(&[[0.0, 3.0], [2.0, 4.0]]), None);
    }
}
