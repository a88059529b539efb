//! Many faces: below a texel, around one vertex, each edge in the silhouette, more than one binding holds.

use contrejour_oracle::GapSearch;
use glam::{DQuat, DVec3};

use super::super::case::{Case, CaseMesh};
use super::super::effort::Effort;
use super::super::family::Family;
use super::super::lights::{ASIDE, both, spot, sun};
use super::super::meshes::RING_RADIUS;
use crate::report::{Extent, Scale};
use crate::torus;

pub(super) const TEXEL_FACES: Family = Family {
    name: "texel-faces",
    stresses: "A torus whose faces shrink to a texel of the map and below.",
    parameter: "faces",
    scale: Scale::Log,
    cases: texel_faces,
};

pub(super) const EDGE_ON: Family = Family {
    name: "edge-on-grid",
    stresses: "A grid whose faces are wound by turns, seen exactly edge-on, where every edge is in the silhouette, and \
               nearly so.",
    parameter: "angle between light and grid, radians (0 is left out of the plots)",
    scale: Scale::Log,
    cases: edge_on,
};

pub(super) const FAN: Family = Family {
    name: "fan",
    stresses: "A flat cone of ever more faces around one vertex.",
    parameter: "faces",
    scale: Scale::Log,
    cases: fan,
};

pub(super) const TEN_MILLION: Family = Family {
    name: "ten-million",
    stresses: "A torus of more faces than one dimension of a dispatch has groups of, and than one binding of 128 MiB \
               holds; not in quick runs.",
    parameter: "faces",
    scale: Scale::Log,
    cases: ten_million,
};

/// Texels along the side of a map on which faces get small.
const SMALL_MAP: u32 = 128;

fn texel_faces(effort: &Effort) -> Vec<Case> {
    let cases = effort.some_of(&[12, 24, 48, 96, 192]).into_iter().flat_map(|across| {
        let mesh = round_torus(across);
        let faces = mesh.triangles.len();
        both(DVec3::ZERO, RING_RADIUS).map(|(light_name, light)| {
            let mut case = Case::new(format!("{faces}, {light_name}"), faces as f64, mesh.clone(), light);
            case.settings.map_size = SMALL_MAP;
            case
        })
    });
    cases.collect()
}

/// A torus with so many faces around its tube and twice as many along it.
fn round_torus(across: u32) -> CaseMesh {
    let torus = torus(2 * across, across);
    CaseMesh::new(torus.positions, torus.triangles)
}

/// Squares along a side of the grid.
const GRID: u32 = 48;

fn edge_on(effort: &Effort) -> Vec<Case> {
    let exact = [("0".to_owned(), 0.0)];
    let turned = DQuat::from_axis_angle(ASIDE.normalize(), 0.7);
    let angles = exact.into_iter().chain(effort.powers_of_ten(-9, -1, 1));
    let cases = angles.flat_map(|(name, angle)| {
        [("straight", DQuat::IDENTITY), ("turned", turned)].map(|(grid_name, turn)| {
            let light = sun(turn * DVec3::new(1.0, angle, 0.4), DVec3::ZERO, 1.0);
            Case::new(format!("{name}, {grid_name}"), angle, wound_by_turns(turn), light)
        })
    });
    cases.collect()
}

/// A flat grid in which each face has neighbours of the other winding only.
fn wound_by_turns(turn: DQuat) -> CaseMesh {
    let place = |index: u32| 1.2 * f64::from(index) / f64::from(GRID) - 0.6;
    let at = |i: u32, j: u32| i * (GRID + 1) + j;
    let mut positions = Vec::new();
    for i in 0..=GRID {
        for j in 0..=GRID {
            positions.push((turn * DVec3::new(place(i), 0.0, place(j))).as_vec3().to_array());
        }
    }
    let squares = (0..GRID).flat_map(|i| (0..GRID).map(move |j| (i, j)));
    let triangles = squares.flat_map(|(i, j)| {
        let [a, b, c, d] = [at(i, j), at(i, j + 1), at(i + 1, j + 1), at(i + 1, j)];
        [[a, b, c], [a, d, c]]
    });
    CaseMesh::new(positions, triangles.collect())
}

/// Faces of a fan times vertices that are searched for gaps.
const FAN_SEARCHED: usize = 1_000_000;

fn fan(effort: &Effort) -> Vec<Case> {
    let cases = effort.powers_of_ten(1, 5, 1).into_iter().flat_map(|(_, count)| {
        let mesh = cone(count as u32);
        both(DVec3::ZERO, 1.0).map(|(light_name, light)| {
            let mut case = Case::new(format!("{count}, {light_name}"), count, mesh.clone(), light);
            // Each of these vertices is near all faces.
            let max_vertices = (FAN_SEARCHED / count as usize).clamp(10, 300);
            case.gap_search = case.gap_search.map(|search| GapSearch { max_vertices, ..search });
            case
        })
    });
    cases.collect()
}

fn cone(count: u32) -> CaseMesh {
    let rim = (0..count).map(|index| {
        let (sin, cos) = (std::f64::consts::TAU * f64::from(index) / f64::from(count)).sin_cos();
        [0.8 * cos as f32, 0.0, -0.8 * sin as f32]
    });
    let positions = std::iter::once([0.0, 0.4, 0.0]).chain(rim).collect();
    CaseMesh::new(positions, (0..count).map(|index| [0, 1 + index, 1 + (index + 1) % count]).collect())
}

fn ten_million(effort: &Effort) -> Vec<Case> {
    if effort.extent == Extent::Quick {
        return Vec::new();
    }
    let mesh = round_torus(1600);
    let faces = mesh.triangles.len();
    let case = Case::new(format!("{faces}"), faces as f64, mesh, spot(DVec3::ZERO, RING_RADIUS));
    // So many blockers around so many vertices would take longer to search than all other families together.
    vec![Case { gap_search: None, ..case }]
}
