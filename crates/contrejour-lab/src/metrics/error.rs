//! How far a technique's visibility is from the truth.

use serde::{Deserialize, Serialize};

use super::MetricError;
use super::input::check_visibility;
use super::quantile::percentile;

/// Differences of visibility between technique and truth over some pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct ErrorFigures {
    /// How many pixels were compared. Range: 1 or more.
    pub pixels: u64,
    /// Square root of the mean squared difference. Range: 0 to 1.
    pub rmse: f64,
    /// Mean absolute difference. Range: 0 to 1.
    pub mean_absolute: f64,
    /// The absolute difference that 99 % of the pixels do not exceed (nearest rank). Range: 0 to 1.
    pub percentile_99: f64,
}

/// Compares a technique with the truth under a mask; none where the mask is empty.
///
/// # Errors
///
/// A slice of another length, or a value under the mask that is no visibility.
pub fn error_figures(truth: &[f32], technique: &[f32], mask: &[bool]) -> Result<Option<ErrorFigures>, MetricError> {
    check_visibility("the truth", truth, mask)?;
    check_visibility("the technique", technique, mask)?;
    let mut differences: Vec<f64> = truth
        .iter()
        .zip(technique)
        .zip(mask)
        .filter(|&(_, counts)| *counts)
        .map(|((&truth, &technique), _)| (f64::from(technique) - f64::from(truth)).abs())
        .collect();
    let pixels = differences.len() as f64;
    let mean_absolute = differences.iter().sum::<f64>() / pixels;
    let mean_squared = differences.iter().map(|difference| difference * difference).sum::<f64>() / pixels;
    // Last, for it changes the order.
    let percentile_99 = percentile(&mut differences, 99);
    Ok(percentile_99.map(|percentile_99| ErrorFigures {
        pixels: differences.len() as u64,
        rmse: mean_squared.sqrt(),
        mean_absolute,
        percentile_99,
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_of_a_tiny_case() {
        // Differences 0.5, 0.25 and 0.25 count; the pixel outside the mask is worse and holds no number.
        let truth = [0.0, 0.5, 1.0, 1.0];
        let technique = [0.5, 0.25, 0.75, f32::NAN];
        let mask = [true, true, true, false];
        let figures = error_figures(&truth, &technique, &mask).expect("the input is sound").expect("pixels count");
        assert_eq!(
            figures,
            ErrorFigures { pixels: 3, rmse: 0.125_f64.sqrt(), mean_absolute: 1.0 / 3.0, percentile_99: 0.5 }
        );
    }

    #[test]
    fn equal_pictures_have_no_error_and_one_wrong_pixel_shows() {
        let truth: Vec<f32> = (0..1000_u16).map(|i| f32::from(i) / 999.0).collect();
        let mask = vec![true; truth.len()];
        let figures = |technique: &[f32]| {
            error_figures(&truth, technique, &mask).expect("the input is sound").expect("pixels count")
        };
        assert_eq!(figures(&truth).rmse, 0.0);
        let mut planted = truth.clone();
        planted[999] = 0.0;
        assert_eq!(figures(&planted).rmse, 0.001_f64.sqrt());
        // One pixel in a thousand is beyond the 99th percentile, eleven are not.
        assert_eq!(figures(&planted).percentile_99, 0.0);
        planted[989..].fill(0.0);
        assert!(figures(&planted).percentile_99 > 0.98);
    }

    #[test]
    fn nothing_to_compare_is_no_figure() {
        assert_eq!(error_figures(&[0.5], &[0.5], &[false]), Ok(None));
        assert_eq!(error_figures(&[], &[], &[]), Ok(None));
    }

    #[test]
    fn unsound_input_is_refused() {
        assert_eq!(
            error_figures(&[0.5, 0.5], &[0.5], &[true, true]),
            Err(MetricError::Length { what: "the technique", found: 1, expected: 2 })
        );
        for value in [1.1, -0.1, f32::INFINITY] {
            assert_eq!(
                error_figures(&[0.5, 0.5], &[0.5, value], &[true, true]),
                Err(MetricError::NotVisibility { what: "the technique", pixel: 1, value })
            );
        }
        let with_nan = error_figures(&[0.5, f32::NAN], &[0.5, 0.5], &[true, true]);
        assert!(matches!(with_nan, Err(MetricError::NotVisibility { what: "the truth", pixel: 1, .. })));
    }
}
