//! As many lights as one likes around given faces: anywhere, and where facing is hardest.

use glam::DVec3;

use crate::object_light::ObjectLight;
use crate::random::Random;

/// Three positions of a face.
pub type Corners = [[f32; 3]; 3];

/// Points inside, around and far away from the faces, and directions; every second one for mirrored casters.
pub fn random_lights(faces: &[Corners], count: usize, random: &mut Random) -> Vec<ObjectLight> {
    let (middle, radius) = middle_and_radius(faces);
    let light = |index: usize| {
        let vector = DVec3::from([(); 3].map(|()| random.signed()));
        let is_point = random.below(3) > 0;
        let place = if is_point { middle + radius * 10.0_f64.powf(1.5 * random.signed()) * vector } else { vector };
        object_light(place, is_point, index)
    };
    (0..count).map(light).collect()
}

/// Lights on the plane of a face, on the line of an edge, on a vertex, and along axes, rounded to `f32`; half of them
/// then some steps of the last place away.
pub fn adversarial_lights(faces: &[Corners], count: usize, random: &mut Random) -> Vec<ObjectLight> {
    let (middle, radius) = middle_and_radius(faces);
    let light = |index: usize| {
        let face = if faces.is_empty() { UNIT_FACE } else { faces[random.below(faces.len())] };
        let (place, is_point) = hard_place(face, middle, radius, index / 2, random);
        let light = object_light(place, is_point, index);
        // Kinds and distances take turns apart from each other.
        if (index / 2 / KINDS).is_multiple_of(2) { light } else { nudged(light, random) }
    };
    (0..count).map(light).collect()
}

/// For meshes without faces.
const UNIT_FACE: Corners = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

const KINDS: usize = 8;

fn hard_place(face: Corners, middle: DVec3, radius: f64, kind: usize, random: &mut Random) -> (DVec3, bool) {
    let turn = random.below(3);
    let [a, b, c] = [0, 1, 2].map(|corner| DVec3::from(face[(corner + turn) % 3].map(f64::from)));
    let (along, across) = (share(random), share(random));
    let axis = DVec3::AXES[random.below(3)];
    let sign = if random.below(2) == 0 { 1.0 } else { -1.0 };
    match kind % KINDS {
        0 | 1 => (a + along * (b - a) + across * (c - a), true),
        2 => (along * (b - a) + across * (c - a), false),
        3 => (a + along * (b - a), true),
        4 => (sign * (b - a), false),
        5 => (a, true),
        6 => (sign * axis, false),
        // In one or two of the planes through a corner that the axes are normal to.
        _ => {
            let free = if random.below(2) == 0 { axis } else { DVec3::ONE - axis };
            let [x, y, z] = [(); 3].map(|()| random.signed());
            (a + free * (middle - a + 2.0 * radius * DVec3::new(x, y, z)), true)
        }
    }
}

/// How far along an edge: a small multiple that is exact in binary, anything near, or anything far.
fn share(random: &mut Random) -> f64 {
    match random.below(4) {
        0 => random.below(9) as f64 / 2.0 - 2.0,
        1 => 1000.0 * random.signed(),
        _ => 3.0 * random.signed(),
    }
}

fn object_light(place: DVec3, is_point: bool, index: usize) -> ObjectLight {
    let place = place.as_vec3();
    let is_good = place.is_finite() && (is_point || place != glam::Vec3::ZERO);
    let w = if is_point || !is_good { 1.0 } else { 0.0 };
    let place = if is_good { place } else { glam::Vec3::ZERO };
    ObjectLight { light_object: place.extend(w).to_array(), mirrored: index % 2 == 1 }
}

/// Up to three steps of the last place away on each axis.
fn nudged(light: ObjectLight, random: &mut Random) -> ObjectLight {
    let [x, y, z, w] = light.light_object;
    let nudge = |coordinate: f32| {
        let steps = random.below(7) as i32 - 3;
        let nudged = f32::from_bits(coordinate.to_bits().saturating_add_signed(steps));
        if nudged.is_finite() { nudged } else { coordinate }
    };
    let [x, y, z] = [x, y, z].map(nudge);
    if w == 0.0 && [x, y, z] == [0.0; 3] { light } else { ObjectLight { light_object: [x, y, z, w], ..light } }
}

/// Middle and half the diagonal of the box around the faces.
fn middle_and_radius(faces: &[Corners]) -> (DVec3, f64) {
    let corners = faces.as_flattened().iter().map(|corner| DVec3::from(corner.map(f64::from)));
    match corners.map(|corner| (corner, corner)).reduce(|p, q| (p.0.min(q.0), p.1.max(q.1))) {
        None => (DVec3::ZERO, 1.0),
        Some((min, max)) => ((min + max) / 2.0, (max - min).length() / 2.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::meshes::{TestMesh, tiny};
    use contrejour_oracle::{ManyLights, OracleTopology};

    fn faces(mesh: &TestMesh) -> Vec<Corners> {
        let part = &mesh.parts[0];
        ManyLights::new(&OracleTopology::new(&part.topology.positions, &part.triangles)).corners().to_vec()
    }

    #[test]
    fn every_light_keeps_its_bits_on_the_way_to_object_space() {
        for mesh in tiny() {
            let (faces, mut random) = (faces(&mesh), Random::new(1));
            let lights = random_lights(&faces, 60, &mut random);
            for light in lights.into_iter().chain(adversarial_lights(&faces, 60, &mut random)) {
                light.check_bits().unwrap_or_else(|error| panic!("{}: {error}", mesh.name));
            }
        }
    }

    #[test]
    fn lights_on_a_face_s_plane_are_hard_for_floats() {
        let wrong = |lights: &[ObjectLight]| {
            let face = [[0.1, 0.7, 0.3], [0.9, 0.2, 0.4], [0.3, 0.4, 0.8]];
            let is_wrong = |light: &&ObjectLight| {
                let exact = contrejour_oracle::lit(face[0], face[1], face[2], light.light_object, light.mirrored);
                crate::exhaust::is_lit_by_floats(&face, light) != exact
            };
            lights.iter().filter(is_wrong).count()
        };
        let face = [[[0.1, 0.7, 0.3], [0.9, 0.2, 0.4], [0.3, 0.4, 0.8]]];
        assert!(wrong(&adversarial_lights(&face, 400, &mut Random::new(1))) > 20);
        assert!(wrong(&random_lights(&face, 400, &mut Random::new(1))) < 5);
    }
}
