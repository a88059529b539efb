//! Cameras, lights and floors that follow from what is to be seen.

mod camera_fit;
mod depths;
mod floor;
mod room;

use glam::DVec3;

use crate::{Bounds, Scene, SceneMesh};

pub(crate) use depths::{camera_depths, cone_angle, depths_all_around, light_depths, sun_extents};

/// Boxes that are smaller count as points, so that no depth is too small for 32 bits.
const SMALLEST: f64 = 1e-30;

/// A scene around meshes that bring none; they are, or will move, within these bounds.
pub(crate) fn frame_within(meshes: Vec<SceneMesh>, bounds: Bounds) -> Scene {
    if room::is_room(&meshes, &bounds) {
        room::seen_from_within(meshes, bounds)
    } else {
        floor::on_a_floor(meshes, bounds)
    }
}

/// The bounds, or a box of some size in their place where there is nothing or a single point.
pub(crate) fn with_some_size(bounds: Bounds) -> Bounds {
    if bounds.is_empty() {
        return Bounds { min: DVec3::splat(-0.5), max: DVec3::splat(0.5) };
    }
    let middle = bounds.center();
    let distance = middle.abs().max_element();
    // Finer than this, f32 positions cannot differ.
    let finest = (1e-7 * distance).max(SMALLEST);
    if bounds.size().length() > finest {
        return bounds;
    }
    let half = if distance > 0.0 { 1e3 * finest } else { 0.5 };
    Bounds { min: middle - half, max: middle + half }
}

#[cfg(test)]
mod tests;
