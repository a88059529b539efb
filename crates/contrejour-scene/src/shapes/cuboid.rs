//! The box; `box` is a reserved word.

use super::surface::Surface;
use glam::DVec3;

pub(super) fn cuboid(size: [f64; 3]) -> Surface {
    let half = 0.5 * DVec3::from(size);
    let mut surface = Surface::default();
    for axis in 0..3 {
        let mut across = DVec3::ZERO;
        let mut side = DVec3::ZERO;
        let mut front = DVec3::ZERO;
        front[axis] = half[axis];
        across[(axis + 1) % 3] = half[(axis + 1) % 3];
        side[(axis + 2) % 3] = half[(axis + 2) % 3];
        surface.flat_quad([front - across - side, front + across - side, front + across + side, front - across + side]);
        surface.flat_quad([
            -front - across - side,
            -front - across + side,
            -front + across + side,
            -front + across - side,
        ]);
    }
    surface
}
