//! Maps from no texel to more than the device holds.

use super::super::case::Case;
use super::super::effort::Effort;
use super::super::family::Family;
use super::super::plates::{HEIGHT, lamp_and_sky, plate_over_floor};
use crate::report::Scale;

pub(super) const MAP_SIZES: Family = Family {
    name: "map-sizes",
    stresses: "Maps from no texel, which is refused, to this device's largest or 16384, and one texel more than the device \
               allows, which is refused too.",
    parameter: "texels along the map's side",
    scale: Scale::Log,
    cases,
};

/// From no texel to a map whose depth alone is a gigabyte.
const SIZES: [u32; 17] = [0, 1, 2, 3, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, 8192, 16_384];

/// Below this, a texel is so large that its bias swallows the shadow.
const SMALL: u32 = 64;

fn cases(effort: &Effort) -> Vec<Case> {
    let sizes = SIZES.into_iter().filter(|size| *size <= effort.largest_map);
    let sizes: Vec<_> = sizes.chain([effort.largest_map + 1]).collect();
    let cases = effort.some_of(&sizes).into_iter().flat_map(|size| {
        lamp_and_sky().map(|(light_name, light)| {
            let mut case = plate_over_floor(format!("{size}, {light_name}"), f64::from(size), HEIGHT, light);
            case.settings.map_size = size;
            case.refusal_is_due = size == 0 || size > effort.largest_map;
            if (1..SMALL).contains(&size) {
                case.explain_error(
                    0.4,
                    "a texel's depth bias and half a texel of overlap are as large as the shadow and its edge; \
                     smoothies are at least one and a half texels wide",
                );
            }
            case
        })
    });
    cases.collect()
}
