//! What one caster needs to know of one light view.

use contrejour_layout::CasterLight;
use glam::{DMat4, DVec3};

use super::power_of_two::exponent_of;
use super::{View, object_light};

/// The light and the matrix of `view` for a caster whose positions are multiplied by `position_scale` (a power of
/// two) before the matrix.
///
/// `casts` is 0 where the caster's matrix is singular. Where `f32` can't hold its clip space, the matrix is zero: its
/// silhouette is found, its outline projects to a point.
pub fn caster_light(view: &View, world_from_object: &DMat4, position_scale: f32) -> CasterLight {
    let light = object_light(view.light_world, world_from_object);
    // The scale is undone before the one rounding to f32.
    let object_from_scaled = DMat4::from_scale(DVec3::splat(f64::from(position_scale).recip()));
    let light_clip_from_object = (view.light_clip_from_world * *world_from_object * object_from_scaled).as_mat4();
    let has_image = !light.singular && light_clip_from_object.is_finite();
    CasterLight {
        light_object: light.bits,
        light_clip_from_object: if has_image { light_clip_from_object.to_cols_array() } else { [0.0; 16] },
        mirrored: light.mirrored.into(),
        casts: (!light.singular).into(),
        unused_0: 0,
        unused_1: 0,
    }
}

/// A power of two that brings the largest coordinate of a box into 1..2, so that matrix products stay in range.
///
/// It is itself a normal float, so coordinates beyond 2^127 end in 2..4 and ones below 2^-127 end below 1. 1 for a
/// box of zeros.
pub fn position_scale(bounds_min: [f32; 3], bounds_max: [f32; 3]) -> f32 {
    let largest = bounds_min.into_iter().chain(bounds_max).map(f32::abs).fold(0.0, f32::max);
    if largest > 0.0 {
        // Exact also for f32's subnormals, which are normal as f64.
        let exponent = exponent_of(largest.into());
        2.0_f32.powi(-exponent.clamp(-127, 126))
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{Light, LightKind, views};
    use glam::{DQuat, DVec4, Mat4, Vec4};

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
            let record = caster_light(&view, &world_from_object, scale);
            assert_eq!((record.casts, record.mirrored), (1, 0));
            let scaled: Vec4 = (point * f64::from(scale)).as_vec3().extend(1.0);
            let clip = (Mat4::from_cols_array(&record.light_clip_from_object) * scaled).as_dvec4();
            assert!((clip - expected).abs().max_element() < 1e-5, "{clip} {expected}");
        }
    }

    #[test]
    fn a_singular_caster_casts_nothing() {
        let record = caster_light(&view(), &DMat4::from_scale(DVec3::new(1.0, 0.0, 1.0)), 1.0);
        assert_eq!(record, CasterLight::default());
    }

    #[test]
    fn a_clip_space_beyond_f32_keeps_the_light_and_has_no_image() {
        let record = caster_light(&view(), &DMat4::from_scale(DVec3::splat(1e30)), 2.0_f32.powi(-100));
        assert_eq!((record.casts, record.light_clip_from_object), (1, [0.0; 16]));
        assert_eq!(f32::from_bits(record.light_object[3]), 1.0);
    }

    #[test]
    fn mirrors_reach_the_record() {
        let record = caster_light(&view(), &DMat4::from_scale(DVec3::new(1.0, -1.0, 1.0)), 1.0);
        assert_eq!((record.casts, record.mirrored), (1, 1));
        assert_eq!(record.light_object.map(f32::from_bits), [0.0, -8.0, 2.0, 1.0]);
    }

    #[test]
    fn position_scale_is_a_normal_power_of_two() {
        let subnormal = f32::from_bits(1);
        for largest in [0.75, 1.0, 1.99, 2.0, 1e-30, 1e30, f32::MAX, f32::MIN_POSITIVE, subnormal] {
            let scale = position_scale([-largest, 0.0, 0.0], [largest / 2.0; 3]);
            assert!(scale.is_normal() && scale.to_bits() & 0x7f_ffff == 0, "{largest}: {scale}");
            let scaled = f64::from(largest) * f64::from(scale);
            assert!(scaled < 4.0, "{largest}: {scaled}");
            assert!(scaled >= 1.0 || largest < f32::MIN_POSITIVE, "{largest}: {scaled}");
        }
        assert_eq!(position_scale([0.0; 3], [0.0; 3]), 1.0);
        assert_eq!(position_scale([-3.0, 0.0, 0.0], [1.0; 3]), 0.5);
    }

    #[test]
    fn the_view_light_is_the_records_light() {
        let view = view();
        assert_eq!(view.light_world, DVec4::new(0.0, 8.0, 2.0, 1.0));
        let record = caster_light(&view, &DMat4::IDENTITY, 1.0);
        assert_eq!(record.light_object.map(f32::from_bits), [0.0, 8.0, 2.0, 1.0]);
    }
}
