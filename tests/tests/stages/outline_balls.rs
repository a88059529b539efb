//! Outline edges on the image plane with bounds on rounding: what two devices may differ in, and what not.

use std::f32::consts::SQRT_2;

use contrejour_layout::{Caster, CasterLight, LightView};
use contrejour_tests::ball::Ball;
use contrejour_tests::frame::Frame;

/// The share of the longest image of an edge of its length below which that of an edge counts as a point.
const POINT_TOLERANCE: f32 = 4e-6;

/// The least share of a smoothie's growth that its own width leaves, in a sphere's light.
const LEAST_GROWTH: f32 = 0.0625;

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
    let light = &frame.caster_lights[frame.begin(frame.bundle.shape.caster_stride) + caster as usize];
    let caster = &frame.casters[caster as usize];
    let from = scaled(caster, &frame.positions, vertex);
    let to = scaled(caster, &frame.positions, other);
    let delta = [to[0] - from[0], to[1] - from[1], to[2] - from[2]];
    (transformed(light, from, 1.0), transformed(light, delta, 0.0))
}

/// Direction in which the image of a point moves towards another one, as `image_plane.wgsl` finds it.
pub fn image(frame: &Frame, caster: u32, vertex: u32, other: u32) -> Image {
    let light = &frame.caster_lights[frame.begin(frame.bundle.shape.caster_stride) + caster as usize];
    let caster = &frame.casters[caster as usize];
    let [from, to] = [vertex, other].map(|vertex| scaled(caster, &frame.positions, vertex));
    let edge = [0, 1, 2].map(|axis| to[axis] - from[axis]);
    let entry = |column: usize, row: usize| Ball::exact(light.light_clip_from_object[4 * column + row]);

    let reach = [0, 1, 3].map(|row| entry(0, row).abs() + entry(1, row).abs() + entry(2, row).abs());
    let reach_scale = reciprocal_power(largest(&reach));
    let [dx, dy, dw] = [0, 1, 3].map(|row| {
        let part = |column: usize| entry(column, row) * reach_scale * edge[column];
        part(0) + part(1) + part(2)
    });
    let [x, y, _, w] = transformed(light, from, 1.0);
    let clip_scale = reciprocal_power(largest(&[x, y, w]));
    let [x, y, w] = [x, y, w].map(|value| value * clip_scale);
    let (along_x, along_y) = (dx * w - x * dw, dy * w - y * dw);

    let [reach_x, reach_y, reach_w] = reach.map(|value| value * reach_scale);
    let longest = largest(&edge) * (reach_x.max(reach_y) * w.abs() + largest(&[x, y]) * reach_w);
    match (largest(&[along_x, along_y]) - Ball::exact(POINT_TOLERANCE) * longest).sign() {
        1 => {
            let length = along_x.value.hypot(along_y.value);
            let error = (along_x.error + along_y.error) / length + 2e-6;
            Image::Line(Direction { angle: along_y.value.atan2(along_x.value), error })
        }
        -1 => Image::Point,
        _ => Image::Either,
    }
}

/// The largest size.
fn largest(values: &[Ball]) -> Ball {
    values.iter().copied().map(Ball::abs).reduce(Ball::max).unwrap_or(Ball::exact(0.0))
}

/// A power of two that brings a size near 1.
fn reciprocal_power(size: Ball) -> Ball {
    Ball::exact(f32::from_bits(
        0x7f00_0000 - ((size.value as f32).to_bits() & 0x7f80_0000).clamp(0x0080_0000, 0x7e80_0000),
    ))
}

/// Blocker q.
pub fn q_of(view: &LightView, clip: &Clip) -> Ball {
    if view.perspective == 1 {
        return Ball::exact(-1.0) / clip[3];
    }
    let (near, far) = (Ball::exact(view.near_depth), Ball::exact(view.far_depth));
    near * (Ball::exact(1.0) - clip[2]) + far * clip[2]
}

/// Smoothie width of a disk of light.
pub fn width_of(view: &LightView, q: Ball) -> Ball {
    let width = Ball::exact(view.width_per_q_ndc) * (Ball::exact(view.q_max) - q);
    width.max(Ball::exact(view.width_min_ndc)).min(Ball::exact(view.width_max_ndc))
}

/// How wide smoothies get that reach into the map, where a disk's are as wide as given.
pub fn widest_of(view: &LightView, width: Ball) -> Ball {
    let one = Ball::exact(1.0);
    let half_side = Ball::exact(view.sphere_half_side);
    width * (one + Ball::exact(SQRT_2) * half_side) / (one - width * half_side).max(Ball::exact(LEAST_GROWTH))
}

/// The place on the image plane.
pub fn ndc_of(clip: &Clip) -> [Ball; 2] {
    [clip[0] / clip[3], clip[1] / clip[3]]
}
