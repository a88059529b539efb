//! The plane.

use super::surface::Surface;
use glam::DVec3;

pub(super) fn plane(size: [f64; 2], segments: u32) -> Surface {
    let mut surface = Surface::default();
    let at = |step: u32| f64::from(step) / f64::from(segments) - 0.5;
    for row in 0..=segments {
        for column in 0..=segments {
            surface.vertex(DVec3::new(at(column) * size[0], 0.0, at(row) * size[1]), DVec3::Y);
        }
    }
    let stride = segments + 1;
    for row in 0..segments {
        for column in 0..segments {
            let corner = row * stride + column;
            surface.quad([corner, corner + stride, corner + stride + 1, corner + 1]);
        }
    }
    surface
}
