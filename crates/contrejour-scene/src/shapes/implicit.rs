//! Bodies as signed distances: negative inside, positive outside, and about 1 longer a step outward.

use glam::{DQuat, DVec3};

/// Distance to a capsule whose radius goes from `radii[0]` at `begin` to `radii[1]` at `end`.
///
/// The radius is interpolated along the axis, which is not quite the distance to the hull of the two balls, but as
/// smooth.
pub(super) fn capsule(point: DVec3, begin: DVec3, end: DVec3, radii: [f64; 2]) -> f64 {
    let axis = end - begin;
    let along = ((point - begin).dot(axis) / axis.length_squared()).clamp(0.0, 1.0);
    (point - begin - along * axis).length() - (radii[0] + along * (radii[1] - radii[0]))
}

/// Over what difference of distances the joints of a chain are rounded; more makes them bulge.
const JOINT: f64 = 0.02;

/// Distance to a chain of capsules through `stations`: middle and radius of each.
pub(super) fn chain(point: DVec3, stations: &[(DVec3, f64)]) -> f64 {
    stations
        .windows(2)
        .map(|pair| capsule(point, pair[0].0, pair[1].0, [pair[0].1, pair[1].1]))
        .fold(f64::INFINITY, |nearest, distance| blend(nearest, distance, JOINT))
}

/// About the distance to an ellipsoid, after Quilez (2008): exact on the surface, first order around it.
pub(super) fn ellipsoid(point: DVec3, middle: DVec3, turn: DQuat, radii: DVec3) -> f64 {
    let local = turn.inverse() * (point - middle);
    let scaled = (local / radii).length();
    let steepness = (local / (radii * radii)).length();
    if steepness > 0.0 { scaled * (scaled - 1.0) / steepness } else { -radii.min_element() }
}

/// Smooth union of two distances, after Quilez (2013): rounds the crease where they differ by less than `width`.
pub(super) fn blend(first: f64, second: f64, width: f64) -> f64 {
    let overlap = (width - (first - second).abs()).max(0.0) / width;
    first.min(second) - 0.25 * overlap * overlap * width
}

/// The direction of steepest ascent, by central differences over `step`; its length is about 1.
pub(super) fn gradient(distance: &impl Fn(DVec3) -> f64, point: DVec3, step: f64) -> DVec3 {
    let slope = |axis: DVec3| (distance(point + step * axis) - distance(point - step * axis)) / (2.0 * step);
    DVec3::new(slope(DVec3::X), slope(DVec3::Y), slope(DVec3::Z))
}
