//! What the light sees: the plane that silhouettes are drawn on.

use glam::{DVec2, DVec3, DVec4};

/// The view from a light towards the middle of some bounds.
#[derive(Clone, Copy, Debug)]
pub struct Sight {
    light: DVec4,
    forward: DVec3,
    right: DVec3,
    up: DVec3,
    /// What is nearer to a light at a point is cut off.
    near: f64,
}

/// What is nearer to the light than this part of the bounds' size is cut off: it would fill the drawing.
const NEAR_PART: f64 = 1e-2;

impl Sight {
    /// `light` is a position and 1 or a direction towards the light and 0.
    pub fn new(light: DVec4, bounds_min: DVec3, bounds_max: DVec3) -> Self {
        let center = 0.5 * (bounds_min + bounds_max);
        let towards_light = light.truncate() - light.w * center;
        let forward = -unit(towards_light).unwrap_or(DVec3::Z);
        // Any up will do where the light looks straight down.
        let up = if forward.y.abs() < 0.999 { DVec3::Y } else { DVec3::NEG_Z };
        let right = forward.cross(up).normalize();
        let near = NEAR_PART * (bounds_max - bounds_min).max_element();
        Self { light, forward, right, up: right.cross(forward), near }
    }

    /// Both ends of a line on the plane, x to the right and y up; cut off where it comes too near to the light or goes
    /// behind it. `None` where nothing is left; `true` where something was cut off.
    pub fn line(&self, begin: DVec3, end: DVec3) -> Option<([DVec2; 2], bool)> {
        if self.light.w == 0.0 {
            return Some(([begin, end].map(|point| self.across(point)), false));
        }
        let [begin, end] = [begin, end].map(|point| point - self.light.truncate());
        let [begin_depth, end_depth] = [begin, end].map(|offset| offset.dot(self.forward));
        if begin_depth.max(end_depth) <= self.near {
            return None;
        }
        let cut = begin + (end - begin) * ((self.near - begin_depth) / (end_depth - begin_depth));
        let seen = |offset: DVec3, depth: f64| if depth > self.near { offset } else { cut };
        let ends = [seen(begin, begin_depth), seen(end, end_depth)];
        let is_cut = begin_depth.min(end_depth) <= self.near;
        Some((ends.map(|offset| self.across(offset) / offset.dot(self.forward)), is_cut))
    }

    fn across(&self, offset: DVec3) -> DVec2 {
        DVec2::new(offset.dot(self.right), offset.dot(self.up))
    }
}

/// A vector of any length but zero as a unit vector.
fn unit(vector: DVec3) -> Option<DVec3> {
    (vector / vector.abs().max_element()).try_normalize()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sight(light: DVec4) -> Sight {
        Sight::new(light, DVec3::NEG_ONE, DVec3::ONE)
    }

    #[test]
    fn a_point_light_sees_in_perspective() {
        let sight = sight(DVec4::new(0.0, 0.0, 5.0, 1.0));
        let line = sight.line(DVec3::new(1.0, 0.0, 1.0), DVec3::new(0.0, 1.0, 0.0));
        assert_eq!(line, Some(([DVec2::new(0.25, 0.0), DVec2::new(0.0, 0.2)], false)));
    }

    #[test]
    fn a_direction_sees_without_perspective() {
        let sight = sight(DVec4::new(0.0, 0.0, 3e-30, 0.0));
        let line = sight.line(DVec3::new(1.0, 0.0, 1.0), DVec3::new(0.0, 1.0, -1000.0));
        assert_eq!(line, Some(([DVec2::X, DVec2::Y], false)));
    }

    #[test]
    fn what_is_behind_the_light_is_cut_off() {
        let sight = sight(DVec4::new(0.0, 0.0, 0.5, 1.0));
        assert_eq!(sight.line(DVec3::new(0.0, 0.0, 0.9), DVec3::new(1.0, 0.0, 0.8)), None);
        let (ends, is_cut) = sight.line(DVec3::new(1.0, 0.0, 0.9), DVec3::new(1.0, 0.0, 0.0)).expect("one end is seen");
        assert!(is_cut && ends[1] == DVec2::new(2.0, 0.0) && ends[0].is_finite(), "{ends:?}");
    }

    #[test]
    fn straight_down_and_in_the_middle_there_is_a_view_too() {
        for light in [DVec4::new(0.0, 7.0, 0.0, 1.0), DVec4::new(0.0, 1.0, 0.0, 0.0), DVec4::new(0.0, 0.0, 0.0, 1.0)] {
            let sight = sight(light);
            assert!(sight.right.is_normalized() && sight.up.is_normalized() && sight.forward.is_normalized());
        }
    }
}
