//! A receiver that its blocker all but touches.

use contrejour_plan::{Light, LightKind, ShadowSettings, View, views};

use super::super::case::Case;
use super::super::effort::Effort;
use super::super::family::Family;
use super::super::plates::{LAMP, lamp_and_sky, plate_over_floor};
use crate::report::Scale;

pub(super) const CONTACT: Family = Family {
    name: "contact",
    stresses: "A plate sinks onto the floor that it shadows: the blocker's depth over the receiver's goes to 1.",
    parameter: "1 - b / r",
    scale: Scale::Log,
    cases,
};

fn cases(effort: &Effort) -> Vec<Case> {
    let touching = [("0".to_owned(), 0.0)];
    let shares = touching.into_iter().chain(effort.powers_of_ten(-9, -1, 1)).chain([("0.5".to_owned(), 0.5)]);
    let cases = shares.flat_map(|(name, share)| {
        lamp_and_sky().map(|(light_name, light)| {
            let mut case = plate_over_floor(format!("{name}, {light_name}"), share, LAMP * share, light);
            if LAMP * share <= bias(&light, &case.settings) {
                case.explain_error(
                    0.3,
                    "the gap is less than the depth bias, within which the map can't tell the blocker from its \
                     receiver: no smoothie and no silhouette is kept, and the shadow begins later",
                );
            }
            case
        })
    });
    cases.collect()
}

/// How far behind a blocker a smoothie's receiver must lie. Unit: metres.
fn bias(light: &Light, settings: &ShadowSettings) -> f64 {
    let per_depth = if matches!(light.kind, LightKind::Spot { .. }) { LAMP } else { 1.0 };
    let texel = |view: &View| per_depth * view.texel_world(settings.map_size);
    views(light).map_or(0.0, |views| texel(&views[0]) * f64::from(settings.bias.smoothie_texels))
}
