//! Disk lights parallel to the floor: each blocker has an image on the light's plane, larger by the ratio of heights.

use contrejour_trace::{LightShape, TraceOptions, Visibility};
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
        floor_points(self.edge, 0.5, 800)
            .map(|point| (point, 1.0 - (self.hidden)(point, RADIUS), 1.0 - (self.hidden)(point, radius)))
            .filter(|(_, seen, _)| (0.02..0.98).contains(seen))
            .map(|(point, _, exact)| (point, exact))
            .unzip()
    }

    fn traced(&self, points: &[DVec2], options: &TraceOptions) -> Vec<Visibility> {
        let light = LightShape::Disk { center: DVec3::Y * LIGHT, normal: DVec3::Y, radius: RADIUS };
        traced(&self.blocker, &light, points, options)
    }

    pub fn differences(&self, radius: f64, options: &TraceOptions) -> Differences {
        let (points, exact) = self.penumbra(radius);
        Differences::of(&self.traced(&points, options), &exact)
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
        println!("{}: {found:?}", case.name);
        assert!(found.is_err(), "{}: the truth of a larger light passes", case.name);
    }
}

#[test]
fn what_needs_no_ray_is_lit() {
    for case in cases() {
        let points: Vec<DVec2> = floor_points(case.edge, 1.0, 2000).collect();
        let answers = case.traced(&points, &TraceOptions::default());
        let (mut lit, mut lit_without_rays) = (0, 0);
        for (point, answer) in points.iter().zip(&answers) {
            let hidden = (case.hidden)(*point, RADIUS);
            if answer.samples == 0 {
                assert!(answer.mean == 1.0 && hidden < 1e-9, "{}: {point}, {hidden}, {answer:?}", case.name);
                lit_without_rays += 1;
            }
            lit += u32::from(hidden < 1e-9);
        }
        assert!(lit > 500 && 10 * lit_without_rays > 9 * lit, "{}: {lit_without_rays} of {lit}", case.name);
    }
}

#[test]
fn umbras_are_dark() {
    let case = &cases()[0];
    let points: Vec<DVec2> = floor_points(DVec2::new(-2.0, 0.0), 1.0, 200).collect();
    for answer in case.traced(&points, &TraceOptions::default()) {
        assert_eq!(answer.mean, 0.0);
        assert_eq!(answer.standard_error, 1.0 / f64::from(answer.samples), "a sample is the least that can be told");
    }
}
