//! A convex body shadows no part of itself that the whole light is above of.

use contrejour_trace::Facing;
use glam::DVec3;

use crate::placed::{decoy, places};
use crate::shapes::Shape;

const LIGHT: DVec3 = DVec3::new(0.5, 6.0, -1.0);

/// A receiver of the body that has the whole light above it and does not see it all, or has it below and sees some.
fn first_fault(body: &Shape) -> Option<String> {
    for placed in places(&body.clone().and(decoy(LIGHT))) {
        let receivers: Vec<_> = (0..body.triangles.len() as u32)
            .flat_map(|face| placed.receivers([face].into_iter(), 3.0 * centre(body, face)))
            .collect();
        let seen = placed.see(&receivers, LIGHT);
        for (receiver, seen) in receivers.iter().zip(&seen) {
            let is_right = match seen.facing {
                Facing::Towards => seen.mean == 1.0,
                Facing::Averted => seen.mean == 0.0,
                Facing::MostlyTowards | Facing::MostlyAverted => true,
            };
            if !is_right {
                return Some(format!("{placed}: {receiver:?}, {seen:?}"));
            }
        }
        let rays: u32 = seen.iter().map(|seen| seen.samples).sum();
        assert!(rays as usize > 8 * receivers.len(), "{placed}: {rays} rays leave the test empty");
    }
    None
}

#[test]
fn convex_bodies_do_not_shadow_themselves() {
    for body in [Shape::sphere(), Shape::cube()] {
        assert_eq!(first_fault(&body), None);
    }
}

#[test]
fn a_dent_shadows_itself() {
    for mut body in [Shape::sphere(), Shape::cube()] {
        let side = body.positions.iter().position(|&[x, y, z]| x > 0.8 && y.abs() < 0.4 && z.abs() < 0.4);
        body.positions[side.expect("bodies have a side towards x")][0] = 0.4;
        assert!(first_fault(&body).is_some(), "the test above would not see a shadow");
    }
}

/// Of a face's corners.
fn centre(shape: &Shape, face: u32) -> DVec3 {
    let corner = |vertex: u32| DVec3::from(shape.positions[vertex as usize].map(f64::from));
    shape.triangles[face as usize].map(corner).into_iter().sum::<DVec3>() / 3.0
}
