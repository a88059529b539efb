//! How much a shadow jumps while its light moves slowly.

use serde::{Deserialize, Serialize};

/// Change of visibility between consecutive frames beyond what the truth does: per pixel and step
/// `max(0, |V' - V| - |T' - T|)` with technique V and truth T. Only the excess counts: a shadow that stands still where
/// it should move is wrong, but does not jump.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MotionExcess {
    /// Steps from one frame to the next. Range: 1 or more.
    pub steps: u64,
    /// Mean excess over all pixels and steps. Range: 0 to 1.
    pub mean: f64,
    /// The excess that 99 % of all pixels and steps do not exceed (nearest rank). Range: 0 to 1.
    pub percentile_99: f64,
    /// Largest excess. Range: 0 to 1.
    pub largest: f64,
}
