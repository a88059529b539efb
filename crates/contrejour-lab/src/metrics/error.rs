//! How far a technique's visibility is from the truth.

use serde::{Deserialize, Serialize};

/// Differences of visibility (0 = dark, 1 = lit) between technique and truth over some pixels.
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
