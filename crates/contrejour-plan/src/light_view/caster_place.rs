//! Where one caster stands, for all lights.

use contrejour_layout::{CASTER_ALWAYS, CASTER_IN_VIEW, CASTER_NEVER, CasterPlace};
use glam::{DMat4, DVec3};

use super::NearOne;
use super::object_light::ObjectSpace;

/// Entries beyond this might overflow a 64-bit float where two are multiplied. 2^500.
const LARGEST_ENTRY: f64 = 3.3e150;

/// Half boxes are taken as so much larger, for what rounding to `f32` may have cut off.
const BOX_GUARD: f64 = 1.0 + 1e-6;

/// The record of a caster that stands with `world_from_object`, whose positions are brought near 1 before any matrix.
///
/// `bounds` are the smallest and the largest corner of its positions in object space; `None` where nobody knows them: then
/// it casts for every view. A singular matrix, or one with entries beyond 2^500, casts nothing.
pub fn caster_place(world_from_object: &DMat4, near_one: &NearOne, bounds: Option<[[f32; 3]; 2]>) -> CasterPlace {
    let never = CasterPlace { casts: CASTER_NEVER, ..CasterPlace::default() };
    let Some(space) = ObjectSpace::new(world_from_object) else { return never };
    let world_from_scaled = *world_from_object * near_one.object_from_scaled();
    let object_from_world = space.object_from_world.to_cols_array();
    let [x, y, z, w] = [0, 1, 2, 3].map(|column| world_from_scaled.col(column).truncate().to_array());
    let is_small = |entry: &f64| entry.abs() < LARGEST_ENTRY;
    if !object_from_world.iter().chain([x, y, z, w].as_flattened()).all(is_small) {
        return never;
    }
    let mut place = CasterPlace {
        object_from_world: object_from_world.map(words_of),
        origin_world: space.origin_world.to_array().map(words_of),
        world_from_scaled: core::array::from_fn(|index| words_of([x, y, z, w][index / 3][index % 3])),
        mirrored: space.mirrored.into(),
        casts: CASTER_ALWAYS,
        ..CasterPlace::default()
    };
    if let Some([min, max]) = bounds {
        let [min, max] = [min, max].map(|corner| {
            let corner = DVec3::from(corner.map(f64::from)) - DVec3::from(near_one.origin.map(f64::from));
            corner * f64::from(near_one.scale)
        });
        place.box_middle = ((min + max) / 2.0).as_vec3().to_array();
        place.box_half = (BOX_GUARD * (max - min) / 2.0).as_vec3().to_array();
        place.casts = CASTER_IN_VIEW;
    }
    place
}

/// The words of a 64-bit float, the low one first.
pub(super) fn words_of(number: f64) -> [u32; 2] {
    let bits = number.to_bits();
    [bits as u32, (bits >> 32) as u32]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn number([low, high]: [u32; 2]) -> f64 {
        f64::from_bits(u64::from(high) << 32 | u64::from(low))
    }

    #[test]
    fn a_place_undoes_its_matrix() {
        let matrix = DMat4::from_translation(DVec3::new(1.0, 2.0, 3.0)) * DMat4::from_scale(DVec3::new(-2.0, 4.0, 8.0));
        let near_one = NearOne { origin: [16.0, 0.0, 0.0], scale: 0.5 };
        let place = caster_place(&matrix, &near_one, None);
        assert_eq!((place.mirrored, place.casts), (1, CASTER_ALWAYS));
        assert_eq!(place.object_from_world.map(number), [-0.5, 0.0, 0.0, 0.0, 0.25, 0.0, 0.0, 0.0, 0.125]);
        assert_eq!(place.origin_world.map(number), [1.0, 2.0, 3.0]);
        let scaled = place.world_from_scaled.map(number);
        assert_eq!(scaled, [-4.0, 0.0, 0.0, 0.0, 8.0, 0.0, 0.0, 0.0, 16.0, -31.0, 2.0, 3.0]);
    }

    #[test]
    fn boxes_are_scaled_like_positions() {
        let near_one = NearOne { origin: [10.0, 0.0, 0.0], scale: 0.25 };
        let place = caster_place(&DMat4::IDENTITY, &near_one, Some([[8.0, -4.0, 0.0], [16.0, 4.0, 0.0]]));
        assert_eq!((place.box_middle, place.casts), ([0.5, 0.0, 0.0], CASTER_IN_VIEW));
        let [x, y, z] = place.box_half;
        assert!((1.0..1.00001).contains(&x) && (1.0..1.00001).contains(&y) && z == 0.0);
    }

    #[test]
    fn matrices_without_a_place_cast_nothing() {
        for matrix in
            [DMat4::ZERO, DMat4::from_scale(DVec3::new(1.0, 0.0, 1.0)), DMat4::from_scale(DVec3::splat(1e151))]
        {
            assert_eq!(caster_place(&matrix, &NearOne::IDENTITY, None), CasterPlace::default(), "{matrix}");
        }
    }
}
