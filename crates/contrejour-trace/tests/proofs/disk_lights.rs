//! Disk lights parallel to the floor: each blocker has an image on the light's plane, larger by the ratio of heights.

use contrejour_trace::{LightShape, TraceOptions};
use glam::{DVec2, DVec3};

use crate::blockers::{BLOCKER, disk, fixed, floor_points, half_plane, traced};
use crate::compare::Differences;
use crate::exact::{disk_below, disk_in_disk, disk_in_rectangle};

/// Height of the light above the floor.
pub const LIGHT: f64 = 2.5;
pub const RADIUS: f64 = 0.4;
const GROWTH: f64 = LIGHT / BLOCKER;

/// A blocker and how much it hides of the disk of a radius around the origin of the light's plane, from a floor point.
pub struct Case {
    pub name: &'static str,
    blocker: Vec<DVec2>,
    hidden: fn(point: DVec2, radius: f64) -> f64,
    /// Where on the floor its shadow has an edge.
    edge: DVec2,
}

/// Where the blocker's point `b` is seen on the light's plane.
fn image(point: DVec2, b: DVec2) -> DVec2 {
    point + GROWTH * (b - point)
}

pub fn cases() -> [Case; 4] {
    let square = |half: f64| [[-half, -half], [half, -half], [half, half], [-half, half]].map(DVec2::from).to_vec();
    [
        Case {
            name: "half plane",
            blocker: half_plane(),
            hidden: |point, radius| disk_below(image(point, DVec2::ZERO).x / radius),
            edge: DVec2::ZERO,
        },
        Case {
            name: "square",
            blocker: square(0.3),
            hidden: |point, radius| {
                let [low, high] = [-0.3, 0.3].map(|side| (image(point, DVec2::splat(side)) / radius).to_array());
                disk_in_rectangle(low, high, 200)
            },
            edge: DVec2::new(0.5, 0.5),
        },
        Case {
            name: "disk",
            blocker: disk(0.25),
            hidden: |point, radius| disk_in_disk(image(point, DVec2::ZERO).length() / radius, 0.25 * GROWTH / radius),
            edge: DVec2::new(0.3, -0.2),
        },
        Case {
            name: "small disk",
            blocker: disk(0.1),
            hidden: |point, radius| disk_in_disk(image(point, DVec2::ZERO).length() / radius, 0.1 * GROWTH / radius),
            edge: DVec2::new(0.1, 0.1),
        },
    ]
}

impl Case {
    /// Points of the floor that see a part of the light, and how much.
    pub fn penumbra(&self, radius: f64) -> (Vec<DVec2>, Vec<f64>) {
        floor_points(self.edge, 0.5, 1500)
            .map(|point| (point, 1.0 - (self.hidden)(point, RADIUS), 1.0 - (self.hidden)(point, radius)))
            .filter(|(_, seen, _)| (0.02..0.98).contains(seen))
            .map(|(point, _, exact)| (point, exact))
            .unzip()
    }

    pub fn differences(&self, radius: f64, options: &TraceOptions) -> Differences {
        let (points, exact) = self.penumbra(radius);
        let light = LightShape::Disk { center: DVec3::Y * LIGHT, normal: DVec3::Y, radius: RADIUS };
        Differences::of(&traced(&self.blocker, &light, &points, options), &exact)
    }
}

#[test]
fn answers_are_the_truth() {
    for case in cases() {
        let differences = case.differences(RADIUS, &fixed(256));
        println!("{}: {differences:?}", case.name);
        assert_eq!(differences.check(), Ok(()), "{}", case.name);
    }
}

#[test]
fn a_hundredth_of_the_radius_is_seen() {
    for case in cases() {
        let found = case.differences(1.01 * RADIUS, &fixed(256)).check();
        assert!(found.is_err(), "{}: the truth of a larger light passes", case.name);
    }
}
