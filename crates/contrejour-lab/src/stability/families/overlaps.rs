//! Thousands of silhouettes on a texel.

use super::super::case::{Case, CaseMesh};
use super::super::effort::Effort;
use super::super::family::Family;
use super::super::plates::{HEIGHT, PLATE, lamp_and_sky, plate_over_floor, sheet};
use crate::report::{Extent, Scale};

pub(super) const OVERLAPS: Family = Family {
    name: "overlaps",
    stresses: "A stack of plates whose outlines fall on the same texels: the nearest depth and the least alpha of them all \
               must come out.",
    parameter: "silhouettes on a texel",
    scale: Scale::Log,
    cases,
};

/// Height of the whole stack; plates differ by less than a texel.
const THICKNESS: f64 = 0.01;

fn cases(effort: &Effort) -> Vec<Case> {
    // The most take a minute.
    let most = if effort.extent == Extent::Quick { 2 } else { 4 };
    let cases = effort.powers_of_ten(0, most, 1).into_iter().flat_map(|(name, count)| {
        lamp_and_sky().map(|(light_name, light)| {
            let mut case = plate_over_floor(format!("{name}, {light_name}"), count, HEIGHT, light);
            case.meshes[0] = stack(count as u32);
            // Plates are apart, so corners and gaps of each are those of one.
            case.gap_search = None;
            case
        })
    });
    cases.collect()
}

fn stack(count: u32) -> CaseMesh {
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for index in 0..count {
        let share = f64::from(index) / f64::from(count);
        let plate = sheet(PLATE * (1.0 - 1e-3 * share), HEIGHT + THICKNESS * share);
        let first = positions.len() as u32;
        positions.extend(plate.positions);
        triangles.extend(plate.triangles.iter().map(|face| face.map(|vertex| first + vertex)));
    }
    CaseMesh::new(positions, triangles)
}
