//! How carefully to trace.

use crate::TraceError;

/// How many points of the light each receiver looks at.
///
/// Points come in replicates: independent scrambles of one low-discrepancy sequence. Each round doubles the points of
/// every replicate, until the [standard error](crate::Visibility::standard_error) is small enough or `most_samples` is
/// reached. Take `target_error` 0 for as many points for all.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TraceOptions {
    /// Chooses the scrambles. The same seed gives the same bits, on any number of threads. Default: 0.
    pub seed: u64,
    /// Independent replicates; their spread is the standard error, which has one degree of freedom less. Range: 2 to
    /// 1024. Default: 8.
    pub replicates: u32,
    /// Points in the first round of each replicate. Range: a power of two, at least 1. Default: 16.
    pub first_samples: u32,
    /// Points of each replicate at most. Range: a power of two, from `first_samples` to 65 536, where the sequence
    /// ends. Default: 1024.
    pub most_samples: u32,
    /// Standard error of visibility that is small enough. Range: 0 and up. Default: 1/256, a grey level of a picture
    /// of 8 bits.
    ///
    /// Receivers stop when the spread of few replicates looks small, so the root mean square error of those in a
    /// penumbra is up to 1.1 times this, and one in some hundred is off by four times this. Where that matters, take
    /// more replicates, or as many points for all.
    pub target_error: f64,
}

impl Default for TraceOptions {
    fn default() -> Self {
        Self { seed: 0, replicates: 8, first_samples: 16, most_samples: 1024, target_error: 1.0 / 256.0 }
    }
}

impl TraceOptions {
    /// Points at which the sequence ends.
    const LONGEST: u32 = 1 << 16;

    pub(crate) fn validate(&self) -> Result<(), TraceError> {
        let &Self { replicates, first_samples, most_samples, target_error, .. } = self;
        let bad = |field, value, range| Err(TraceError::Options { field, value, range });
        if !(2..=1024).contains(&replicates) {
            return bad("replicates", replicates.into(), "2 to 1024; one alone has no spread");
        }
        if !first_samples.is_power_of_two() {
            return bad("first_samples", first_samples.into(), "a power of two");
        }
        if !(most_samples.is_power_of_two() && (first_samples..=Self::LONGEST).contains(&most_samples)) {
            return bad("most_samples", most_samples.into(), "a power of two from first_samples to 65536");
        }
        if !(0.0..f64::INFINITY).contains(&target_error) {
            return bad("target_error", target_error, "0 or more");
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_bad_field_has_its_error() {
        let good = TraceOptions::default();
        assert_eq!(good.validate(), Ok(()));
        let bad = [
            ("replicates", TraceOptions { replicates: 1, ..good }),
            ("replicates", TraceOptions { replicates: 1025, ..good }),
            ("first_samples", TraceOptions { first_samples: 0, ..good }),
            ("first_samples", TraceOptions { first_samples: 12, ..good }),
            ("most_samples", TraceOptions { most_samples: 8, ..good }),
            ("most_samples", TraceOptions { most_samples: 1 << 17, ..good }),
            ("target_error", TraceOptions { target_error: f64::NAN, ..good }),
            ("target_error", TraceOptions { target_error: -0.1, ..good }),
        ];
        for (name, options) in bad {
            let error = options.validate();
            assert!(matches!(error, Err(TraceError::Options { field, .. }) if field == name), "{name}: {error:?}");
        }
    }
}
