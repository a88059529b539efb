//! What metrics refuse.

/// Why there is no figure.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MetricError {
    /// Two pictures of different size.
    #[error("{what} has {found} pixels where the truth has {expected}; measure both at the same size")]
    Length {
        /// What is too long or too short.
        what: &'static str,
        /// Its number of pixels.
        found: usize,
        /// Pixels of the truth.
        expected: usize,
    },
    /// A value that no visibility has.
    #[error("{what} is {value} at pixel {pixel}; a visibility is a number from 0 to 1, so what made it is broken")]
    NotVisibility {
        /// Whose value it is.
        what: &'static str,
        /// Index of the pixel.
        pixel: usize,
        /// The value.
        value: f32,
    },
    /// Truth and technique have different numbers of frames, or too few.
    #[error("the truth has {truth} frames and the technique {technique}; motion needs as many of both, at least 2")]
    Frames {
        /// Frames of the truth.
        truth: usize,
        /// Frames of the technique.
        technique: usize,
    },
    /// Nothing was timed.
    #[error("there is no sample of a time; measure at least one frame")]
    NoSample,
    /// A time that is no number or less than nothing.
    #[error("sample {sample} of a time is {milliseconds} ms; a time is 0 or more, so the clock is broken")]
    NotTime {
        /// Index of the sample.
        sample: usize,
        /// Its value.
        milliseconds: f64,
    },
}

/// Rounding may leave a visibility this much outside 0 to 1.
const SLACK: f32 = 1e-3;

/// Checks that a slice has as many pixels as the truth.
pub(super) fn check_length<T>(what: &'static str, slice: &[T], expected: usize) -> Result<(), MetricError> {
    match slice.len() {
        found if found == expected => Ok(()),
        found => Err(MetricError::Length { what, found, expected }),
    }
}

/// Checks a picture's length and its values under the mask.
pub(super) fn check_visibility(what: &'static str, values: &[f32], mask: &[bool]) -> Result<(), MetricError> {
    check_length(what, values, mask.len())?;
    let wrong = (0..).zip(values).zip(mask).find(|&((_, value), counts)| {
        let is_visibility = (-SLACK..=1.0 + SLACK).contains(value);
        *counts && !is_visibility
    });
    wrong.map_or(Ok(()), |((pixel, &value), _)| Err(MetricError::NotVisibility { what, pixel, value }))
}
