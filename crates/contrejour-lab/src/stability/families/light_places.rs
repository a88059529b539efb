//! Lights in places where facing is hard: in planes of faces, inside, very near and very far.

use contrejour_plan::{Light, LightKind};
use glam::{DQuat, DVec3};

use super::super::case::Case;
use super::super::effort::Effort;
use super::super::family::Family;
use super::super::lights::{ASIDE, spot_from, sun};
use super::super::meshes::{RING_RADIUS, box_of, ring};
use crate::report::Scale;

pub(super) const ON_PLANE: Family = Family {
    name: "light-on-plane",
    stresses: "Lights on the plane of a face, on the line of an edge and on a vertex, rounded to 32-bit floats, and \
               their neighbours.",
    parameter: "steps of 32-bit floats from the place (0 is left out of the plots)",
    scale: Scale::Log,
    cases: on_plane,
};

pub(super) const INSIDE: Family = Family {
    name: "light-inside",
    stresses: "A light inside of a closed tube, ever nearer to its wall.",
    parameter: "distance from the wall over the tube's radius",
    scale: Scale::Log,
    cases: inside,
};

pub(super) const LIGHT_DISTANCE: Family = Family {
    name: "light-distance",
    stresses: "A light that stands before the mesh from a millionth of its size to a million million sizes away.",
    parameter: "distance from the mesh over its size",
    scale: Scale::Log,
    cases: light_distance,
};

pub(super) const PARALLEL: Family = Family {
    name: "light-parallel",
    stresses: "Parallel light along the sides of boxes, one along the axes and one that is turned and rounded.",
    parameter: "angle between light and sides, radians (0 is left out of the plots)",
    scale: Scale::Log,
    cases: parallel,
};

/// The near plane cuts what is around a light.
const CUT: &str = "the light stands in or on the mesh, so the near plane cuts faces; a cut is no edge and has no smoothie, \
                   and gaps are not looked for";

fn on_plane(effort: &Effort) -> Vec<Case> {
    let mesh = ring(1.0, DVec3::ZERO);
    let steps = [0, 1, 2, 3, 10, 100, 1_000, 10_000, 100_000];
    let faces = [7, 200, 421];
    let mut cases = Vec::new();
    for steps in effort.some_of(&steps) {
        for face in effort.some_of(&faces) {
            let [a, b, c] =
                mesh.triangles[face].map(|vertex| DVec3::from(mesh.positions[vertex as usize].map(f64::from)));
            let places = [("plane", a + 12.0 * (b - a) + 8.0 * (c - a)), ("edge", a + 16.0 * (b - a)), ("vertex", a)];
            for (place_name, place) in places {
                let position = stepped(place, steps);
                let name = format!("{steps}, {place_name} of {face}");
                let at = f64::from(steps);
                cases.push(if place_name == "vertex" {
                    Case::new(name, at, mesh.clone(), among(position)).without_gap_search(CUT)
                } else {
                    Case::new(name, at, mesh.clone(), spot_from(position, DVec3::ZERO, RING_RADIUS))
                });
            }
        }
    }
    cases
}

/// A point as 32-bit floats, moved by so many of them along each axis.
fn stepped(point: DVec3, steps: u32) -> DVec3 {
    let stepped = |value: f64| {
        let value = value as f32;
        f64::from(f32::from_bits(value.to_bits().wrapping_add(if value == 0.0 { 0 } else { steps })))
    };
    DVec3::from(point.to_array().map(stepped))
}

/// A wide spot in the midst of the mesh.
fn among(position: DVec3) -> Light {
    let kind = LightKind::Spot {
        position,
        target: DVec3::new(0.0, 0.1, -0.05),
        cone_angle: 2.2,
        radius: 0.01,
        near: 1e-3,
        far: 3.0 * RING_RADIUS,
    };
    Light { kind, color: [1.0; 3] }
}

fn inside(effort: &Effort) -> Vec<Case> {
    let mesh = ring(1.0, DVec3::ZERO);
    let cases = effort.powers_of_ten(-9, 0, 1).into_iter().map(|(name, distance)| {
        // The wall of the tube is at 1.4 on the x axis.
        let position = DVec3::new(1.4 - 0.4 * distance, 0.0, 0.0);
        let kind = LightKind::Spot {
            position,
            target: position - DVec3::Z,
            cone_angle: 2.2,
            radius: 0.01,
            near: 0.1 * distance,
            far: 3.0,
        };
        Case::new(name, distance, mesh.clone(), Light { kind, color: [1.0; 3] }).without_gap_search(CUT)
    });
    cases.collect()
}

/// From where on 24 bits of depth leave less than a thousand steps for the mesh.
const DEPTH_FAILS: f64 = 1e4;

fn light_distance(effort: &Effort) -> Vec<Case> {
    let mesh = ring(1.0, DVec3::ZERO);
    let size = 2.0 * RING_RADIUS;
    let cases = effort.powers_of_ten(-6, 12, 1).into_iter().map(|(name, share)| {
        let distance = share * size;
        let position = DVec3::X * (RING_RADIUS + distance);
        let kind = LightKind::Spot {
            position,
            target: position - DVec3::X,
            // Sees the whole mesh, or as much of it as a wide cone can.
            cone_angle: (2.0 * (1.3 * RING_RADIUS).atan2(RING_RADIUS + distance)).min(0.9 * 2.2),
            radius: 0.05 * distance.min(RING_RADIUS),
            near: 0.5 * distance,
            far: 2.0 * distance + 2.0 * size,
        };
        let mut case = Case::new(name, share, mesh.clone(), Light { kind, color: [1.0; 3] });
        if share >= DEPTH_FAILS {
            case.explain(
                "depth from the light has 24 bits: at this distance they tell too few places within the mesh apart to \
                 say what shadows what",
            );
        }
        case
    });
    cases.collect()
}

fn parallel(effort: &Effort) -> Vec<Case> {
    let straight = [("0".to_owned(), 0.0)];
    let angles = straight.into_iter().chain(effort.powers_of_ten(-12, -1, 1));
    let turned = DQuat::from_axis_angle(ASIDE.normalize(), 0.7);
    let boxes = [("straight", DQuat::IDENTITY), ("turned", turned)];
    let cases = angles.flat_map(|(name, angle)| {
        boxes.map(|(box_name, turn)| {
            let towards_light = turn * DVec3::new(1.0, angle, 0.7 * angle);
            let light = sun(towards_light, DVec3::ZERO, 1.0);
            Case::new(format!("{name}, {box_name}"), angle, box_of(8, |position| turn * (0.5 * position)), light)
        })
    });
    cases.collect()
}
