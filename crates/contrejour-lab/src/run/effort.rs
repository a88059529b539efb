//! How much a run measures.

use contrejour_trace::TraceOptions;
use serde::{Deserialize, Serialize};

use crate::report::Extent;

/// How carefully everything is measured.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Effort {
    /// Whether it is the small or the full one.
    pub extent: Extent,
    /// Width and height of the compared pictures, in pixels.
    pub picture_size: [u32; 2],
    /// Light samples of each replicate of the truth at most. Range: a power of two from 16.
    pub truth_samples: u32,
    /// Standard error of visibility at which the truth stops sampling. Range: 0 (never) to 1.
    pub truth_target_error: f64,
    /// Steps of the moving light. Range: 1 and up.
    pub motion_steps: u32,
    /// Light samples of each replicate of the truth while the light moves: all are taken, so that noise does not jump.
    /// Range: a power of two.
    pub motion_samples: u32,
    /// Rounds in which every contestant draws a frame that is not timed.
    pub warm_up_rounds: usize,
    /// Rounds in which every contestant draws a frame that is timed. Range: 1 and up.
    pub timed_rounds: usize,
}

/// Replicates of the truth.
const REPLICATES: u32 = 8;

/// Replicates of the truth while the light moves.
const MOTION_REPLICATES: u32 = 4;

impl Effort {
    /// For a report in a few minutes on two cores.
    pub const QUICK: Self = Self {
        extent: Extent::Quick,
        picture_size: [320, 240],
        truth_samples: 128,
        truth_target_error: 1.0 / 256.0,
        motion_steps: 3,
        motion_samples: 16,
        warm_up_rounds: 2,
        timed_rounds: 19,
    };

    /// For a report that is kept.
    pub const FULL: Self = Self {
        extent: Extent::Full,
        picture_size: [640, 480],
        truth_samples: 1024,
        truth_target_error: 1.0 / 512.0,
        motion_steps: 4,
        motion_samples: 64,
        warm_up_rounds: 4,
        timed_rounds: 31,
    };

    /// That of an extent.
    pub fn of(extent: Extent) -> Self {
        match extent {
            Extent::Quick => Self::QUICK,
            Extent::Full => Self::FULL,
        }
    }

    /// Most light samples a pixel of the truth.
    pub(super) fn truth_samples_max(&self) -> u64 {
        u64::from(REPLICATES) * u64::from(self.truth_samples)
    }

    pub(super) fn truth_options(&self, seed: u64) -> TraceOptions {
        TraceOptions {
            seed,
            replicates: REPLICATES,
            most_samples: self.truth_samples,
            target_error: self.truth_target_error,
            ..TraceOptions::default()
        }
    }

    /// The same points of the light for all steps of its way.
    pub(super) fn motion_options(&self, seed: u64) -> TraceOptions {
        TraceOptions {
            seed,
            replicates: MOTION_REPLICATES,
            first_samples: self.motion_samples,
            most_samples: self.motion_samples,
            target_error: 0.0,
        }
    }

    /// Frames that every contestant of a group draws.
    pub(super) fn frames(&self) -> usize {
        self.warm_up_rounds + self.timed_rounds + 1 + self.motion_steps as usize
    }
}
