//! Parallel light with an angular size: a disk of directions, which each blocker's outline cuts along a plane through the
//! receiver.

use contrejour_trace::LightShape;
use glam::{DVec2, DVec3};

use crate::blockers::{fixed, floor_points, half_plane, traced};
use crate::compare::Differences;
use crate::exact::{disk_below, disk_in_rectangle};

const ANGULAR_RADIUS: f64 = 0.15;

/// Towards the light: upright, aside of the blocker's edge, along it, and both.
const WAYS: [DVec3; 4] = [DVec3::Y, DVec3::new(1.2, 2.0, 0.0), DVec3::new(0.0, 0.5, 0.6), DVec3::new(-3.0, 4.0, 2.0)];

/// The part that a half plane hides of a sun, from a point of the floor.
fn hidden_by_half_plane(towards_light: DVec3, angular_radius: f64, point: DVec2) -> f64 {
    // A direction d meets the blocker's plane y = 1 at the x of the point and d.x / d.y: it is hidden where d.x + x d.y < 0.
    let (axis, normal) = (towards_light.normalize(), DVec3::new(1.0, point.x, 0.0));
    let across = normal - normal.dot(axis) * axis;
    disk_below(-normal.dot(axis) / (angular_radius.tan() * across.length()))
}

fn half_plane_differences(towards_light: DVec3, angular_radius: f64) -> Differences {
    // Where the middle of the light is seen on the edge.
    let edge = DVec2::new(-towards_light.x / towards_light.y, 0.0);
    let (points, exact): (Vec<_>, Vec<_>) = floor_points(edge, 0.3, 800)
        .filter(|point| (0.02..0.98).contains(&hidden_by_half_plane(towards_light, ANGULAR_RADIUS, *point)))
        .map(|point| (point, 1.0 - hidden_by_half_plane(towards_light, angular_radius, point)))
        .unzip();
    let light = LightShape::Sun { towards_light, angular_radius: ANGULAR_RADIUS };
    Differences::of(&traced(&half_plane(), &light, &points, &fixed(256)), &exact)
}

#[test]
fn a_half_plane_cuts_the_disk_of_directions() {
    for way in WAYS {
        let differences = half_plane_differences(way, ANGULAR_RADIUS);
        println!("{way}: {differences:?}");
        assert_eq!(differences.check(), Ok(()), "{way}");
    }
}

#[test]
fn a_hundredth_of_the_angle_is_seen() {
    for way in WAYS {
        assert!(half_plane_differences(way, 1.01 * ANGULAR_RADIUS).check().is_err(), "{way}: a larger sun passes");
    }
}

/// From straight above, directions are points of the blocker's plane.
#[test]
fn a_square_hides_its_share_of_an_upright_sun() {
    let square = [[-0.1, -0.1], [0.1, -0.1], [0.1, 0.1], [-0.1, 0.1]].map(DVec2::from).to_vec();
    let seen = |point: DVec2, angular_radius: f64| {
        let [low, high] = [-0.1, 0.1].map(|side| ((DVec2::splat(side) - point) / angular_radius.tan()).to_array());
        1.0 - disk_in_rectangle(low, high, 200)
    };
    let points: Vec<DVec2> =
        floor_points(DVec2::ZERO, 0.3, 800).filter(|point| seen(*point, ANGULAR_RADIUS) < 0.98).collect();
    let light = LightShape::Sun { towards_light: 7.0 * DVec3::Y, angular_radius: ANGULAR_RADIUS };
    let answers = traced(&square, &light, &points, &fixed(256));
    let differences = |angular_radius: f64| {
        let exact: Vec<f64> = points.iter().map(|point| seen(*point, angular_radius)).collect();
        Differences::of(&answers, &exact).check()
    };
    assert_eq!(differences(ANGULAR_RADIUS), Ok(()));
    assert!(differences(1.01 * ANGULAR_RADIUS).is_err(), "a larger sun passes");
}
