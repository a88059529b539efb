//! A receiver at the light's far plane.

use contrejour_plan::{Light, LightKind};
use glam::DVec3;

use super::super::case::Case;
use super::super::effort::Effort;
use super::super::family::Family;
use super::super::plates::{HEIGHT, LAMP, LAMP_RADIUS, SKY_RADIUS, lamp, plate_over_floor, sky};
use crate::report::Scale;

pub(super) const FAR_PLANE: Family = Family {
    name: "far-plane",
    stresses: "The far plane comes up to the floor that receives the shadow, lies in it, and passes it.",
    parameter: "how far the plane lies behind the floor, over its depth",
    scale: Scale::Log,
    cases,
};

fn cases(effort: &Effort) -> Vec<Case> {
    let behind = effort.powers_of_ten(-9, 0, 1).into_iter();
    let before = effort.powers_of_ten(-8, -1, 1).into_iter().map(|(name, share)| (format!("-{name}"), -share));
    let shares = behind.chain([("0".to_owned(), 0.0)]).chain(before);
    let cases = shares.flat_map(|(name, share)| {
        [("spot", spot(share)), ("parallel", parallel(share))].map(|(light_name, light)| {
            let mut case = plate_over_floor(format!("{name}, {light_name}"), share, HEIGHT, light);
            if share < 0.0 {
                case.explain("the floor lies behind the far plane, where everything is lit by definition");
            }
            case
        })
    });
    cases.collect()
}

fn spot(share: f64) -> Light {
    let mut light = lamp(LAMP_RADIUS);
    if let LightKind::Spot { far, .. } = &mut light.kind {
        *far = LAMP * (1.0 + share);
    }
    light
}

/// From `LAMP` over the floor to the plane.
fn parallel(share: f64) -> Light {
    let mut light = sky(SKY_RADIUS);
    if let LightKind::Directional { center, half_depth, .. } = &mut light.kind {
        *half_depth = 0.5 * LAMP * (1.0 + share);
        *center = DVec3::new(0.0, LAMP - *half_depth, 0.0);
    }
    light
}
