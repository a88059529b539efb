//! Lights of any shape and tilt behind a half plane: its edge and the receiver span a plane that cuts the light.

use contrejour_trace::LightShape;
use glam::DVec3;

use crate::blockers::{BLOCKER, fixed, floor_points, half_plane, traced};
use crate::compare::Differences;
use crate::exact::{cone_below, disk_below, square_below};

/// A light of a size, and the part of it on the far side of the plane through `point` with the unit normal `normal`.
struct Case {
    name: &'static str,
    light: fn(size: f64) -> LightShape,
    size: f64,
}

const CENTER: DVec3 = DVec3::new(0.4, 2.5, -0.3);
const TILTED: DVec3 = DVec3::new(0.48, 0.6, 0.64);

const CASES: [Case; 4] = [
    Case {
        name: "tilted disk",
        light: |radius| LightShape::Disk { center: CENTER, normal: TILTED, radius },
        size: 0.4,
    },
    Case { name: "sphere", light: |radius| LightShape::Sphere { center: CENTER, radius }, size: 0.5 },
    Case {
        name: "rectangle",
        light: |half| LightShape::Rectangle {
            center: CENTER,
            half_u: half * DVec3::new(0.8, 0.0, -0.6),
            half_v: half * DVec3::new(0.3, 0.5, 0.4),
        },
        size: 0.5,
    },
    Case {
        name: "sun",
        light: |angular_radius| LightShape::Sun { towards_light: 3.0 * TILTED, angular_radius },
        size: 0.15,
    },
];

/// The part of the light that is hidden from a point of the floor.
fn hidden(light: &LightShape, point: DVec3) -> f64 {
    // The edge runs along z at x = 0; what is below the plane, towards negative x, is hidden.
    let normal = (DVec3::Y * BLOCKER - point).cross(DVec3::Z).normalize();
    let normal = if normal.x < 0.0 { -normal } else { normal };
    let height = |vector: DVec3| normal.dot(vector);
    let across = |axis: DVec3| (1.0 - height(axis.normalize()).powi(2)).sqrt();
    match *light {
        LightShape::Disk { center, normal, radius } => disk_below(-height(center - point) / (radius * across(normal))),
        LightShape::Sphere { center, radius } => {
            let distance = center.distance(point);
            cone_below((-height(center - point) / distance).asin(), (radius / distance).asin())
        }
        LightShape::Rectangle { center, half_u, half_v } => {
            square_below(-height(center - point), height(half_u), height(half_v))
        }
        LightShape::Sun { towards_light, angular_radius } => {
            disk_below(-height(towards_light.normalize()) / (angular_radius.tan() * across(towards_light)))
        }
    }
}

impl Case {
    /// The answers for the light, against the truth for one of another size.
    fn differences(&self, size: f64) -> Differences {
        let (light, other) = ((self.light)(self.size), (self.light)(size));
        let towards = match light {
            LightShape::Sun { towards_light, .. } => towards_light / towards_light.y,
            _ => (CENTER - DVec3::Y * BLOCKER) / (CENTER.y - BLOCKER),
        };
        let edge = -BLOCKER * towards.truncate().with_y(towards.z);
        let (points, exact): (Vec<_>, Vec<_>) = floor_points(edge, 0.5, 600)
            .map(|floor| (floor, DVec3::new(floor.x, 0.0, floor.y)))
            .filter(|(_, point)| (0.02..0.98).contains(&hidden(&light, *point)))
            .map(|(floor, point)| (floor, 1.0 - hidden(&other, point)))
            .unzip();
        Differences::of(&traced(&half_plane(), &light, &points, &fixed(256)), &exact)
    }
}

#[test]
fn answers_are_the_truth() {
    for case in CASES {
        let differences = case.differences(case.size);
        println!("{}: {differences:?}", case.name);
        assert_eq!(differences.check(), Ok(()), "{}", case.name);
    }
}

#[test]
fn a_hundredth_of_the_size_is_seen() {
    for case in CASES {
        let found = case.differences(1.01 * case.size).check();
        println!("{}: {found:?}", case.name);
        assert!(found.is_err(), "{}: the truth of a larger light passes", case.name);
    }
}
