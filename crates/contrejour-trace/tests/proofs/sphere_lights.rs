//! Spheres of light: point lights with a size.

use contrejour_trace::{LightShape, TraceOptions};
use glam::{DVec2, DVec3};

use crate::blockers::{BLOCKER, disk, fixed, floor_points, half_plane, traced};
use crate::exact::{cone_below, disk_below};

const CENTER: DVec3 = DVec3::new(0.0, 2.5, 0.0);
const RADIUS: f64 = 0.5;
const SPHERE: LightShape = LightShape::Sphere { center: CENTER, radius: RADIUS };

/// The part of the sphere that a disk between the floor's origin and the sphere's centre hides: of two cones around one
/// axis, the solid angle of the one over that of the other.
fn hidden_by_disk(disk_radius: f64, sphere_radius: f64) -> f64 {
    let solid_angle = |sine: f64| 1.0 - (1.0 - sine * sine).sqrt();
    let own = solid_angle(disk_radius / disk_radius.hypot(BLOCKER));
    (own / solid_angle(sphere_radius / CENTER.y)).min(1.0)
}

/// Largest difference between answers and the truth for a sphere of some radius.
fn error_behind_disks(sphere_radius: f64) -> f64 {
    (1..20)
        .map(|step| 0.01 * f64::from(step))
        .map(|disk_radius| {
            let answer = traced(&disk(disk_radius), &SPHERE, &[DVec2::ZERO], &fixed(1024))[0].mean;
            (answer - (1.0 - hidden_by_disk(disk_radius, sphere_radius))).abs()
        })
        .fold(0.0, f64::max)
}

#[test]
fn disks_hide_their_solid_angle() {
    let error = error_behind_disks(RADIUS);
    assert!(error < 0.002, "{error}");
}

#[test]
fn a_hundredth_of_the_radius_is_seen() {
    let error = error_behind_disks(1.01 * RADIUS);
    assert!(error > 0.01, "the truth of a larger sphere passes: {error}");
}

#[test]
fn spheres_behind_a_blocker_are_dark_and_others_are_lit() {
    let far_left: Vec<DVec2> = floor_points(DVec2::new(-3.0, 0.0), 1.0, 100).collect();
    for answer in traced(&half_plane(), &SPHERE, &far_left, &TraceOptions::default()) {
        assert_eq!(answer.mean, 0.0);
    }
    let far_right: Vec<DVec2> = floor_points(DVec2::new(3.0, 0.0), 1.0, 100).collect();
    for answer in traced(&half_plane(), &SPHERE, &far_right, &TraceOptions::default()) {
        assert_eq!((answer.mean, answer.samples), (1.0, 0), "no ray is needed");
    }
}

/// From a point, a sphere is the disk in its silhouette: by solid angle and by the disk's area it is seen as much, but for
/// a part of the angle squared.
#[test]
fn a_sphere_is_a_disk_that_faces_the_receiver() {
    for radius in [0.05, 0.2, 0.5, 1.0] {
        let angle = (radius / CENTER.y).asin();
        let largest = (-100..=100)
            .map(|step| angle * f64::from(step) / 100.0)
            // A plane through the point at an angle to the axis cuts the disk's plane at the tangent's share of its radius.
            .map(|d| (cone_below(d, angle) - disk_below(d.tan() / angle.tan())).abs())
            .fold(0.0, f64::max);
        let bound = 0.06 * (radius / CENTER.y).powi(2);
        println!("{radius}: {largest}, {}", largest / bound);
        assert!(largest < bound && largest > 0.8 * bound, "{radius}: {largest} {bound}");
    }
}

/// The same for the tracer's own disks and spheres.
#[test]
fn disks_that_face_the_receiver_have_the_same_answers() {
    for point in floor_points(DVec2::ZERO, 0.4, 100) {
        let to_center = CENTER - DVec3::new(point.x, 0.0, point.y);
        let (distance, axis) = (to_center.length(), to_center.normalize());
        let facing = LightShape::Disk {
            center: CENTER - axis * (RADIUS * RADIUS / distance),
            normal: axis,
            radius: RADIUS * (1.0 - (RADIUS / distance).powi(2)).sqrt(),
        };
        let [sphere, disk] =
            [SPHERE, facing].map(|light| traced(&half_plane(), &light, &[point], &fixed(1024))[0].mean);
        assert!((sphere - disk).abs() < 0.06 * (RADIUS / distance).powi(2) + 0.002, "{point}: {sphere} {disk}");
    }
}
