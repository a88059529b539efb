//! Times of many frames as a median and its spread.

use serde::{Deserialize, Serialize};

/// Time of one frame's work, from the samples of many frames. Low and high are the 10th and the 90th percentile
/// (nearest rank, as the median), so a few disturbed frames widen nothing.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Timing {
    /// Half of the frames took at most this long.
    pub median_ms: f64,
    /// A tenth of the frames took at most this long.
    pub low_ms: f64,
    /// Nine tenths of the frames took at most this long.
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
