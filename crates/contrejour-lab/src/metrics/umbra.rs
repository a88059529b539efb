//! How much of the picture is wrongly in the umbra, or wrongly out of it.

use serde::{Deserialize, Serialize};

/// Area where technique and truth disagree about the umbra.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct UmbraArea {
    /// Pixels that were compared. Range: 1 or more.
    pub pixels: u64,
    /// Pixels that the technique darkens fully and the truth does not.
    pub too_large_pixels: u64,
    /// Pixels that the truth darkens fully and the technique does not.
    pub too_small_pixels: u64,
}

impl UmbraArea {
    /// Share of the compared pixels that the technique wrongly darkens fully. Range: 0 to 1.
    pub fn too_large(&self) -> f64 {
        self.too_large_pixels as f64 / self.pixels as f64
    }

    /// Share of the compared pixels that the technique wrongly keeps out of the umbra. Range: 0 to 1.
    pub fn too_small(&self) -> f64 {
        self.too_small_pixels as f64 / self.pixels as f64
    }
}
