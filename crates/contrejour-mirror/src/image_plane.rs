//! Edges on the light's image plane.

use contrejour_layout::CasterLight;
use glam::{Mat4, Vec2, Vec3, Vec4, Vec4Swizzles};

/// An edge whose image is shorter than this share of what it could be at any other angle to the light projects to a
/// point. Rounding turns edges by some 1e-7, while facing is exact: below that, direction and facing disagree.
/// Enough above it for directions right to a hundredth of a radian, and still far below a texel.
const POINT_TOLERANCE: f32 = 4e-6;

/// Light clip space from the caster's scaled object space.
pub(crate) fn clip_from_object(light: &CasterLight) -> Mat4 {
    Mat4::from_cols_array(&light.light_clip_from_object)
}

/// Unit direction in which the image moves from a low to a high end; none where the edge projects to a point.
///
/// Derivative of `xy / w`, times `w` squared: right for any sign of `w`, also that of an end behind the light. Of its
/// factors both are brought near 1, since clip space is as large or as small as the scene.
pub(crate) fn image_direction(clip_from_object: &Mat4, low: Vec3, high: Vec3) -> Option<Vec2> {
    let edge = high - low;
    let columns = [clip_from_object.x_axis, clip_from_object.y_axis, clip_from_object.z_axis];
    let reach = columns[0].abs() + columns[1].abs() + columns[2].abs();
    let reach_scale = reciprocal_power(reach.x.max(reach.y).max(reach.w));
    let [x, y, z] = columns.map(|column| column * reach_scale);
    let delta = x * edge.x + y * edge.y + z * edge.z;
    let clip = clip_from_object * low.extend(1.0);
    let near_one = clip * reciprocal_power(clip.x.abs().max(clip.y.abs()).max(clip.w.abs()));
    let direction = delta.xy() * near_one.w - near_one.xy() * delta.w;
    let size = direction.x.abs().max(direction.y.abs());
    if size > POINT_TOLERANCE * longest_image(reach * reach_scale, near_one, edge) {
        // Divided by its size first, so that squares neither overflow nor vanish.
        return Some((direction / size).normalize());
    }
    None
}

/// A power of two that brings a size near 1; it is a normal float for any size.
fn reciprocal_power(size: f32) -> f32 {
    f32::from_bits(0x7f00_0000 - (size.to_bits() & 0x7f80_0000).clamp(0x0080_0000, 0x7e80_0000))
}

/// A bound of the terms that a direction is the difference of, for any edge as long as `edge`; `reach` is how far a step
/// along all axes goes in clip space.
fn longest_image(reach: Vec4, clip: Vec4, edge: Vec3) -> f32 {
    let offset = clip.x.abs().max(clip.y.abs());
    let length = edge.x.abs().max(edge.y.abs()).max(edge.z.abs());
    length * (reach.x.max(reach.y) * clip.w.abs() + offset * reach.w)
}

pub(crate) fn counter_clockwise(v: Vec2) -> Vec2 {
    Vec2::new(-v.y, v.x)
}

pub(crate) fn clockwise(v: Vec2) -> Vec2 {
    Vec2::new(v.y, -v.x)
}

/// Unit bisector of a wedge of at most half a turn.
///
/// The sum vanishes at half a turn and the difference at none, so each is used where it is long.
pub(crate) fn halfway(begin: Vec2, end: Vec2) -> Vec2 {
    if begin.dot(end) >= 0.0 {
        return (begin + end).normalize();
    }
    counter_clockwise(begin - end).normalize()
}

#[cfg(test)]
mod tests {
    use glam::Vec3Swizzles;

    use super::*;

    /// At the origin, looking down the z axis, half a right angle to each side.
    const SPOT: Mat4 =
        Mat4::from_cols(Vec4::X, Vec4::Y, Vec4::new(0.0, 0.0, -1.0, -1.0), Vec4::new(0.0, 0.0, -1.0, 0.0));

    #[test]
    fn direction_does_not_depend_on_the_side_of_the_light() {
        // The same line seen from an end in front of the light and from one behind it.
        let front = Vec3::new(1.0, 1.0, -2.0);
        let delta = Vec3::new(0.5, -1.0, 3.0);
        let from_front = image_direction(&SPOT, front, front + delta).expect("the line is no point");
        let from_behind = image_direction(&SPOT, front + delta, front + 2.0 * delta).expect("the line is no point");
        assert!(from_front.distance(from_behind) < 1e-6);
        let image = |t: f32| {
            let point = front + t * delta;
            point.xy() / -point.z
        };
        assert!(from_front.distance((image(0.01) - image(0.0)).normalize()) < 1e-4);
    }

    #[test]
    fn direction_does_not_depend_on_the_size_of_clip_space() {
        let (low, high) = (Vec3::new(1.0, 1.0, -2.0), Vec3::new(1.25, 1.5, -3.0));
        let expected = image_direction(&SPOT, low, high);
        assert!(expected.is_some());
        for exponent in [-124, -90, -66, -30, 30, 62, 90, 124] {
            assert_eq!(image_direction(&(SPOT * 2.0_f32.powi(exponent)), low, high), expected, "2^{exponent}");
        }
    }

    #[test]
    fn powers_bring_any_size_near_one() {
        for size in [1e-37, 1e-20, 0.75, 1.0, 3.0, 1e20, 3e38] {
            assert!((1.0..4.0).contains(&(size * reciprocal_power(size))), "{size}");
        }
        assert!([0.0, 1e-40, f32::INFINITY, f32::NAN].map(reciprocal_power).iter().all(|power| power.is_normal()));
    }

    #[test]
    fn edge_along_a_ray_is_a_point() {
        let on_ray = Vec3::new(0.3, 0.7, -1.1);
        assert_eq!(image_direction(&SPOT, on_ray, 2.9 * on_ray), None);
        assert_eq!(image_direction(&SPOT, Vec3::NAN, on_ray), None);
        assert_eq!(image_direction(&SPOT, on_ray, on_ray), None);
    }

    #[test]
    fn what_the_matrix_rounds_is_no_direction() {
        let mut overhead = Mat4::IDENTITY;
        overhead.z_axis.x = 1e-7;
        assert_eq!(image_direction(&overhead, Vec3::ZERO, Vec3::Z), None);
        overhead.z_axis.x = 1e-5;
        assert_eq!(image_direction(&overhead, Vec3::ZERO, Vec3::Z), Some(Vec2::X));
    }

    #[test]
    fn tiny_edges_have_directions() {
        let direction = image_direction(&Mat4::IDENTITY, Vec3::ZERO, Vec3::new(3e-30, 4e-30, 0.0));
        assert!(direction.expect("the edge is no point").distance(Vec2::new(0.6, 0.8)) < 1e-6);
    }

    #[test]
    fn halfway_bisects_wedges_up_to_half_a_turn() {
        for step in 0..=180 {
            let angle = (step as f32).to_radians();
            let begin = Vec2::from_angle(0.3);
            let middle = halfway(begin, Vec2::from_angle(0.3 + angle));
            assert!(middle.distance(Vec2::from_angle(0.3 + 0.5 * angle)) < 1e-5, "at {step} degrees");
        }
    }
}
