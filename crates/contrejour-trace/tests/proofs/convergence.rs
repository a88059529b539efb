//! The error falls with the points, and the adaptive rounds keep what they promise.

use contrejour_trace::TraceOptions;

use crate::blockers::fixed;
use crate::disk_lights::{RADIUS, cases};

#[test]
fn the_error_falls_with_the_points() {
    for case in cases() {
        let points = [16, 64, 256];
        let errors = points.map(|samples| case.differences(RADIUS, &fixed(samples)).rms_error);
        let exponent = slope(&points.map(|samples| f64::from(samples).ln()), &errors.map(f64::ln));
        println!("{}: rms errors {errors:.5?}, exponent {exponent:.3}", case.name);
        // Independent points give -0.5.
        assert!((-1.0..-0.6).contains(&exponent), "{}: {exponent}", case.name);
    }
}

#[test]
fn rounds_stop_at_the_wanted_error() {
    for case in cases() {
        for target_error in [0.01, 0.003] {
            let options = TraceOptions { target_error, most_samples: 1 << 16, ..Default::default() };
            let differences = case.differences(RADIUS, &options);
            println!("{}, {target_error}: {differences:?}", case.name);
            // To stop when the spread happens to be small makes z and the errors a little wider.
            assert!(differences.z_deviation < 1.6, "{}: {differences:?}", case.name);
            assert!(differences.rms_error < 1.2 * target_error, "{}: {differences:?}", case.name);
            assert!(differences.rms_error > 0.5 * target_error, "{}: too many rays: {differences:?}", case.name);
        }
    }
}

/// Of the line through the points by least squares.
fn slope(x: &[f64], y: &[f64]) -> f64 {
    let mean = |values: &[f64]| values.iter().sum::<f64>() / values.len() as f64;
    let (middle_x, middle_y) = (mean(x), mean(y));
    let products: f64 = x.iter().zip(y).map(|(x, y)| (x - middle_x) * (y - middle_y)).sum();
    products / x.iter().map(|x| (x - middle_x).powi(2)).sum::<f64>()
}
