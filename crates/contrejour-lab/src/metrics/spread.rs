//! Times of many frames as a median and its spread.

use serde::{Deserialize, Serialize};

use super::MetricError;
use super::quantile::percentile;

/// Time of one frame's work, from the samples of many frames. Low and high are the 5th and the 95th percentile
/// (nearest rank, as the median): of up to 19 frames the fastest and the slowest, of more all but the disturbed ones.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// Half of the frames took at most this long.
    pub median_ms: f64,
    /// One frame in twenty took at most this long.
    pub low_ms: f64,
    /// Nineteen frames in twenty took at most this long.
    pub high_ms: f64,
    /// Frames that were measured. Range: 1 or more.
    pub frames: u64,
}

/// A time as a multiple of another one.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Ratio {
    /// Median over median.
    pub median: f64,
    /// Low over the other's high: no less where both stay in their spread.
    pub low: f64,
    /// High over the other's low: no more where both stay in their spread.
    pub high: f64,
}

impl Timing {
    /// From the time of each frame in milliseconds.
    ///
    /// # Errors
    ///
    /// No sample, or one that is negative or no number.
    pub fn from_samples(samples_ms: &[f64]) -> Result<Self, MetricError> {
        let is_time = |sample: f64| sample.is_finite() && sample >= 0.0;
        if let Some(sample) = samples_ms.iter().position(|&sample| !is_time(sample)) {
            return Err(MetricError::NotTime { sample, milliseconds: samples_ms[sample] });
        }
        let mut samples = samples_ms.to_vec();
        let mut percentile = |percent| percentile(&mut samples, percent).ok_or(MetricError::NoSample);
        let [median_ms, low_ms, high_ms] = [percentile(50)?, percentile(5)?, percentile(95)?];
        Ok(Self { median_ms, low_ms, high_ms, frames: samples_ms.len() as u64 })
    }

    /// This time as a multiple of another one; none where the other was too short for the clock.
    pub fn over(&self, other: &Self) -> Option<Ratio> {
        (other.low_ms > 0.0).then(|| Ratio {
            median: self.median_ms / other.median_ms,
            low: self.low_ms / other.high_ms,
            high: self.high_ms / other.low_ms,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_disturbed_frame_of_twenty_widens_nothing() {
        let mut samples: Vec<f64> = (1..=19).rev().map(f64::from).collect();
        samples.insert(7, 1000.0);
        let timing = Timing::from_samples(&samples).expect("the samples are times");
        assert_eq!(timing, Timing { median_ms: 10.0, low_ms: 1.0, high_ms: 19.0, frames: 20 });
        let one = Timing::from_samples(&[2.5]).expect("one sample is enough");
        assert_eq!(one, Timing { median_ms: 2.5, low_ms: 2.5, high_ms: 2.5, frames: 1 });
    }

    #[test]
    fn ratios_hold_every_pair_within_the_spreads() {
        let timing = |median_ms, low_ms, high_ms| Timing { median_ms, low_ms, high_ms, frames: 5 };
        let ratio = timing(6.0, 4.0, 8.0).over(&timing(2.0, 1.0, 4.0));
        assert_eq!(ratio, Some(Ratio { median: 3.0, low: 1.0, high: 8.0 }));
        assert_eq!(timing(6.0, 4.0, 8.0).over(&timing(2.0, 0.0, 4.0)), None);
    }

    #[test]
    fn broken_clocks_are_refused() {
        assert_eq!(Timing::from_samples(&[]), Err(MetricError::NoSample));
        assert_eq!(Timing::from_samples(&[1.0, -1.0]), Err(MetricError::NotTime { sample: 1, milliseconds: -1.0 }));
        assert!(Timing::from_samples(&[f64::NAN]).is_err());
    }
}
