//! Smoothies that overlap: the least alpha stands for both, where the truth adds up what both blockers hide.

use super::super::error::RunError;
use super::super::lab::Lab;
use super::beside_truth::beside_truth;
use super::methods::{BY_LIGHT_SIZE, THICK};
use super::sight::{Sight, built_in};
use crate::metrics::UmbraArea;
use crate::report::{Body, Figure};

const MAP_SIZE: u32 = 1024;

pub(super) fn make(lab: &Lab) -> Result<Figure, RunError> {
    let sight = Sight::new(lab, "boxes", built_in("boxes")?)?;
    let named = [BY_LIGHT_SIZE, THICK].map(|method| (method.label, method.settings(sight.shadow(), MAP_SIZE)));
    let pictures = beside_truth(lab, "figure-overlap", &sight, &named)?;
    let told = named.iter().zip(&pictures.errors).map(|((label, _), (rmse, umbra))| told(label, *rmse, umbra));
    let caption = format!(
        "Two boxes one above the other at {MAP_SIZE} texels: their smoothies overlap on the floor. Where they do, Chan \
         and Durand (2003) keep the smallest alpha, so that neither box darkens what the other has darkened already, \
         while the truth may hide a part of the light behind each. Blue is too dark, orange too light. {}",
        told.collect::<Vec<_>>().join(" "),
    );
    Ok(Figure { title: "Overlapping smoothies".to_owned(), caption, body: Body::Pictures(pictures.grid) })
}

/// Error and umbra of one kind of smoothies.
pub(super) fn told(label: &str, rmse: f64, umbra: &UmbraArea) -> String {
    let [too_large, too_small] = [umbra.too_large(), umbra.too_small()].map(|share| 100.0 * share);
    format!("With {label}: RMSE {rmse:.3}, {too_large:.1} % of the pixels wrongly umbra, {too_small:.1} % wrongly not.")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_told_follows_the_figures() {
        let umbra = UmbraArea { pixels: 1000, too_large_pixels: 15, too_small_pixels: 4 };
        assert_eq!(
            told("smoothies", 0.125, &umbra),
            "With smoothies: RMSE 0.125, 1.5 % of the pixels wrongly umbra, 0.4 % wrongly not."
        );
        let exchanged = UmbraArea { too_large_pixels: 4, too_small_pixels: 15, ..umbra };
        assert_ne!(told("smoothies", 0.125, &exchanged), told("smoothies", 0.125, &umbra));
    }
}
