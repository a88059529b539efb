//! Smoothies that are wider than the map.

use super::super::case::Case;
use super::super::effort::Effort;
use super::super::family::Family;
use super::super::plates::{CONE, HALF_EXTENT, HEIGHT, LAMP, lamp, plate_over_floor, sky};
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
    // Densely where smoothies become as wide as the map.
    let widths = [(-9, -3, 2), (-1, 2, 1), (3, 37, 2)].map(|(from, to, step)| effort.powers_of_ten(from, to, step));
    let cases = widths.into_iter().flatten().flat_map(|(name, width)| {
        let blocker = LAMP - HEIGHT;
        let radius = width * blocker * (0.5 * CONE).tan();
        let angle = (width * HALF_EXTENT / (LAMP + HEIGHT)).atan();
        [("spot", lamp(radius)), ("parallel", sky(angle))].map(|(light_name, light)| {
            let mut case = plate_over_floor(format!("{name}, {light_name}"), width, HEIGHT, light);
            // An angle of a right one, but for rounding.
            case.refusal_is_due = light_name == "parallel" && width > 1e16;
            if width > MAP_SIDE {
                case.explain("the width asked for is more than the map's side, and held to it");
            }
            case
        })
    });
    cases.collect()
}
