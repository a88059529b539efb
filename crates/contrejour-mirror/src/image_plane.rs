//! Edges on the light's image plane.

use contrejour_layout::CasterLight;
use glam::{Mat4, Vec2, Vec3, Vec4, Vec4Swizzles};

/// An edge whose image is shorter than this share of the terms that it is the difference of is rounding noise.
const POINT_TOLERANCE: f32 = 1e-7;

/// Clip coordinates of a scaled position.
pub(crate) fn clip_of_position(light: &CasterLight, position: Vec3) -> Vec4 {
    Mat4::from_cols_array(&light.light_clip_from_object) * position.extend(1.0)
}

/// Clip coordinates of a difference of scaled positions.
pub(crate) fn clip_of_delta(light: &CasterLight, delta: Vec3) -> Vec4 {
    Mat4::from_cols_array(&light.light_clip_from_object) * delta.extend(0.0)
}

/// Unit direction in which the image of `clip + t * delta` moves as `t` grows; none where the edge projects to a point.
///
/// Derivative of `xy / w`, times `w` squared: right for any sign of `w`, also that of an end behind the light.
pub(crate) fn image_direction(clip: Vec4, delta: Vec4) -> Option<Vec2> {
    let ahead = delta.xy() * clip.w;
    let drift = clip.xy() * delta.w;
    let direction = ahead - drift;
    let size = direction.x.abs().max(direction.y.abs());
    let noise = POINT_TOLERANCE * (ahead.length() + drift.length());
    if size > noise {
        // Divided by its size first, so that squares neither overflow nor vanish.
        return Some((direction / size).normalize());
    }
    None
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
    use super::*;

    #[test]
    fn direction_does_not_depend_on_the_side_of_the_light() {
        // The same line seen from an end in front of the light and from one behind it.
        let delta = Vec4::new(0.5, -1.0, 0.0, -3.0);
        let front = Vec4::new(1.0, 1.0, 0.0, 2.0);
        let behind = front + delta;
        let from_front = image_direction(front, delta).expect("the line is no point");
        let from_behind = image_direction(behind, delta).expect("the line is no point");
        assert!(behind.w < 0.0);
        assert!(from_front.distance(from_behind) < 1e-6);
        let ahead = (front + 0.01 * delta).xy() / (front + 0.01 * delta).w;
        let image = (ahead - front.xy() / front.w).normalize();
        assert!(from_front.distance(image) < 1e-4);
    }

    #[test]
    fn edge_along_a_ray_is_a_point() {
        assert_eq!(image_direction(Vec4::new(0.3, 0.7, 0.0, 1.1), 2.0 * Vec4::new(0.3, 0.7, 0.0, 1.1)), None);
        assert_eq!(image_direction(Vec4::new(0.3, 0.7, 0.0, 1.0), Vec4::new(0.0, 0.0, 1.0, 0.0)), None);
        assert_eq!(image_direction(Vec4::new(f32::NAN, 0.7, 0.0, 1.0), Vec4::X), None);
    }

    #[test]
    fn tiny_edges_have_directions() {
        let direction = image_direction(Vec4::new(0.0, 0.0, 0.0, 1.0), Vec4::new(3e-30, 4e-30, 0.0, 0.0));
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
