//! All rays from one point to a light at once.

use glam::DVec3;

/// What rounding may do to sines and cosines here, with room to spare.
const ROUNDING: f64 = 1e-12;

/// A cone that holds all rays from a point above a face to a light, cut off by the face's plane. The tests err on the
/// side of meeting: what they rule out blocks no ray.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Shaft {
    apex: DVec3,
    /// Unit, towards the middle of the light.
    axis: DVec3,
    /// Of the cone's half angle, 0 to 1.
    sine: f64,
    cosine: f64,
    /// Unit normal of the face at the apex; nothing below it is met.
    normal: DVec3,
    /// A sphere that holds the light, relative to the apex; none for a sun.
    light: Option<(DVec3, f64)>,
}

impl Shaft {
    /// To a light inside a sphere. None where the apex is inside it too.
    pub fn to_sphere(apex: DVec3, normal: DVec3, center: DVec3, radius: f64) -> Option<Self> {
        let to_center = center - apex;
        let distance = to_center.length();
        let sine = radius / distance + ROUNDING;
        (sine < 1.0).then(|| Self {
            light: Some((to_center, radius)),
            ..Self::around(apex, normal, to_center / distance, sine)
        })
    }

    /// To a sun whose directions lie within an angle around a unit axis.
    pub fn to_sun(apex: DVec3, normal: DVec3, axis: DVec3, angular_radius: f64) -> Self {
        Self::around(apex, normal, axis, (angular_radius.sin() + ROUNDING).min(1.0))
    }

    fn around(apex: DVec3, normal: DVec3, axis: DVec3, sine: f64) -> Self {
        Self { apex, axis, sine, cosine: (1.0 - sine * sine).sqrt(), normal, light: None }
    }

    /// Whether a box may meet a ray, by the sphere around it.
    pub fn may_meet_box(&self, center: DVec3, half_size: DVec3) -> bool {
        let center = center - self.apex;
        let radius = half_size.length();
        let along = self.axis.dot(center);
        let across = (center - along * self.axis).length();
        let is_beside = across * self.cosine - along * self.sine > radius;
        let is_below = self.normal.dot(center) + self.normal.abs().dot(half_size) < 0.0;
        let is_beyond = self.light.is_some_and(|(light, size)| along - radius > light.length() + size);
        !(is_beside || is_below || is_beyond)
    }

    /// Whether a face may block a ray.
    pub fn may_meet_face(&self, corners: &[DVec3; 3]) -> bool {
        let [a, b, c] = corners.map(|corner| corner - self.apex);
        if [a, b, c].iter().all(|corner| self.normal.dot(*corner) < 0.0) {
            return false;
        }
        // The face's plane, turned so that the apex is below it. Rays that fall, or end at a light below it, miss it.
        let across = (b - a).cross(c - a).normalize();
        let up = if across.dot(a) < 0.0 { -across } else { across };
        let height = up.dot(a);
        let all_fall = up.dot(self.axis) < -self.sine;
        let all_end_below = self.light.is_some_and(|(light, radius)| up.dot(light) + radius < height);
        if all_fall || all_end_below {
            return false;
        }
        // The planes through the apex and a side, turned so that the face is above. The cone may lie below one of them.
        let misses_at = |from: DVec3, to: DVec3, third: DVec3| {
            let side = from.cross(to);
            let inwards = if side.dot(third) < 0.0 { -side } else { side };
            inwards.dot(self.axis) < -self.sine * side.length()
        };
        !(misses_at(a, b, c) || misses_at(b, c, a) || misses_at(c, a, b))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shaft() -> Shaft {
        Shaft::to_sphere(DVec3::ZERO, DVec3::Y, DVec3::Y * 10.0, 1.0).expect("the origin is outside the light")
    }

    /// A face parallel to the floor, a point of which is `at`.
    fn face(at: DVec3) -> [DVec3; 3] {
        [DVec3::ZERO, DVec3::X, DVec3::Z].map(|corner| at + corner)
    }

    #[test]
    fn faces_between_meet() {
        assert!(shaft().may_meet_face(&face(DVec3::new(-0.3, 5.0, -0.3))));
        assert!(shaft().may_meet_face(&face(DVec3::new(0.45, 5.0, 0.0))), "the rim passes");
        let wide = face(DVec3::ZERO).map(|corner| 1e3 * (corner - DVec3::new(0.3, 0.0, 0.3)) + 5.0 * DVec3::Y);
        assert!(shaft().may_meet_face(&wide), "the light is behind its middle");
    }

    #[test]
    fn faces_elsewhere_do_not() {
        assert!(!shaft().may_meet_face(&face(DVec3::new(0.6, 5.0, 0.0))), "beside");
        assert!(!shaft().may_meet_face(&face(DVec3::new(-0.3, 11.5, -0.3))), "beyond the light");
        assert!(!shaft().may_meet_face(&face(DVec3::new(-0.3, -0.1, -0.3))), "below the floor");
        assert!(!shaft().may_meet_face(&[-9.0, 9.0, 0.0].map(|x| DVec3::new(x, 20.0 + x, -3.0))), "a wall behind");
    }

    #[test]
    fn boxes_follow() {
        let meets = |x, y| shaft().may_meet_box(DVec3::new(x, y, 0.0), DVec3::splat(0.1));
        assert!(meets(0.0, 5.0) && meets(0.5, 5.0) && meets(0.0, 0.0) && meets(0.0, 10.5));
        assert!(!meets(0.8, 5.0), "beside");
        assert!(!meets(0.0, 11.5), "beyond");
        assert!(!meets(0.0, -0.2), "below");
    }

    #[test]
    fn a_sun_has_no_beyond() {
        let shaft = Shaft::to_sun(DVec3::ZERO, DVec3::Y, DVec3::Y, 0.1);
        assert!(shaft.may_meet_face(&face(DVec3::new(0.0, 1e3, 0.0))));
        assert!(!shaft.may_meet_face(&face(DVec3::new(0.2, 1.0, 0.0))));
    }

    #[test]
    fn inside_the_light_there_is_no_shaft() {
        assert!(Shaft::to_sphere(DVec3::ZERO, DVec3::Y, DVec3::Y * 0.5, 1.0).is_none());
    }
}
