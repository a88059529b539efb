//! Point lights: casters across the borders and corners of the cube's faces, lamps of all sizes, at all scales, with a near
//! plane in the mesh.

use contrejour_plan::{Light, LightKind};
use contrejour_scene::Camera;
use glam::{DMat4, DQuat, DVec3};

use super::super::case::{Case, CaseMesh};
use super::super::effort::Effort;
use super::super::family::Family;
use super::super::meshes::{RING_RADIUS, ring};
use super::super::plates::{HEIGHT, LAMP, LAMP_RADIUS, aside, bulb, plate_over_floor};
use crate::report::Scale;

pub(super) const BORDERS: Family = Family {
    name: "lamp-borders",
    stresses: "A lamp over a plate and a floor that are turned around it, so that the plate's shadow moves from the middle \
               of a face of the cube over an edge and to a corner.",
    parameter: "angle between the plate and the axis of a face, radians",
    scale: Scale::Linear,
    cases: borders,
};

pub(super) const SIZES: Family = Family {
    name: "lamp-sizes",
    stresses: "A lamp before a corner of the cube grows from a point to far beyond the scene.",
    parameter: "radius of the lamp over the plate's distance (0 is left out of the plots)",
    scale: Scale::Log,
    cases: sizes,
};

pub(super) const SCALES: Family = Family {
    name: "lamp-scale",
    stresses: "A lamp and a ring that crosses faces of the cube grow from the smallest numbers of the type to its largest \
               ones.",
    parameter: "scale",
    scale: Scale::Log,
    cases: scales,
};

pub(super) const AMID: Family = Family {
    name: "lamp-amid",
    stresses: "A lamp comes from outside of a ring into its middle, where all faces of the cube but two see the ring, and \
               on to its wall.",
    parameter: "distance from the ring's middle over its radius",
    scale: Scale::Linear,
    cases: amid,
};

pub(super) const NEAR_PLANES: Family = Family {
    name: "lamp-near-plane",
    stresses: "The near planes of all faces come from the lamp, reach a ring before a corner of the cube and pass it.",
    parameter: "near depth over the distance of the ring's middle",
    scale: Scale::Log,
    cases: near_planes,
};

/// From straight down, the middle of a face, towards a corner of the cube and towards the middle of an edge.
const WAYS: [(&str, DVec3); 2] = [("corner", DVec3::new(1.0, -1.0, 1.0)), ("edge", DVec3::new(0.0, -1.0, 1.0))];

fn borders(effort: &Effort) -> Vec<Case> {
    let steps: Vec<u32> = (0..=10).collect();
    let cases = effort.some_of(&steps).into_iter().flat_map(|step| {
        WAYS.map(|(name, way)| {
            // Up to the border itself and beyond: an eighth more.
            let angle = 1.125 * f64::from(step) / 10.0 * way.angle_between(-DVec3::Y);
            let turn = DQuat::from_axis_angle((-DVec3::Y).cross(way).normalize(), angle);
            turned(plate_over_floor(format!("{angle:.3}, {name}"), angle, HEIGHT, bulb(LAMP_RADIUS)), turn)
        })
    });
    cases.collect()
}

fn sizes(effort: &Effort) -> Vec<Case> {
    let point = [("0".to_owned(), 0.0)];
    let sizes = point.into_iter().chain(effort.powers_of_ten(-9, -2, 1));
    let wide = [0.03, 0.1, 0.3, 1.0, 3.0, 10.0];
    let sizes = sizes.chain(effort.some_of(&wide).into_iter().map(|size| (size.to_string(), size)));
    let sizes = sizes.chain(effort.powers_of_ten(3, 37, 2));
    let to_corner = DQuat::from_rotation_arc(-DVec3::Y, WAYS[0].1.normalize());
    let cases = sizes.map(|(name, size)| {
        let lamp = bulb(size * (LAMP - HEIGHT));
        let mut case = turned(plate_over_floor(name, size, HEIGHT, lamp), to_corner);
        if size >= 0.5 {
            case.explain_error(
                0.7,
                "the lamp is about as large as its distance from the plate, which it all but touches: soft edges are those of \
                 a sphere that is small beside that distance",
            );
        }
        case
    });
    cases.collect()
}

/// The case, turned about the lamp, whose cube stays.
fn turned(mut case: Case, turn: DQuat) -> Case {
    let lamp = DVec3::Y * LAMP;
    let about_lamp = DMat4::from_translation(lamp) * DMat4::from_quat(turn) * DMat4::from_translation(-lamp);
    for mesh in &mut case.meshes {
        mesh.world_from_object = about_lamp * mesh.world_from_object;
    }
    let Camera { eye, target, up, .. } = aside();
    let [eye, target] = [eye, target].map(|point| about_lamp.transform_point3(point));
    case.seen_from = Some(Camera { eye, target, up: turn * up, ..aside() });
    case
}

/// A case in which views see different sides of a mesh.
#[cfg(test)]
pub(in super::super) fn a_lamp_amid_a_ring() -> Case {
    Case::new(String::new(), 0.0, ring(1.0, DVec3::ZERO), lamp(DVec3::new(0.1, 0.05, -0.1), 1.0))
}

/// A lamp of a world that is so many times as large.
fn lamp(position: DVec3, scale: f64) -> Light {
    let kind = LightKind::Point { position, radius: 0.03 * scale, near: 0.3 * scale, far: 8.0 * scale };
    Light { kind, color: [1.0; 3] }
}

fn scales(effort: &Effort) -> Vec<Case> {
    let cases = effort.powers_of_ten(-45, 38, 3).into_iter().map(|(name, scale)| {
        let light = lamp(scale * DVec3::new(1.3, 2.1, 1.7), scale);
        // As for spots: depths below the smallest normal number, and a far plane whose inverse is.
        Case {
            refusal_is_due: !(1e-37..=1e37).contains(&scale),
            ..Case::new(name, scale, ring(scale, DVec3::ZERO), light)
        }
    });
    cases.collect()
}

fn amid(effort: &Effort) -> Vec<Case> {
    let places = [3.0, 2.0, 1.5, 1.0, 0.5, 0.3, 0.1, 1e-3, 1e-8, 0.0];
    let cases = effort.some_of(&places).into_iter().flat_map(|place| {
        [("above", DVec3::Y), ("aside", DVec3::new(0.31, 0.86, 0.4))].map(|(name, way)| {
            let light = lamp(place * RING_RADIUS * way, 1.0);
            Case::new(format!("{place:e}, {name}"), place, ring(1.0, DVec3::ZERO), light)
        })
    });
    cases.collect()
}

fn near_planes(effort: &Effort) -> Vec<Case> {
    let shares = [1e-30, 1e-20, 1e-10, 1e-6, 1e-4, 1e-2, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0];
    let position = DVec3::new(2.0, 2.1, 1.9);
    let mesh: CaseMesh = ring(1.0, DVec3::ZERO);
    let cases = effort.some_of(&shares).into_iter().map(|share| {
        let near = share * position.length();
        let kind = LightKind::Point { position, radius: 0.05, near, far: 6.0 };
        let case = Case::new(format!("{share:e}"), share, mesh.clone(), Light { kind, color: [1.0; 3] });
        // Depth along the nearest axis: a corner of the cube is the farthest from it.
        if near * 3.0_f64.sqrt() < position.length() - RING_RADIUS {
            return case;
        }
        case.without_gap_search(
            "the near planes cut the mesh; what is before them casts nothing, a cut is no edge and has no smoothie, and \
             gaps are not looked for",
        )
    });
    cases.collect()
}
