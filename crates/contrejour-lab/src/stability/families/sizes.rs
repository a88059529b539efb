//! Sizes of everything, and distances from the origin.

use glam::DVec3;

use super::super::case::Case;
use super::super::effort::Effort;
use super::super::family::Family;
use super::super::lights::both;
use super::super::meshes::{RING_RADIUS, ring};
use crate::report::Scale;

pub(super) const SCALE: Family = Family {
    name: "scale",
    stresses: "Mesh and light together grow from the smallest numbers of the type to its largest ones.",
    parameter: "scale",
    scale: Scale::Log,
    cases: scale,
};

pub(super) const DISTANCE: Family = Family {
    name: "distance",
    stresses: "Mesh and light together move away from the origin, so that ever fewer digits are left for the shape.",
    parameter: "distance from the origin over the size",
    scale: Scale::Log,
    cases: distance,
};

fn scale(effort: &Effort) -> Vec<Case> {
    let scales = effort.powers_of_ten(-45, 38, 3);
    let cases = scales.into_iter().flat_map(|(name, scale)| {
        let [spot, parallel] = ring_cases(&name, scale, scale, DVec3::ZERO);
        // Depths and extents below the smallest normal number, and a far plane whose inverse is.
        let is_too_small = scale < 1e-38;
        [
            Case { refusal_is_due: is_too_small || scale > 1e37, ..spot },
            Case { refusal_is_due: is_too_small, ..parallel },
        ]
    });
    cases.collect()
}

/// From where on neighbours of the ring, a tenth of its size apart, are fewer than ten 32-bit numbers apart.
const SHAPELESS: f64 = 1e5;

const NO_SHAPE: &str = "32-bit positions are so far apart at this distance that they hold another shape: what is found is \
                        exact for the positions as they are rounded";

fn distance(effort: &Effort) -> Vec<Case> {
    let none = ring_cases("0", 0.0, 1.0, DVec3::ZERO);
    let distances = effort.powers_of_ten(-2, 7, 1).into_iter().flat_map(|(name, distance)| {
        // Along no axis, so that all coordinates lose their digits.
        let offset = 2.0 * RING_RADIUS * distance * DVec3::new(0.6, -0.5, 0.62);
        let mut cases = ring_cases(&name, distance, 1.0, offset);
        if distance >= SHAPELESS {
            cases.iter_mut().for_each(|case| case.explain(NO_SHAPE));
        }
        cases
    });
    none.into_iter().chain(distances).collect()
}

/// Under a spot and under parallel light.
fn ring_cases(parameter: &str, at: f64, scale: f64, offset: DVec3) -> [Case; 2] {
    let mesh = ring(scale, offset);
    let lights = both(offset, scale * RING_RADIUS);
    lights.map(|(light_name, light)| Case::new(format!("{parameter}, {light_name}"), at, mesh.clone(), light))
}
