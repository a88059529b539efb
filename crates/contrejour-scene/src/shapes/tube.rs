//! Closed tubes: the torus and the trefoil knot.

use std::f64::consts::TAU;

use super::surface::Surface;
use glam::DVec3;

/// Times that the knot goes around the y axis, and times that it goes around the torus it winds on.
const KNOT_TURNS: [f64; 2] = [2.0, 3.0];

/// Radius of the torus that the knot winds on, over its distance from the axis.
const KNOT_SWING: f64 = 0.45;

pub(super) fn torus(radius: f64, tube_radius: f64, segments: u32, sides: u32) -> Surface {
    tube(tube_radius, segments, sides, |turn| {
        let (sin, cos) = turn.sin_cos();
        let outward = DVec3::new(sin, 0.0, cos);
        Station { middle: radius * outward, along: DVec3::new(cos, 0.0, -sin), outward }
    })
}

pub(super) fn knot(radius: f64, tube_radius: f64, segments: u32, sides: u32) -> Surface {
    let swing = KNOT_SWING * radius;
    let [around, through] = KNOT_TURNS;
    tube(tube_radius, segments, sides, |turn| {
        let (sin_around, cos_around) = (around * turn).sin_cos();
        let (sin_through, cos_through) = (through * turn).sin_cos();
        let from_axis = DVec3::new(sin_around, 0.0, cos_around);
        // The normal of the torus is square to every curve on it and comes back to itself: the tube closes untwisted.
        let outward = cos_through * from_axis + sin_through * DVec3::Y;
        let reach = radius + swing * cos_through;
        let along = reach * around * DVec3::new(cos_around, 0.0, -sin_around)
            + swing * through * (cos_through * DVec3::Y - sin_through * from_axis);
        Station { middle: radius * from_axis + swing * outward, along: along.normalize(), outward }
    })
}

/// One step along a tube: its middle, the unit direction of the tube and a unit direction square to it.
struct Station {
    middle: DVec3,
    along: DVec3,
    outward: DVec3,
}

fn tube(tube_radius: f64, segments: u32, sides: u32, station: impl Fn(f64) -> Station) -> Surface {
    let mut surface = Surface::default();
    for segment in 0..segments {
        let Station { middle, along, outward } = station(TAU * f64::from(segment) / f64::from(segments));
        let sideways = along.cross(outward);
        for side in 0..sides {
            let (sin, cos) = (TAU * f64::from(side) / f64::from(sides)).sin_cos();
            let normal = cos * outward + sin * sideways;
            surface.vertex(middle + tube_radius * normal, normal);
        }
    }
    let at = |segment: u32, side: u32| segment % segments * sides + side % sides;
    for segment in 0..segments {
        for side in 0..sides {
            surface.quad([at(segment, side), at(segment, side + 1), at(segment + 1, side + 1), at(segment + 1, side)]);
        }
    }
    surface
}
