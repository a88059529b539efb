//! A convex body shadows no part of itself that the whole light is above of.

use contrejour_trace::Facing;
use glam::DVec3;

use crate::placed::{decoy, places};
use crate::shapes::Shape;

const LIGHT: DVec3 = DVec3::new(0.5, 6.0, -1.0);

#[test]
fn lit_faces_are_wholly_lit() {
    for body in [Shape::sphere(), Shape::cube()] {
        for placed in places(&body.clone().and(decoy(LIGHT))) {
            // The eye is at the light: what it sees from behind, it sees through the body.
            let receivers: Vec<_> = (0..body.triangles.len() as u32)
                .flat_map(|face| {
                    let outside = 3.0 * centre(&body, face);
                    placed.receivers([face].into_iter(), outside)
                })
                .collect();
            let seen = placed.see(&receivers, LIGHT);
            let mut rays = 0;
            for (receiver, seen) in receivers.iter().zip(&seen) {
                match seen.facing {
                    Facing::Towards => assert_eq!(seen.mean, 1.0, "{placed}: {receiver:?}"),
                    Facing::Averted => assert_eq!(seen.mean, 0.0, "{placed}: {receiver:?}"),
                    Facing::MostlyTowards | Facing::MostlyAverted => {}
                }
                rays += seen.samples;
            }
            assert!(rays as usize > 8 * receivers.len(), "{placed}: {rays} rays leave the test empty");
        }
    }
}

fn centre(shape: &Shape, face: u32) -> DVec3 {
    let corner = |vertex: u32| DVec3::from(shape.positions[vertex as usize].map(f64::from));
    shape.triangles[face as usize].map(corner).into_iter().sum::<DVec3>() / 3.0
}
