//! How near, how far and how wide a view must reach.

use glam::DVec3;

use crate::Bounds;

/// The widest cone that is made without being asked: the map of a wider one has its texels where nobody looks.
const WIDEST_CONE_DEGREES: f64 = 130.0;

/// Depths where there is nothing to see.
const EMPTY_DEPTHS: [f64; 2] = [0.1, 100.0];

/// A light's nearest depth is this share of its farthest one, or more.
const LIGHT_LEAST_SHARE: f64 = 1e-2;

/// Near and far depth of a camera at `eye` that looks along the unit vector `forward`.
pub(crate) fn camera_depths(bounds: &Bounds, eye: DVec3, forward: DVec3) -> [f64; 2] {
    depths(bounds, eye, forward, 1e-3)
}

/// Near and far depth of a light at `position` that shines along the unit vector `axis`.
pub(crate) fn light_depths(bounds: &Bounds, position: DVec3, axis: DVec3) -> [f64; 2] {
    depths(bounds, position, axis, LIGHT_LEAST_SHARE)
}

/// Near and far depth of a light at `position` that shines all around, along whichever axis of the world is nearest.
pub(crate) fn depths_all_around(bounds: &Bounds, position: DVec3) -> [f64; 2] {
    if bounds.is_empty() {
        return EMPTY_DEPTHS;
    }
    // 0 where the light is inside the box.
    let nearest = (position.clamp(bounds.min, bounds.max) - position).abs().max_element();
    let farthest =
        bounds.corners().map(|corner| (corner - position).abs().max_element()).into_iter().fold(0.0, f64::max);
    if farthest <= 0.0 {
        return EMPTY_DEPTHS;
    }
    let far = 1.02 * farthest;
    [(0.9 * nearest).max(LIGHT_LEAST_SHARE * far), far]
}

/// Nearest and farthest depth of the box with some room; `near` is at least `least_share` of `far`, also where the box
/// reaches behind the viewer.
fn depths(bounds: &Bounds, eye: DVec3, forward: DVec3, least_share: f64) -> [f64; 2] {
    if bounds.is_empty() {
        return EMPTY_DEPTHS;
    }
    let depth = |point: DVec3| (point - eye).dot(forward);
    let nearest = bounds.corners().map(depth).into_iter().fold(f64::INFINITY, f64::min);
    let farthest = bounds.corners().map(depth).into_iter().fold(f64::NEG_INFINITY, f64::max);
    if farthest <= 0.0 {
        return EMPTY_DEPTHS;
    }
    let far = 1.02 * farthest;
    [(0.9 * nearest).max(least_share * far), far]
}

/// Full opening angle of the cone from `position` along the unit vector `axis` that holds all of the box; at most
/// [`WIDEST_CONE_DEGREES`].
pub(crate) fn cone_angle(bounds: &Bounds, position: DVec3, axis: DVec3) -> f64 {
    let half_angle =
        bounds.corners().into_iter().map(|corner| (corner - position).angle_between(axis)).fold(0.0, f64::max);
    if bounds.is_empty() { 1.0 } else { (2.05 * half_angle).min(WIDEST_CONE_DEGREES.to_radians()) }
}

/// Half extent and half depth of a directional light from `direction` that shadows all of the box around `center`.
pub(crate) fn sun_extents(bounds: &Bounds, center: DVec3, direction: DVec3) -> [f64; 2] {
    if bounds.is_empty() {
        return [1.0, 1.0];
    }
    let mut extents = [0.0_f64; 2];
    for corner in bounds.corners() {
        let along = (corner - center).dot(direction);
        // The map may be turned any way about the axis: it must hold the circle.
        extents[0] = extents[0].max((corner - center - along * direction).length());
        extents[1] = extents[1].max(along.abs());
    }
    extents.map(|extent| (1.02 * extent).max(1e-9))
}
