//! Slivers, and neighbours that are nearly or exactly in one plane or on one line.

use glam::DVec3;

use super::super::case::{Case, CaseMesh};
use super::super::effort::Effort;
use super::super::family::Family;
use super::super::lights::{both, sun};
use super::super::meshes::{RING_RADIUS, ring};
use crate::report::Scale;

pub(super) const SLIVERS: Family = Family {
    name: "slivers",
    stresses: "Every face of a torus is split into two of its shape and one sliver along an edge.",
    parameter: "length of the slivers over their height",
    scale: Scale::Log,
    cases: slivers,
};

pub(super) const COPLANAR: Family = Family {
    name: "coplanar",
    stresses: "A sheet whose faces are bent against each other by less and less, down to exactly one plane, also under \
               light that grazes it by the same angle.",
    parameter: "bend between neighbours, radians",
    scale: Scale::Log,
    cases: coplanar,
};

pub(super) const COLLINEAR: Family = Family {
    name: "collinear",
    stresses: "A crease whose two sides have different vertices along it, filled by faces whose corners are nearly and \
               exactly on one line.",
    parameter: "height of the filling faces over their length",
    scale: Scale::Log,
    cases: collinear,
};

fn slivers(effort: &Effort) -> Vec<Case> {
    let aspects = effort.powers_of_ten(0, 8, 1).into_iter();
    let cases = aspects.flat_map(|(name, aspect)| {
        let mesh = with_slivers(&ring(1.0, DVec3::ZERO), aspect);
        both(DVec3::ZERO, RING_RADIUS)
            .map(|(light_name, light)| Case::new(format!("{name}, {light_name}"), aspect, mesh.clone(), light))
    });
    cases.collect()
}

/// ```text
///      c
///     /|\
///    / m \     m above the middle of a-b by its length over the aspect
///   a-----b
/// ```
fn with_slivers(mesh: &CaseMesh, aspect: f64) -> CaseMesh {
    let mut positions = mesh.positions.clone();
    let mut triangles = Vec::new();
    for &[a, b, c] in &mesh.triangles {
        let [pa, pb, pc] = [a, b, c].map(|vertex| DVec3::from(mesh.positions[vertex as usize].map(f64::from)));
        let middle = pa.midpoint(pb);
        let up = (pc - middle).normalize() * (pb - pa).length();
        // At most a third of the way, where splits are even.
        let share = (1.0 / aspect).min(1.0 / 3.0);
        let m = positions.len() as u32;
        positions.push((middle + share * up).as_vec3().to_array());
        triangles.extend([[a, b, m], [b, c, m], [c, a, m]]);
    }
    CaseMesh::new(positions, triangles)
}

/// Faces along a side of the sheet.
const SHEET: u32 = 16;

fn coplanar(effort: &Effort) -> Vec<Case> {
    let flat = [("0".to_owned(), 0.0)];
    let bends = flat.into_iter().chain(effort.powers_of_ten(-9, 0, 1));
    let cases = bends.flat_map(|(name, bend)| {
        let mesh = bent_sheet(bend, effort.seed);
        // A light in the sheet's own plane, but for the bend, sees each of its faces by chance.
        let grazing = sun(DVec3::new(1.0, 0.7 * bend, 0.3), DVec3::ZERO, 1.0);
        let [spot, parallel] = both(DVec3::ZERO, 1.0);
        [spot, parallel, ("grazing", grazing)]
            .map(|(light_name, light)| Case::new(format!("{name}, {light_name}"), bend, mesh.clone(), light))
    });
    cases.collect()
}

/// A sheet of side 1.2 around the origin across y, whose vertices lie off it by chance.
fn bent_sheet(bend: f64, seed: u64) -> CaseMesh {
    let mut random = fastrand::Rng::with_seed(seed);
    let step = 1.2 / f64::from(SHEET);
    let place = |index: u32| step * f64::from(index) - 0.6;
    let at = |i: u32, j: u32| i * (SHEET + 1) + j;
    let mut positions = Vec::new();
    for i in 0..=SHEET {
        for j in 0..=SHEET {
            let height = bend * step * (random.f64() - 0.5);
            positions.push(DVec3::new(place(i), height, place(j)).as_vec3().to_array());
        }
    }
    let squares = (0..SHEET).flat_map(|i| (0..SHEET).map(move |j| (i, j)));
    let triangles = squares.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
        [[a, b, c], [a, c, d]]
    });
    CaseMesh::new(positions, triangles.collect())
}

/// Faces that fill the crease.
const FILLED: u32 = 16;

fn collinear(effort: &Effort) -> Vec<Case> {
    let on_a_line = [("0".to_owned(), 0.0)];
    let heights = on_a_line.into_iter().chain(effort.powers_of_ten(-10, 0, 1));
    let cases = heights.flat_map(|(name, height)| {
        let mesh = creased(height);
        let [spot, parallel] = both(DVec3::ZERO, 1.0);
        // Sees one side of the crease from the front and the other one from behind.
        let across = sun(DVec3::new(0.2, 0.4, 1.0), DVec3::ZERO, 1.0);
        [spot, parallel, ("across", across)]
            .map(|(light_name, light)| Case::new(format!("{name}, {light_name}"), height, mesh.clone(), light))
    });
    cases.collect()
}

/// ```text
///   |  /|\  |  /|      upper side, with every vertex of the crease
///   +--m--+--m--+      crease; m lie above it
///   |   \ |   \ |      lower side, with every second one; a face a-m-b fills each step
/// ```
fn creased(height: f64) -> CaseMesh {
    let step = 1.2 / f64::from(2 * FILLED);
    let along = |index: u32| step * f64::from(index) - 0.6;
    let mut positions = Vec::new();
    for index in 0..=2 * FILLED {
        let z = if index % 2 == 1 { 2.0 * step * height } else { 0.0 };
        positions.push([along(index), 0.0, -z]);
    }
    let first_up = positions.len() as u32;
    positions.extend((0..=2 * FILLED).map(|index| [along(index), -0.4, -0.5]));
    let first_down = positions.len() as u32;
    positions.extend((0..=FILLED).map(|index| [along(2 * index), -0.4, 0.5]));

    let mut triangles = Vec::new();
    for index in 0..2 * FILLED {
        let [a, b, up, up_next] = [index, index + 1, first_up + index, first_up + index + 1];
        triangles.extend([[a, b, up_next], [a, up_next, up]]);
    }
    for index in 0..FILLED {
        let [a, m, b] = [2 * index, 2 * index + 1, 2 * index + 2];
        let [down, down_next] = [first_down + index, first_down + index + 1];
        triangles.extend([[a, b, m], [a, down, down_next], [a, down_next, b]]);
    }
    CaseMesh::new(positions.into_iter().map(|position| position.map(|x| x as f32)).collect(), triangles)
}

#[cfg(test)]
mod tests {
    use contrejour_mesh::{BuildOptions, TopologyAwareMesh};

    use super::*;

    fn report(mesh: &CaseMesh) -> contrejour_mesh::TopologyReport {
        TopologyAwareMesh::build(&mesh.positions, &mesh.triangles, &BuildOptions::default())
            .expect("a good mesh")
            .report
    }

    #[test]
    fn the_meshes_are_joined_as_they_say() {
        let slivers = report(&with_slivers(&ring(1.0, DVec3::ZERO), 1e3));
        assert!(slivers.closed && slivers.oriented && slivers.faces == 3 * 768, "{slivers}");
        for height in [0.0, 1e-5, 1.0] {
            let creased = report(&creased(height));
            assert!(creased.oriented && creased.manifold && creased.components == 1, "{creased}");
        }
        assert!(report(&bent_sheet(0.0, 1)).oriented);
    }
}
