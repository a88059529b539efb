//! What the remap of alpha is for: without it the shadow is as soft at the contact as far away.

use contrejour_plan::{AlphaRemap, ShadowSettings, SmoothieSettings, Technique};

use super::super::error::RunError;
use super::super::lab::Lab;
use super::beside_truth::beside_truth;
use super::sight::{Sight, built_in};
use crate::report::{Body, Figure};

const MAP_SIZE: u32 = 1024;

pub(super) fn make(lab: &Lab) -> Result<Figure, RunError> {
    let sight = Sight::new(lab, "cylinder", built_in("cylinder")?)?;
    let with = |remap| ShadowSettings {
        technique: Technique::Smoothies(SmoothieSettings { remap, ..SmoothieSettings::DEFAULT }),
        map_size: MAP_SIZE,
        ..*sight.shadow()
    };
    let named = [("remapped", with(AlphaRemap::Contact)), ("not remapped", with(AlphaRemap::Off))];
    let pictures = beside_truth(lab, "figure-remap", &sight, &named)?;
    let caption = format!(
        "Smoothies from the light's size at {MAP_SIZE} texels with alpha remapped by the depths of blocker and \
         receiver, alpha / (1 - b / r) of Chan and Durand (2003), and with alpha as it was drawn. {}",
        told(pictures.errors[0].0, pictures.errors[1].0),
    );
    let body = Body::Pictures(pictures.grid);
    Ok(Figure { title: "Alpha with and without the remap".to_owned(), caption, body })
}

fn told(with: f64, without: f64) -> String {
    let verdict =
        if with < without { "the remap brings smoothies nearer to the truth" } else { "the remap does not pay here" };
    format!("RMSE with the remap {with:.3}, without it {without:.3}: {verdict}.")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_verdict_follows_the_errors() {
        assert!(told(0.1, 0.2).ends_with("0.100, without it 0.200: the remap brings smoothies nearer to the truth."));
        assert!(told(0.2, 0.1).contains("does not pay"));
    }
}
