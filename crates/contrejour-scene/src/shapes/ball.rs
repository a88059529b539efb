//! The ball.

use std::f64::consts::{PI, TAU};

use super::surface::Surface;
use glam::DVec3;

pub(super) fn ball(radius: f64, segments: u32) -> Surface {
    let rings = segments / 2;
    let mut surface = Surface::default();
    let north = surface.vertex(radius * DVec3::Y, DVec3::Y);
    let south = surface.vertex(-radius * DVec3::Y, DVec3::NEG_Y);
    for ring in 1..rings {
        let (sin_polar, cos_polar) = (PI * f64::from(ring) / f64::from(rings)).sin_cos();
        for step in 0..segments {
            let (sin, cos) = (TAU * f64::from(step) / f64::from(segments)).sin_cos();
            let normal = DVec3::new(sin_polar * sin, cos_polar, sin_polar * cos);
            surface.vertex(radius * normal, normal);
        }
    }
    let at = |ring: u32, step: u32| 2 + (ring - 1) * segments + step % segments;
    for step in 0..segments {
        surface.triangles.push([north, at(1, step), at(1, step + 1)]);
        for ring in 1..rings - 1 {
            surface.quad([at(ring, step), at(ring + 1, step), at(ring + 1, step + 1), at(ring, step + 1)]);
        }
        surface.triangles.push([south, at(rings - 1, step + 1), at(rings - 1, step)]);
    }
    surface
}
