//! How much of the picture is wrongly in the umbra, or wrongly out of it.

use serde::{Deserialize, Serialize};

use super::MetricError;
use super::input::check_visibility;

/// Most visibility that counts as umbra: what leaks through a filter and can't be seen is no fault.
pub const UMBRA_UP_TO: f32 = 0.01;

/// Least visibility that counts as not umbra. Between the two neither is said, so that pixels that only just differ do
/// not count.
pub const NOT_UMBRA_FROM: f32 = 0.05;

/// Area where technique and truth disagree about the umbra.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct UmbraArea {
    /// Pixels that were compared. Range: 1 or more.
    pub pixels: u64,
    /// Pixels that are umbra ([`UMBRA_UP_TO`]) in the technique and surely not ([`NOT_UMBRA_FROM`]) in truth.
    pub too_large_pixels: u64,
    /// Pixels that are umbra in truth and surely not in the technique.
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

/// Compares the umbra of a technique with the true one; none where the mask is empty.
///
/// # Errors
///
/// A slice of another length, or a value under the mask that is no visibility.
pub fn umbra_area(truth: &[f32], technique: &[f32], mask: &[bool]) -> Result<Option<UmbraArea>, MetricError> {
    check_visibility("the truth", truth, mask)?;
    check_visibility("the technique", technique, mask)?;
    let is_lost = |umbra: f32, other: f32| umbra <= UMBRA_UP_TO && other >= NOT_UMBRA_FROM;
    let mut area = UmbraArea { pixels: 0, too_large_pixels: 0, too_small_pixels: 0 };
    for ((&truth, &technique), _) in truth.iter().zip(technique).zip(mask).filter(|&(_, counts)| *counts) {
        area.pixels += 1;
        area.too_large_pixels += u64::from(is_lost(technique, truth));
        area.too_small_pixels += u64::from(is_lost(truth, technique));
    }
    Ok((area.pixels > 0).then_some(area))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_are_told_apart() {
        // Equal, too large twice, too small once, hair's breadth, outside the mask.
        let truth = [0.0, 0.05, 1.0, 0.01, 0.011, 1.0];
        let technique = [0.0, 0.0, 0.01, 0.2, 0.01, 0.0];
        let mask = [true, true, true, true, true, false];
        let area = umbra_area(&truth, &technique, &mask).expect("the input is sound").expect("pixels count");
        assert_eq!(area, UmbraArea { pixels: 5, too_large_pixels: 2, too_small_pixels: 1 });
        assert_eq!((area.too_large(), area.too_small()), (0.4, 0.2));
    }

    #[test]
    fn exchanging_truth_and_technique_exchanges_the_areas() {
        let (truth, technique) = ([0.0, 0.5, 1.0], [0.3, 0.0, 0.0]);
        let area = |truth, technique| {
            let area = umbra_area(truth, technique, &[true; 3]).expect("the input is sound").expect("pixels count");
            (area.too_large_pixels, area.too_small_pixels)
        };
        assert_eq!(area(&truth, &technique), (2, 1));
        assert_eq!(area(&technique, &truth), (1, 2));
        assert_eq!(umbra_area(&truth, &technique, &[false; 3]), Ok(None));
    }
}
