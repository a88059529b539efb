//! A body that shadows itself.

use super::super::error::RunError;
use super::super::lab::Lab;
use super::beside_truth::beside_truth;
use super::methods::{BY_LIGHT_SIZE, SHADOW_MAP};
use super::overlapping_smoothies::told;
use super::sight::{Sight, built_in};
use crate::report::{Body, Extent, Figure};

const MAP_SIZE: u32 = 1024;

pub(super) fn make(lab: &Lab) -> Result<Figure, RunError> {
    let scene = if lab.options.effort.extent == Extent::Quick { "knot" } else { "elephant" };
    let sight = Sight::new(lab, scene, built_in(scene)?)?;
    let named = [BY_LIGHT_SIZE, SHADOW_MAP].map(|method| (method.label, method.settings(sight.shadow(), MAP_SIZE)));
    let pictures = beside_truth(lab, "figure-own-shadow", &sight, &named)?;
    let told = named.iter().zip(&pictures.errors).map(|((label, _), (rmse, umbra))| told(label, *rmse, umbra));
    let caption = format!(
        "The scene {scene} at {MAP_SIZE} texels: one body both throws and takes the shadow, at many distances. Only \
         receivers that face all of the light are compared; the others are left blank. {}",
        told.collect::<Vec<_>>().join(" "),
    );
    Ok(Figure { title: "A body that shadows itself".to_owned(), caption, body: Body::Pictures(pictures.grid) })
}
