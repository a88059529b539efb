//! A camera that holds given points as large as it can.

use glam::DVec3;

use crate::{Bounds, Camera};

/// Part of the picture's width and height that the points may fill.
const FILL: f64 = 0.88;

/// A camera of opening `fov_y` that looks along `forward` and has all `points` in the picture; `bounds` is what it
/// must reach in depth.
pub(super) fn fit_camera(points: &[DVec3], bounds: &Bounds, forward: DVec3, fov_y: f64, aspect: f64) -> Camera {
    let forward = forward.normalize();
    let right = forward.cross(DVec3::Y).normalize();
    let up = right.cross(forward);
    let tangent_y = FILL * (0.5 * fov_y).tan();
    let [across, back_across] = fit_axis(points, right, forward, aspect * tangent_y);
    let [upward, back_upward] = fit_axis(points, up, forward, tangent_y);
    let eye = across * right + upward * up + back_across.min(back_upward) * forward;
    let depth =
        bounds.corners().map(|corner| (corner - eye).dot(forward)).into_iter().fold(f64::NEG_INFINITY, f64::max);
    let target = eye + 0.5 * depth * forward;
    let [near, far] = super::camera_depths(bounds, eye, forward);
    Camera { eye, target, up: DVec3::Y, fov_y, near, far }
}

/// Where along `side`, and how far along `forward` at most, the eye may be for all points to lie within `tangent` of
/// the view.
///
/// A point (s, f) is in view of an eye at (S, F) when |s - S| <= tangent (f - F): one bound on S - tangent F and one
/// on -S - tangent F, which meet where both are tight.
fn fit_axis(points: &[DVec3], side: DVec3, forward: DVec3, tangent: f64) -> [f64; 2] {
    let highest = |sign: f64| {
        let reach = points.iter().map(|point| sign * point.dot(side) - tangent * point.dot(forward));
        reach.fold(f64::NEG_INFINITY, f64::max)
    };
    let (plus, minus) = (highest(1.0), highest(-1.0));
    [0.5 * (plus - minus), -0.5 * (plus + minus) / tangent]
}
