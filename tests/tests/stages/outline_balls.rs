//! Outline edges on the image plane with bounds on rounding: what two devices may differ in, and what not.

use contrejour_layout::{Caster, CasterLight, LightView};
use contrejour_tests::ball::Ball;
use contrejour_tests::frame::Frame;

/// The share of its terms below which the image of an edge counts as a point.
const POINT_TOLERANCE: f32 = 1e-7;

/// A position or a difference of positions in clip space: x, y, z, w.
pub type Clip = [Ball; 4];

/// A unit vector on the image plane.
#[derive(Clone, Copy, Debug)]
pub struct Direction {
    /// Angle, radians.
    pub angle: f64,
    /// How far a computed vector may be from it.
    pub error: f64,
}

/// What is known of an edge's image before rounding.
#[derive(Clone, Copy, Debug)]
pub enum Image {
    /// It is a line in every computation.
    Line(Direction),
    /// It is a point in every computation.
    Point,
    /// Rounding decides.
    Either,
}

/// A vertex, near 1 as the stages bring it there; origins and powers of two are exact, for subnormal numbers too.
fn scaled(caster: &Caster, positions: &[u32], vertex: u32) -> [Ball; 3] {
    let word = (caster.first_position_word + vertex * caster.position_stride_words) as usize;
    let from_origin = |axis: usize| f32::from_bits(positions[word + axis]) - caster.position_origin[axis];
    [0, 1, 2].map(|axis| Ball::exact(from_origin(axis) * caster.position_scale))
}

fn transformed(light: &CasterLight, [x, y, z]: [Ball; 3], w: f32) -> Clip {
    let matrix = &light.light_clip_from_object;
    [0, 1, 2, 3].map(|row| {
        let column = |index: usize| Ball::exact(matrix[4 * index + row]);
        column(0) * x + column(1) * y + column(2) * z + column(3) * Ball::exact(w)
    })
}

/// Clip space of one vertex, and of the way from it to another one.
pub fn clip_and_delta(frame: &Frame, caster: u32, vertex: u32, other: u32) -> (Clip, Clip) {
    let light = &frame.caster_lights[caster as usize];
    let caster = &frame.casters[caster as usize];
    let from = scaled(caster, &frame.positions, vertex);
    let to = scaled(caster, &frame.positions, other);
    let delta = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
    (transformed(light, from, 1.0), transformed(light, delta, 0.0))
}

/// Direction in which the image of a point moves.
pub fn image(clip: &Clip, delta: &Clip) -> Image {
    let [x, y, _, w] = *clip;
    let [dx, dy, _, dw] = *delta;
    let (ahead_x, ahead_y) = (dx * w, dy * w);
    let (drift_x, drift_y) = (x * dw, y * dw);
    let (along_x, along_y) = (ahead_x - drift_x, ahead_y - drift_y);
    let noise = Ball::exact(POINT_TOLERANCE) * (Ball::length(ahead_x, ahead_y) + Ball::length(drift_x, drift_y));
    match (along_x.abs().max(along_y.abs()) - noise).sign() {
        1 => {
            let length = along_x.value.hypot(along_y.value);
            let error = (along_x.error + along_y.error) / length + 2e-6;
            Image::Line(Direction { angle: along_y.value.atan2(along_x.value), error })
        }
        -1 => Image::Point,
        _ => Image::Either,
    }
}

/// Blocker q.
pub fn q_of(view: &LightView, clip: &Clip) -> Ball {
    if view.perspective == 1 {
        return Ball::exact(-1.0) / clip[3];
    }
    let (near, far) = (Ball::exact(view.near_depth), Ball::exact(view.far_depth));
    near * (Ball::exact(1.0) - clip[2]) + far * clip[2]
}

/// Smoothie width.
pub fn width_of(view: &LightView, q: Ball) -> Ball {
    let per_q = Ball::exact(view.width_per_q_ndc) * (Ball::exact(view.q_max) - q);
    let width = Ball::exact(view.width_fixed_ndc) + per_q;
    width.max(Ball::exact(view.width_min_ndc)).min(Ball::exact(view.width_max_ndc))
}

/// The place on the image plane.
pub fn ndc_of(clip: &Clip) -> [Ball; 2] {
    [clip[0] / clip[3], clip[1] / clip[3]]
}
