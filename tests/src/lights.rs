//! Lights for a mesh: ordinary ones and ones that stand where facing and projection are hard.

use std::f64::consts::PI;

use contrejour_plan::{CascadeSettings, Eye, Light, LightKind, ShadowSettings, View, cascade_views};
use glam::DVec3;

use crate::meshes::TestMesh;
use crate::random::Random;

/// Lights of one mesh that every promise is tested with.
pub const LIGHTS_PER_MESH: usize = 32;

/// Which of them are in the plane of a face, at a point or as a direction.
pub const IN_PLANES_OF_FACES: [usize; 5] = [17, 18, 19, 30, 31];

/// Points around, near, far away, inside, on vertices, in the planes of faces; directions along axes, along edges, in
/// the planes of faces and oblique. The same in every run.
pub fn lights(mesh: &TestMesh) -> Vec<Light> {
    let (middle, radius) = mesh.middle_and_radius();
    let corners: Vec<_> = mesh.corners_world().collect();
    let mut random = Random::new(corners.len() as u64);
    let mut lights = Vec::with_capacity(LIGHTS_PER_MESH);

    for index in 0..8 {
        lights.push(point(middle + 2.5 * radius * spiral(index, 8), middle, radius));
    }
    for index in 0..3 {
        lights.push(point(middle + 1.05 * radius * spiral(index, 3), middle, radius));
    }
    lights.push(point(middle + 1e4 * radius * spiral(1, 5), middle, radius));
    lights.push(point(middle, middle, radius));
    lights.push(point(middle + 0.3 * radius * spiral(2, 5), middle, radius));
    for _ in 0..3 {
        let [a, _, _] = face(&corners, &mut random);
        lights.push(point(a, middle, radius));
    }
    for step in 0..3 {
        // Multiples that are exact in binary keep the light in the plane where the coordinates allow it.
        let [a, b, c] = face(&corners, &mut random);
        lights.push(point(a + f64::from(step - 1) * 2.0 * (b - a) + 2.0 * (c - a), middle, radius));
    }
    for axis in DVec3::AXES {
        lights.push(direction(axis, middle, radius));
        lights.push(direction(-axis, middle, radius));
    }
    for index in 0..4 {
        lights.push(direction(spiral(index, 4), middle, radius));
    }
    let [a, b, c] = face(&corners, &mut random);
    lights.push(direction(b - a, middle, radius));
    lights.push(direction((b - a) + (c - a), middle, radius));
    lights
}

/// Point lights around which a mesh lies on several faces of the cube: one in its middle, and one outside that looks at it
/// through an edge of the cube. None where they have no place within 32-bit numbers.
pub fn lamps(mesh: &TestMesh) -> Vec<Light> {
    let (middle, radius) = mesh.middle_and_radius();
    let outside = middle + 1.3 * radius * DVec3::new(0.7, 0.7, 0.1);
    let lamps = [(middle, 0.05 * radius), (outside, 0.1 * radius)].map(|(position, near)| {
        let kind = LightKind::Point { position, radius: 0.02 * radius, near, far: 4.0 * radius };
        Light { kind, color: [1.0; 3] }
    });
    lamps.into_iter().filter(|lamp| lamp.validate().is_ok()).collect()
}

/// Cascades of an eye amid a mesh, by parallel light from two sides: most of what casts is in front of their nearest depth.
/// None where they have no place within 32-bit numbers.
pub fn cascades(mesh: &TestMesh) -> Vec<View> {
    let (middle, radius) = mesh.middle_and_radius();
    let views = [DVec3::new(0.3, 1.0, 0.2), DVec3::new(-1.0, 0.1, 0.4)].map(|towards_light| {
        let cascades = CascadeSettings { count: 2, caster_margin: 0.0, ..CascadeSettings::DEFAULT };
        let kind = LightKind::Cascaded { towards_light, angular_radius: 0.02, cascades };
        let eye = Eye {
            position: middle - 0.3 * radius * towards_light,
            forward: DVec3::new(1.0, 0.2, -0.5),
            fov_y: 1.0,
            aspect: 1.4,
            near: 0.1 * radius,
            far: 0.9 * radius,
        };
        let seen = cascade_views(&Light { kind, color: [1.0; 3] }, &eye, &ShadowSettings::default());
        seen.map(|seen| seen.cascades).unwrap_or_default()
    });
    views.into_iter().flatten().map(|cascade| cascade.view).collect()
}

/// The same light ten times as wide: its penumbrae are several texels wide.
pub fn widened(light: &Light) -> Light {
    let mut widened = *light;
    match &mut widened.kind {
        LightKind::Spot { radius: size, .. }
        | LightKind::Point { radius: size, .. }
        | LightKind::Directional { angular_radius: size, .. }
        | LightKind::Cascaded { angular_radius: size, .. } => *size *= 10.0,
    }
    widened
}

/// A spot at a point that looks at a target, wide enough to hold most of what is around it; parallel light from there
/// where a spot has no place within 32-bit numbers.
pub fn point(position: DVec3, target: DVec3, radius: f64) -> Light {
    let distance = position.distance(target);
    let target = if distance > 1e-3 * radius { target } else { position - radius * DVec3::Y };
    let cone_angle = (2.0 * (1.2 * radius).atan2(distance)).clamp(0.02, 0.7 * PI);
    let kind = LightKind::Spot {
        position,
        target,
        cone_angle,
        radius: 0.02 * radius,
        near: (distance - 1.1 * radius).max(0.01 * radius),
        far: distance + 1.1 * radius,
    };
    let light = Light { kind, color: [1.0; 3] };
    if light.validate().is_ok() { light } else { direction(position - target, DVec3::ZERO, radius) }
}

/// A spot at the origin that looks through a view from there, as wide and from as near on.
pub fn through(view: &View, radius: f64) -> Light {
    let kind = LightKind::Spot {
        position: DVec3::ZERO,
        target: view.axis_world,
        cone_angle: 2.0 * view.half_side.atan(),
        radius,
        near: view.near_depth,
        far: view.far_depth,
    };
    Light { kind, color: [1.0; 3] }
}

/// Parallel light that shadows what is around a centre; along y where the direction is zero.
pub fn direction(towards_light: DVec3, center: DVec3, radius: f64) -> Light {
    let towards_light = if towards_light.length() > 0.0 { towards_light } else { DVec3::Y };
    let kind = LightKind::Directional {
        towards_light,
        center,
        half_extent: 1.1 * radius,
        half_depth: 1.1 * radius,
        angular_radius: 0.02,
    };
    Light { kind, color: [1.0; 3] }
}

/// Corners of a random face, or of one of its own where there is none.
fn face(corners: &[DVec3], random: &mut Random) -> [DVec3; 3] {
    match corners.len() / 3 {
        0 => [DVec3::ZERO, DVec3::X, DVec3::Y],
        faces => {
            let first = 3 * random.below(faces);
            [corners[first], corners[first + 1], corners[first + 2]]
        }
    }
}

/// One of `count` directions spread over the sphere.
fn spiral(index: u32, count: u32) -> DVec3 {
    let golden_angle = PI * (3.0 - 5.0_f64.sqrt());
    let y = 1.0 - (2.0 * f64::from(index) + 1.0) / f64::from(count);
    let (sine, cosine) = (golden_angle * f64::from(index) + 0.3).sin_cos();
    let around = (1.0 - y * y).sqrt();
    DVec3::new(around * cosine, y, around * sine)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshes;

    #[test]
    fn every_mesh_has_its_lights_and_all_are_good() {
        let meshes = meshes::tiny();
        let mut with_cascades = 0;
        for mesh in &meshes {
            let lights = lights(mesh);
            assert_eq!(lights.len(), LIGHTS_PER_MESH, "{}", mesh.name);
            for light in lights {
                assert_eq!(light.validate(), Ok(()), "{}: {light:?}", mesh.name);
            }
            assert_eq!(lamps(mesh).len(), 2, "{}", mesh.name);
            with_cascades += usize::from(cascades(mesh).len() == 4);
        }
        // Where numbers are tiny or huge there are none.
        assert!(with_cascades > meshes.len() / 2, "{with_cascades} of {}", meshes.len());
    }
}
