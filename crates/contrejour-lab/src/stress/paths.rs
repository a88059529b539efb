//! Where lights and casters are in a frame: by their index, a seed and the number of the frame.

use std::f64::consts::TAU;

use glam::{DMat4, DQuat, DVec3};

/// Frames in a second of the paths.
const FRAMES_A_SECOND: f64 = 60.0;

/// How far lights go along the axes: less up and down than to the sides.
const ABOVE: DVec3 = DVec3::new(1.0, 0.5, 1.0);

/// A way around a point, with a speed and a tilt of its own.
#[derive(Clone, Copy, Debug)]
pub(super) struct Path {
    middle: DVec3,
    reach: DVec3,
    turns_a_second: DVec3,
    phase: DVec3,
    scale: DVec3,
    axis: DVec3,
}

impl Path {
    /// The path of a caster in a room of so large a radius: every second one is mirrored, every third one stretched.
    pub fn of_caster(random: &mut fastrand::Rng, index: usize, room: f64) -> Self {
        let mut vector = |size: f64| size * DVec3::from([(); 3].map(|()| 2.0 * random.f64() - 1.0));
        let stretch = if index % 3 == 2 { DVec3::splat(1.0) + vector(0.4) } else { DVec3::ONE };
        let mirror = if index % 2 == 1 { DVec3::new(-1.0, 1.0, 1.0) } else { DVec3::ONE };
        Self {
            middle: vector(0.7 * room),
            reach: vector(0.2 * room),
            turns_a_second: DVec3::splat(0.1) + vector(0.1),
            phase: vector(0.5),
            scale: 0.5 * stretch * mirror,
            axis: vector(1.0).normalize_or(DVec3::Y),
        }
    }

    /// The path of a light: a direction from the middle of the room, or a place in it by its length; always from above.
    pub fn of_light(random: &mut fastrand::Rng) -> Self {
        let mut vector = |size: f64| size * DVec3::from([(); 3].map(|()| 2.0 * random.f64() - 1.0));
        Self {
            middle: vector(0.6) * ABOVE + 0.7 * DVec3::Y,
            reach: vector(0.3) * ABOVE,
            turns_a_second: DVec3::splat(0.1) + vector(0.05),
            phase: vector(0.5),
            scale: DVec3::ONE,
            axis: DVec3::Y,
        }
    }

    /// The path of an eye, or of what it looks at, around a point of a room of radius 1.
    pub fn of_eye(random: &mut fastrand::Rng, middle: DVec3, reach: f64) -> Self {
        let mut vector = |size: f64| size * DVec3::from([(); 3].map(|()| 2.0 * random.f64() - 1.0));
        Self {
            middle,
            reach: vector(reach),
            turns_a_second: DVec3::splat(0.1) + vector(0.05),
            phase: vector(0.5),
            scale: DVec3::ONE,
            axis: DVec3::Y,
        }
    }

    /// The place in a frame.
    pub fn place(&self, frame: u64) -> DVec3 {
        self.middle + self.reach * self.angles(frame).map(f64::sin)
    }

    /// World space from object space in a frame.
    pub fn matrix(&self, frame: u64) -> DMat4 {
        let turn = DQuat::from_axis_angle(self.axis, self.angles(frame).x);
        DMat4::from_scale_rotation_translation(self.scale, turn, self.place(frame))
    }

    /// The angle of a swing in a frame.
    pub fn swing(&self, frame: u64) -> f64 {
        self.angles(frame).y
    }

    fn angles(&self, frame: u64) -> DVec3 {
        TAU * (self.phase + self.turns_a_second * (frame as f64 / FRAMES_A_SECOND))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_seed_walks_the_same_way() {
        let matrix = |seed, frame| Path::of_caster(&mut fastrand::Rng::with_seed(seed), 5, 4.0).matrix(frame);
        assert_eq!(matrix(3, 70), matrix(3, 70));
        assert_ne!(matrix(3, 70), matrix(3, 71));
        assert_ne!(matrix(3, 70), matrix(4, 70));
    }

    #[test]
    fn half_of_all_casters_are_mirrored() {
        let mut random = fastrand::Rng::with_seed(1);
        let determinants = [(); 20]
            .iter()
            .enumerate()
            .map(|(index, ())| Path::of_caster(&mut random, index, 4.0).matrix(9).determinant());
        let mirrored = determinants.filter(|determinant| *determinant < 0.0).count();
        assert_eq!(mirrored, 10);
    }
}
