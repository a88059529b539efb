//! What one caster needs to know of one light view.

use contrejour_layout::CasterLight;
use glam::{DMat4, DVec3, Mat4};

use super::power_of_two::exponent_of;
use super::{View, object_light};

/// What the stage `place_casters` makes of a view for a caster that it sees, whose positions are brought near 1 before the
/// matrix.
///
/// `casts` is 0 where the caster's matrix is singular. Where `f32` can't hold its clip space, because it is too large or
/// so small that devices may flush it to zero, the matrix is zero: its silhouette is found, its outline projects to a
/// point.
pub fn caster_light(view: &View, world_from_object: &DMat4, near_one: &NearOne) -> CasterLight {
    let light = object_light(view.light_world, world_from_object);
    // Origin and scale are undone before the one rounding to f32.
    let world_from_scaled = *world_from_object * near_one.object_from_scaled();
    let light_clip_from_object = (view.light_clip_from_world * world_from_scaled).as_mat4();
    let has_image = !light.singular && is_held(&light_clip_from_object);
    CasterLight {
        light_object: light.bits,
        light_clip_from_object: if has_image { light_clip_from_object.to_cols_array() } else { [0.0; 16] },
        mirrored: light.mirrored.into(),
        casts: (!light.singular).into(),
        unused_0: 0,
        unused_1: 0,
    }
}

/// Whether a clip space is finite, and its image so far above the smallest normal number, 2^-126, that some 16 bits of it
/// are left on devices that flush what is below.
fn is_held(light_clip_from_object: &Mat4) -> bool {
    const LEAST_IMAGE: f32 = f32::MIN_POSITIVE * 65_536.0;
    let [x, y, z, _] = light_clip_from_object.to_cols_array_2d();
    let largest =
        [x, y, z].iter().flat_map(|axis| &axis[..2]).fold(0.0, |largest: f32, entry| largest.max(entry.abs()));
    light_clip_from_object.is_finite() && largest >= LEAST_IMAGE
}

/// How positions are brought near 1 before they are projected: `(position - origin) * scale`, which is exact but for
/// coordinates far below the largest one. Facing never uses it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NearOne {
    /// Subtracted first: zeros, but for coordinates that a box holds to few digits because it is far from zero.
    pub origin: [f32; 3],
    /// A normal power of two.
    pub scale: f32,
}

impl NearOne {
    /// Leaves positions as they are.
    pub const IDENTITY: Self = Self { origin: [0.0; 3], scale: 1.0 };

    /// Undoes it.
    pub(super) fn object_from_scaled(&self) -> DMat4 {
        DMat4::from_translation(DVec3::from(self.origin.map(f64::from)))
            * DMat4::from_scale(DVec3::splat(f64::from(self.scale).recip()))
    }

    /// For a box of positions. Its largest coordinate ends in 1..2; beyond 2^127 in 2..4 and below 2^-127 below 1, since
    /// the scale is itself a normal float.
    pub fn of_box(min: [f32; 3], max: [f32; 3]) -> Self {
        let halves = [0, 1, 2].map(|axis| (0.5 * min[axis], 0.5 * max[axis]));
        let half_size = halves.iter().map(|(min, max)| max - min).fold(0.0, f32::max);
        // Beyond twice the half size, numbers of the box are within a factor of two of its middle, so their differences
        // from it are exact (Sterbenz 1974).
        let origin =
            halves.map(|(min, max)| min + max).map(|middle| if middle.abs() > 2.0 * half_size { middle } else { 0.0 });
        let ends = [min, max].map(|end| [0, 1, 2].map(|axis| (end[axis] - origin[axis]).abs()));
        let largest = ends.into_iter().flatten().fold(0.0, f32::max);
        let scale = if largest > 0.0 {
            // Exact also for f32's subnormals, which are normal as f64.
            2.0_f32.powi(-exponent_of(largest.into()).clamp(-127, 126))
        } else {
            1.0
        };
        Self { origin, scale }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Light, LightKind, views};
    use glam::{DQuat, DVec4, Vec3, Vec4};

    fn view() -> View {
        let kind = LightKind::Spot {
            position: DVec3::new(0.0, 8.0, 2.0),
            target: DVec3::ZERO,
            cone_angle: 1.0,
            radius: 0.1,
            near: 0.5,
            far: 20.0,
        };
        views(&Light { kind, color: [1.0; 3] }).expect("a good spot")[0]
    }

    #[test]
    fn scaled_positions_land_where_unscaled_ones_do() {
        let view = view();
        let rotation = DQuat::from_rotation_x(0.4);
        let world_from_object =
            DMat4::from_scale_rotation_translation(DVec3::splat(0.001), rotation, DVec3::new(0.5, 0.0, 0.2));
        let point = DVec3::new(700.0, -300.0, 150.0);
        let expected = view.light_clip_from_world * world_from_object * point.extend(1.0);
        for scale in [1.0, 2.0_f32.powi(-9), 2.0_f32.powi(20)] {
            let record = caster_light(&view, &world_from_object, &NearOne { scale, ..NearOne::IDENTITY });
            assert_eq!((record.casts, record.mirrored), (1, 0));
            let scaled: Vec4 = (point * f64::from(scale)).as_vec3().extend(1.0);
            let clip = (Mat4::from_cols_array(&record.light_clip_from_object) * scaled).as_dvec4();
            assert!((clip - expected).abs().max_element() < 1e-5, "{clip} {expected}");
        }
    }

    #[test]
    fn a_singular_caster_casts_nothing() {
        let record = caster_light(&view(), &DMat4::from_scale(DVec3::new(1.0, 0.0, 1.0)), &NearOne::IDENTITY);
        assert_eq!(record, CasterLight::default());
    }

    #[test]
    fn a_clip_space_beyond_f32_keeps_the_light_and_has_no_image() {
        let small = NearOne { scale: 2.0_f32.powi(-100), ..NearOne::IDENTITY };
        let record = caster_light(&view(), &DMat4::from_scale(DVec3::splat(1e30)), &small);
        assert_eq!((record.casts, record.light_clip_from_object), (1, [0.0; 16]));
        assert_eq!(f32::from_bits(record.light_object[3]), 1.0);
    }

    #[test]
    fn a_clip_space_that_devices_may_flush_has_no_image() {
        for (size, has_image) in [(1e-30, true), (1e-36, false), (1e-44, false)] {
            let record = caster_light(&view(), &DMat4::from_scale(DVec3::splat(size)), &NearOne::IDENTITY);
            assert_eq!(record.light_clip_from_object != [0.0; 16], has_image, "{size}");
        }
    }

    #[test]
    fn mirrors_reach_the_record() {
        let record = caster_light(&view(), &DMat4::from_scale(DVec3::new(1.0, -1.0, 1.0)), &NearOne::IDENTITY);
        assert_eq!((record.casts, record.mirrored), (1, 1));
        assert_eq!(record.light_object.map(f32::from_bits), [0.0, -8.0, 2.0, 1.0]);
    }

    #[test]
    fn scales_are_normal_powers_of_two() {
        let subnormal = f32::from_bits(1);
        for largest in [0.75, 1.0, 1.99, 2.0, 1e-30, 1e30, f32::MAX, f32::MIN_POSITIVE, subnormal] {
            let NearOne { origin, scale } = NearOne::of_box([-largest, 0.0, 0.0], [largest / 2.0; 3]);
            assert_eq!(origin, [0.0; 3]);
            assert!(scale.is_normal() && scale.to_bits() & 0x7f_ffff == 0, "{largest}: {scale}");
            let scaled = f64::from(largest) * f64::from(scale);
            assert!(scaled < 4.0, "{largest}: {scaled}");
            assert!(scaled >= 1.0 || largest < f32::MIN_POSITIVE, "{largest}: {scaled}");
        }
        assert_eq!(NearOne::of_box([0.0; 3], [0.0; 3]), NearOne::IDENTITY);
        assert_eq!(NearOne::of_box([-3.0, 0.0, 0.0], [1.0; 3]).scale, 0.5);
    }

    #[test]
    fn positions_far_from_zero_keep_their_digits() {
        let [min, max] = [[1e6, -1.25, 3e5], [1e6 + 2.5, 1.0, 3e5 + 2.0]];
        let near_one = NearOne::of_box(min, max);
        assert_eq!((near_one.origin, near_one.scale), ([1e6 + 1.25, 0.0, 3e5 + 1.0], 1.0));
        let world_from_object = DMat4::from_translation(DVec3::new(-1e6, 0.0, -3e5));
        let record = caster_light(&view(), &world_from_object, &near_one);
        let corner = Vec3::from(max) - Vec3::from(near_one.origin);
        let clip = Mat4::from_cols_array(&record.light_clip_from_object) * corner.extend(1.0);
        let expected = view().light_clip_from_world * DVec4::new(2.5, 1.0, 2.0, 1.0);
        assert!((clip.as_dvec4() - expected).abs().max_element() < 1e-6, "{clip} {expected}");
        // Without an origin the matrix holds numbers of a million, and few digits of the corner are left.
        let scale = 2.0_f32.powi(-19);
        let record = caster_light(&view(), &world_from_object, &NearOne { scale, ..NearOne::IDENTITY });
        let clip = Mat4::from_cols_array(&record.light_clip_from_object) * (scale * Vec3::from(max)).extend(1.0);
        assert!((clip.as_dvec4() - expected).abs().max_element() > 1e-2, "{clip} {expected}");
    }

    #[test]
    fn near_zero_nothing_is_subtracted() {
        for (min, max) in [([1.0; 3], [3.0; 3]), ([-5.0, 0.5, -5.0], [5.0, 0.5, 5.0]), ([f32::MIN; 3], [f32::MAX; 3])] {
            assert_eq!(NearOne::of_box(min, max).origin, [0.0; 3]);
        }
    }

    #[test]
    fn the_view_light_is_the_records_light() {
        let view = view();
        assert_eq!(view.light_world, DVec4::new(0.0, 8.0, 2.0, 1.0));
        let record = caster_light(&view, &DMat4::IDENTITY, &NearOne::IDENTITY);
        assert_eq!(record.light_object.map(f32::from_bits), [0.0, 8.0, 2.0, 1.0]);
    }
}
