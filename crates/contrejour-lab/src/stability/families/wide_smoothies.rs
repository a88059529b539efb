//! Smoothies that are wider than the map.

use contrejour_plan::{Light, LightKind, views};

use super::super::case::Case;
use super::super::effort::Effort;
use super::super::family::Family;
use super::super::plates::{CONE, HALF_EXTENT, HEIGHT, LAMP, PLATE, lamp, plate_over_floor, sky};
use crate::report::Scale;

pub(super) const WIDE_SMOOTHIES: Family = Family {
    name: "wide-smoothies",
    stresses: "The light grows from a point to far beyond the scene, and its smoothies beyond the map.",
    parameter: "width of the plate's smoothie as the light asks for it, NDC",
    scale: Scale::Log,
    cases,
};

/// The map's side, beyond which no smoothie is wider. Unit: NDC.
const MAP_SIDE: f64 = 2.0;

fn cases(effort: &Effort) -> Vec<Case> {
    let cases = effort.powers_of_ten(-9, 37, 2).into_iter().flat_map(|(name, width)| {
        let blocker = LAMP - HEIGHT;
        let radius = width * blocker * (0.5 * CONE).tan();
        let angle = (width * HALF_EXTENT / (LAMP + HEIGHT)).atan();
        [("spot", lamp(radius)), ("parallel", sky(angle))].map(|(light_name, light)| {
            let mut case = plate_over_floor(format!("{name}, {light_name}"), width, HEIGHT, light);
            let reasons = [
                (width > MAP_SIDE, "the width asked for is more than the map's side, and held to it"),
                (
                    half_penumbra_ndc(&light) > plate_ndc(&light),
                    "the light is so large that the plate has no true umbra left; smoothies make the outer penumbra \
                     alone, so theirs stays as large as the hard shadow",
                ),
            ];
            let reasons: Vec<_> = reasons.iter().filter(|(applies, _)| *applies).map(|(_, reason)| *reason).collect();
            case.degrades = reasons.join("; ");
            case
        })
    });
    cases.collect()
}

/// Of the plate on the floor.
fn half_penumbra_ndc(light: &Light) -> f64 {
    views(light).map_or(0.0, |views| {
        let view = &views[0];
        view.light_size * (view.q_of_depth(LAMP) - view.q_of_depth(LAMP - HEIGHT))
    })
}

/// Half the side of the plate's image.
fn plate_ndc(light: &Light) -> f64 {
    match light.kind {
        LightKind::Spot { .. } => PLATE / ((LAMP - HEIGHT) * (0.5 * CONE).tan()),
        LightKind::Directional { .. } => PLATE / HALF_EXTENT,
    }
}
