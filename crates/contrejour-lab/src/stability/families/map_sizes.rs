//! Maps from no texel to more than the device holds.

use super::super::case::Case;
use super::super::effort::Effort;
use super::super::family::Family;
use super::super::plates::{HEIGHT, lamp_and_sky, plate_over_floor};
use crate::report::Scale;

pub(super) const MAP_SIZES: Family = Family {
    name: "map-sizes",
    stresses: "Maps from no texel, which is refused, by 8192, which every device holds, to one texel more than this device's \
               largest map, which is refused too.",
    parameter: "texels along the map's side",
    scale: Scale::Log,
    cases,
};

/// The largest that is drawn, which every device holds: more takes gigabytes on some.
const LARGEST: u32 = 8192;

/// Below this, a texel is so large that its bias swallows the shadow.
const SMALL: u32 = 64;

fn cases(effort: &Effort) -> Vec<Case> {
    let refused = effort.largest_map + 1;
    let sizes =
        [0, 1, 2, 3, 4, 8, 16, 32, 64, 128, 256, 512, 1024, 2048, 4096, LARGEST.min(effort.largest_map), refused];
    let cases = effort.some_of(&sizes).into_iter().flat_map(|size| {
        lamp_and_sky().map(|(light_name, light)| {
            let mut case = plate_over_floor(format!("{size}, {light_name}"), f64::from(size), HEIGHT, light);
            case.settings.map_size = size;
            if (1..SMALL).contains(&size) {
                case.explain(
                    "a texel's depth bias and half a texel of overlap are as large as the shadow and its edge; \
                     smoothies are at least one and a half texels wide",
                );
            }
            case
        })
    });
    cases.collect()
}
