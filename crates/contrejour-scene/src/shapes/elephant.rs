//! The elephant, blended from capsules and ellipsoids.

use glam::{DQuat, DVec3, USizeVec3, dvec3};

use super::implicit::{blend, capsule, chain, ellipsoid};
use super::polygonise::polygonise;
use super::surface::Surface;

/// Height at the back in the units of the numbers below.
const MODEL_HEIGHT: f64 = 2.2;

/// The box that holds the model with room to spare.
const LOW: DVec3 = dvec3(-1.75, -0.2, -1.3);
const HIGH: DVec3 = dvec3(2.65, 2.75, 1.3);

pub(super) fn elephant(height: f64, segments: u32) -> Surface {
    let cell = (HIGH.x - LOW.x) / f64::from(segments);
    let cells = ((HIGH - LOW) / cell).ceil();
    let cells = USizeVec3::new(cells.x as usize, cells.y as usize, cells.z as usize);
    let mut surface = polygonise(LOW, cell, cells, elephant_distance);
    for position in &mut surface.positions {
        *position *= height / MODEL_HEIGHT;
    }
    surface
}

/// Walks towards +x, stands on y = 0.
fn elephant_distance(point: DVec3) -> f64 {
    // Parts that come in pairs are alike on both sides: |z|.
    let mirrored = dvec3(point.x, point.y, point.z.abs());

    let mut body = torso(point);
    body = blend(body, legs(point), 0.16);
    body = blend(body, head(point, mirrored), 0.22);
    body = blend(body, trunk(point), 0.12);
    body = blend(body, ear(mirrored), 0.06);
    body = blend(body, tusk(mirrored), 0.03);
    body = blend(body, tail(point), 0.05);
    // The soles are flat.
    body.max(-point.y)
}

fn torso(point: DVec3) -> f64 {
    let barrel = ellipsoid(point, dvec3(-0.12, 1.5, 0.0), DQuat::IDENTITY, dvec3(0.98, 0.66, 0.62));
    let rump = ellipsoid(point, dvec3(-0.72, 1.42, 0.0), DQuat::IDENTITY, dvec3(0.52, 0.62, 0.52));
    let shoulder = ellipsoid(point, dvec3(0.55, 1.5, 0.0), DQuat::IDENTITY, dvec3(0.48, 0.6, 0.5));
    blend(blend(barrel, rump, 0.2), shoulder, 0.2)
}

/// A walking pose: the left front and the right hind leg are forward.
fn legs(point: DVec3) -> f64 {
    let leg = |hip: DVec3, knee: DVec3, foot: DVec3, thick: f64| {
        chain(
            point,
            &[
                (hip, thick),
                (knee, 0.215),
                (foot + dvec3(-0.01, 0.28, 0.0), 0.2),
                (foot + dvec3(0.03, 0.06, 0.0), 0.235),
            ],
        )
    };
    let fronts = leg(dvec3(0.62, 1.15, -0.32), dvec3(0.8, 0.68, -0.34), dvec3(0.86, 0.0, -0.34), 0.27).min(leg(
        dvec3(0.58, 1.15, 0.32),
        dvec3(0.52, 0.66, 0.34),
        dvec3(0.36, 0.0, 0.34),
        0.27,
    ));
    let hinds = leg(dvec3(-0.78, 1.15, -0.3), dvec3(-0.8, 0.66, -0.33), dvec3(-1.02, 0.0, -0.33), 0.32).min(leg(
        dvec3(-0.7, 1.15, 0.3),
        dvec3(-0.56, 0.68, 0.33),
        dvec3(-0.54, 0.0, 0.33),
        0.32,
    ));
    fronts.min(hinds)
}

fn head(point: DVec3, mirrored: DVec3) -> f64 {
    let skull = ellipsoid(point, dvec3(1.2, 1.92, 0.0), DQuat::IDENTITY, dvec3(0.4, 0.46, 0.36));
    let brow = ellipsoid(mirrored, dvec3(1.22, 2.16, 0.13), DQuat::IDENTITY, dvec3(0.26, 0.24, 0.2));
    let cheek = ellipsoid(mirrored, dvec3(1.38, 1.62, 0.16), DQuat::IDENTITY, dvec3(0.22, 0.24, 0.16));
    let jaw = capsule(point, dvec3(1.2, 1.55, 0.0), dvec3(1.48, 1.36, 0.0), [0.2, 0.09]);
    let eye = ellipsoid(mirrored, dvec3(1.46, 1.9, 0.27), DQuat::IDENTITY, DVec3::splat(0.05));
    let face = blend(blend(skull, brow, 0.12), cheek, 0.12);
    blend(blend(face, jaw, 0.08), eye, 0.03)
}

/// Hangs from the forehead, and its tip curls forward and up.
fn trunk(point: DVec3) -> f64 {
    chain(
        point,
        &[
            (dvec3(1.42, 1.86, 0.0), 0.25),
            (dvec3(1.64, 1.62, 0.0), 0.22),
            (dvec3(1.78, 1.3, 0.01), 0.185),
            (dvec3(1.85, 0.98, 0.02), 0.16),
            (dvec3(1.91, 0.68, 0.03), 0.14),
            (dvec3(2.02, 0.44, 0.04), 0.122),
            (dvec3(2.2, 0.34, 0.05), 0.108),
            (dvec3(2.37, 0.42, 0.06), 0.096),
            (dvec3(2.44, 0.58, 0.07), 0.085),
        ],
    )
}

/// A wide flap that stands off the neck and hangs to a point.
fn ear(mirrored: DVec3) -> f64 {
    // About the vertical: the flap opens backwards and outwards from where it grows.
    let turn = DQuat::from_xyzw(0.0, 0.3826834323650898, 0.0, 0.9238795325112867);
    let flap = ellipsoid(mirrored, dvec3(0.98, 1.9, 0.62), turn, dvec3(0.42, 0.46, 0.08));
    let lobe = ellipsoid(mirrored, dvec3(1.02, 1.6, 0.58), turn, dvec3(0.28, 0.36, 0.07));
    blend(flap, lobe, 0.1)
}

fn tusk(mirrored: DVec3) -> f64 {
    chain(
        mirrored,
        &[
            (dvec3(1.46, 1.54, 0.19), 0.075),
            (dvec3(1.66, 1.28, 0.26), 0.07),
            (dvec3(1.88, 1.14, 0.29), 0.06),
            (dvec3(2.1, 1.16, 0.27), 0.055),
        ],
    )
}

fn tail(point: DVec3) -> f64 {
    chain(
        point,
        &[
            (dvec3(-1.18, 1.66, 0.0), 0.09),
            (dvec3(-1.4, 1.36, 0.02), 0.055),
            (dvec3(-1.46, 1.0, 0.04), 0.045),
            (dvec3(-1.46, 0.84, 0.05), 0.075),
            (dvec3(-1.44, 0.68, 0.05), 0.05),
        ],
    )
}
