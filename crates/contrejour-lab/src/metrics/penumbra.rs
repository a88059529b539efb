//! Where the true penumbra is.

use super::MetricError;
use super::input::{check_length, check_visibility};

/// The receivers in the penumbra, by the truth alone: its visibility is more than 0 and less than 1 by more than its
/// own standard error. No technique has a say, so the mask is the same for all of them.
///
/// # Errors
///
/// A slice of another length, or a value of a receiver that is no visibility.
pub fn penumbra_mask(truth: &[f32], standard_error: &[f32], receivers: &[bool]) -> Result<Vec<bool>, MetricError> {
    check_visibility("the truth", truth, receivers)?;
    check_length("the truth's standard error", standard_error, truth.len())?;
    let is_penumbra = |truth: f32, error: f32| truth > error && truth < 1.0 - error;
    Ok(truth
        .iter()
        .zip(standard_error)
        .zip(receivers)
        .map(|((&truth, &error), &receives)| receives && is_penumbra(truth, error))
        .collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_sure_penumbra_counts() {
        let truth = [0.0, 1.0, 0.5, 0.02, 0.98, 0.02, 0.5];
        let standard_error = [0.0, 0.0, 0.1, 0.01, 0.01, 0.03, 0.1];
        let receivers = [true, true, true, true, true, true, false];
        let mask = penumbra_mask(&truth, &standard_error, &receivers);
        assert_eq!(mask, Ok(vec![false, false, true, true, true, false, false]));
    }

    #[test]
    fn unsound_input_is_refused() {
        let short = penumbra_mask(&[0.5, 0.5], &[0.0], &[true, true]);
        assert_eq!(short, Err(MetricError::Length { what: "the truth's standard error", found: 1, expected: 2 }));
    }
}
