//! The cylinder.

use std::f64::consts::TAU;

use super::surface::Surface;
use glam::DVec3;

pub(super) fn cylinder(radius: f64, height: f64, segments: u32) -> Surface {
    let mut surface = Surface::default();
    let outward: Vec<DVec3> = (0..segments)
        .map(|step| {
            let (sin, cos) = (TAU * f64::from(step) / f64::from(segments)).sin_cos();
            DVec3::new(sin, 0.0, cos)
        })
        .collect();
    let half_height = DVec3::new(0.0, 0.5 * height, 0.0);

    // The side: one vertex above the other, one normal for both.
    for &direction in &outward {
        surface.vertex(radius * direction - half_height, direction);
        surface.vertex(radius * direction + half_height, direction);
    }
    for step in 0..segments {
        let (here, next) = (2 * step, 2 * ((step + 1) % segments));
        surface.quad([here, next, next + 1, here + 1]);
    }

    // The caps: fans around their middle.
    for (end, normal) in [(-half_height, DVec3::NEG_Y), (half_height, DVec3::Y)] {
        let middle = surface.vertex(end, normal);
        for &direction in &outward {
            surface.vertex(radius * direction + end, normal);
        }
        for step in 0..segments {
            let (here, next) = (middle + 1 + step, middle + 1 + (step + 1) % segments);
            surface.triangles.push(if normal.y > 0.0 { [middle, here, next] } else { [middle, next, here] });
        }
    }
    surface
}
