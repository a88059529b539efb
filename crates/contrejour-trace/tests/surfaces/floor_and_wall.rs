//! Where a wall stands on a floor there is no gap of light behind it and no seam of shadow before it.

use glam::DVec3;

use crate::placed::{How, decoy, places};
use crate::shapes::Shape;

const LIGHT: DVec3 = DVec3::new(3.0, 4.0, 0.0);

/// Columns of the floor's grid, narrow beside the wall at x = 0.
const COLUMNS: [f64; 9] = [-1.0, -0.1, -1e-3, -1e-5, 0.0, 1e-5, 1e-3, 0.1, 1.0];

/// The floor, whose faces come first, and the wall.
fn floor_and_wall() -> (u32, Shape) {
    let column = |u: f64| COLUMNS[(u * 8.0).round() as usize];
    let floor = Shape::grid(8, 4, |u, v| DVec3::new(column(u), 0.0, 2.0 * v - 1.0));
    // As wide as what is looked at needs, with edges of its own.
    let wall = Shape::grid(6, 3, |u, v| DVec3::new(0.0, 3.0 * v, 8.0 * u - 4.0));
    (floor.triangles.len() as u32, floor.and(wall))
}

/// Whether all points of a face are before the wall, where the light is.
fn is_before(shape: &Shape, face: u32) -> bool {
    shape.triangles[face as usize].iter().all(|&vertex| shape.positions[vertex as usize][0] >= 0.0)
}

#[test]
fn the_wall_splits_light_from_shadow() {
    let (floor_faces, shape) = floor_and_wall();
    for placed in places(&shape.clone().and(decoy(LIGHT))) {
        // Elsewhere rounding makes the narrow columns others, in f32 or, a million sizes away, in f64.
        let keeps_its_columns = placed.sizes_away <= if placed.how == How::Transform { 1e6 } else { 1.0 };
        if !keeps_its_columns {
            continue;
        }
        for face in 0..floor_faces {
            let receivers = placed.receivers([face].into_iter(), DVec3::new(0.0, 3.0, 0.0));
            let seen = placed.see(&receivers, LIGHT);
            let expected = f64::from(is_before(&shape, face));
            for (receiver, seen) in receivers.iter().zip(&seen) {
                assert_eq!(seen.mean, expected, "{placed}: {receiver:?}");
            }
        }
    }
}

#[test]
fn without_the_wall_there_is_light() {
    let (floor_faces, mut shape) = floor_and_wall();
    shape.triangles.truncate(floor_faces as usize);
    let placed = places(&shape).swap_remove(0);
    let receivers = placed.receivers(0..floor_faces, DVec3::new(0.0, 3.0, 0.0));
    assert!(placed.see(&receivers, LIGHT).iter().all(|seen| seen.mean == 1.0), "the test above would pass by itself");
}
