//! The light in a caster's object space: the input of the exact facing test.

use glam::{DMat3, DMat4, DVec3, DVec4};

use super::power_of_two::exponent_of;

/// Columns that span less than this share of the box that they could span are in one plane but for rounding.
const FLAT: f64 = 1e-12;

/// One light in the object space of one caster.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ObjectLight {
    /// Bits of x, y, z, w as `f32`, rounded once; w is 0 or 1. Zeros where `singular`.
    pub bits: [u32; 4],
    /// The caster's matrix mirrors: its determinant is negative.
    pub mirrored: bool,
    /// The light has no place in object space: the matrix is not affine, is not finite or flattens space, or the
    /// light is there so far away that `f32` cannot say where. Such a caster casts nothing, and is counted.
    pub singular: bool,
}

impl ObjectLight {
    const SINGULAR: Self = Self { bits: [0; 4], mirrored: false, singular: true };
}

/// The way from the world to the object space of a caster.
#[derive(Clone, Copy, Debug)]
pub(super) struct ObjectSpace {
    /// Without the translation.
    pub object_from_world: DMat3,
    /// Where the object space's origin is.
    pub origin_world: DVec3,
    /// The caster's matrix mirrors.
    pub mirrored: bool,
}

impl ObjectSpace {
    /// `None` where the matrix is not affine, is not finite or flattens space.
    pub fn new(world_from_object: &DMat4) -> Option<Self> {
        let is_affine = world_from_object.row(3) == DVec4::W && world_from_object.is_finite();
        let linear = DMat3::from_mat4(*world_from_object);
        let determinant = linear.determinant();
        let box_volume = linear.x_axis.length() * linear.y_axis.length() * linear.z_axis.length();
        if !(is_affine && determinant.abs() > FLAT * box_volume) {
            return None;
        }
        let object_from_world = linear.try_inverse()?;
        let origin_world = world_from_object.w_axis.truncate();
        Some(Self { object_from_world, origin_world, mirrored: determinant < 0.0 })
    }
}

/// Brings a homogeneous light (w is 0 or 1) to object space through the inverse of the caster's matrix.
///
/// A direction keeps its length unless `f32` cannot hold it; then it is multiplied by a power of two.
pub fn object_light(light_world: DVec4, world_from_object: &DMat4) -> ObjectLight {
    let Some(ObjectSpace { object_from_world, origin_world, mirrored }) = ObjectSpace::new(world_from_object) else {
        return ObjectLight::SINGULAR;
    };
    // Through the linear part alone: a point goes from the object's origin, so a mere translation is exact.
    let light = object_from_world * (light_world.truncate() - origin_world * light_world.w);
    let rounded = if light_world.w == 0.0 { round_direction(light) } else { light }.as_vec3();
    if !rounded.is_finite() {
        return ObjectLight::SINGULAR;
    }
    let bits = rounded.extend(light_world.w as f32).to_array().map(f32::to_bits);
    ObjectLight { bits, mirrored, singular: false }
}

/// A direction that `f32` can hold: as it is where that overflows nowhere and loses no bits to small numbers, else
/// its largest component is brought into 1..2 by a power of two.
fn round_direction(direction: DVec3) -> DVec3 {
    let fits = direction.to_array().into_iter().all(|value| {
        let rounded = value as f32;
        rounded.is_normal() || f64::from(rounded) == value
    });
    if fits { direction } else { direction * exact_recip_size(direction) }
}

/// The power of two that brings the largest component into 1..2; 1 for a zero vector.
fn exact_recip_size(direction: DVec3) -> f64 {
    let largest = direction.abs().max_element();
    if largest > 0.0 && largest.is_finite() {
        // Clamped, so that the power itself is a normal number.
        2.0_f64.powi(-exponent_of(largest).clamp(-1022, 1022))
    } else {
        1.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DQuat;

    fn values(light: ObjectLight) -> [f32; 4] {
        light.bits.map(f32::from_bits)
    }

    /// Numbers of many sizes, from a small generator of Lehmer's kind.
    fn numbers() -> impl Iterator<Item = f32> {
        let mut state = 12_345_u64;
        core::iter::repeat_with(move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            f32::from_bits((state >> 32) as u32)
        })
        .filter(|value| value.is_finite())
    }

    #[test]
    fn identity_keeps_every_bit() {
        let mut numbers = numbers();
        for _ in 0..10_000 {
            let input = core::array::from_fn(|_| numbers.next().expect("endless"));
            for w in [0.0, 1.0] {
                let light = DVec3::from_array(input.map(f64::from)).extend(w);
                let found = object_light(light, &DMat4::IDENTITY);
                assert_eq!(found.bits[..3], input.map(f32::to_bits), "{light}");
                assert_eq!(values(found)[3], w as f32);
                assert!(!found.mirrored && !found.singular);
            }
        }
    }

    #[test]
    fn translations_and_powers_of_two_are_exact() {
        let matrix = DMat4::from_translation(DVec3::new(1.0, 2.0, 3.0)) * DMat4::from_scale(DVec3::splat(4.0));
        assert_eq!(values(object_light(DVec4::new(5.0, 2.0, 1.0, 1.0), &matrix)), [1.0, 0.0, -0.5, 1.0]);
        assert_eq!(values(object_light(DVec4::new(4.0, 0.0, 1.0, 0.0), &matrix)), [1.0, 0.0, 0.25, 0.0]);
    }

    #[test]
    fn matrices_are_undone() {
        let rotation = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -1.0).normalize(), 0.7);
        for scale in [DVec3::ONE, DVec3::new(0.1, 3.0, 20.0), DVec3::splat(1e-6)] {
            let matrix = DMat4::from_scale_rotation_translation(scale, rotation, DVec3::new(5.0, -3.0, 0.5));
            for object in [DVec4::new(1.0, 2.0, 3.0, 1.0), DVec4::new(0.5, -1.0, 2.0, 0.0)] {
                let found = object_light(matrix * object, &matrix);
                let error = DVec4::from_array(values(found).map(f64::from)) - object;
                assert!(error.abs().max_element() < 1e-6, "{scale} {object} {error}");
                assert!(!found.mirrored && !found.singular);
            }
        }
    }

    #[test]
    fn mirrors_are_told_apart() {
        let light = DVec4::new(1.0, 2.0, 3.0, 1.0);
        let one = object_light(light, &DMat4::from_scale(DVec3::new(-1.0, 1.0, 1.0)));
        assert!(one.mirrored && values(one) == [-1.0, 2.0, 3.0, 1.0]);
        let two = object_light(light, &DMat4::from_scale(DVec3::new(-1.0, -1.0, 1.0)));
        assert!(!two.mirrored);
    }

    #[test]
    fn singular_matrices_cast_nothing() {
        let axis = DVec3::new(1.0, 2.0, -1.0).normalize();
        let rotation = DMat4::from_quat(DQuat::from_axis_angle(axis, 0.3));
        let flat = DMat4::from_scale(DVec3::new(1.0, 0.0, 1.0));
        let mut projective = DMat4::IDENTITY;
        projective.z_axis.w = 1.0;
        let nan = DMat4::from_translation(DVec3::new(f64::NAN, 0.0, 0.0));
        for matrix in [DMat4::ZERO, flat, flat * rotation, rotation * flat, rotation * flat * rotation, projective, nan]
        {
            for light in [DVec4::new(1.0, 2.0, 3.0, 1.0), DVec4::new(1.0, 2.0, 3.0, 0.0)] {
                assert_eq!(object_light(light, &matrix), ObjectLight::SINGULAR, "{matrix}");
            }
        }
    }

    #[test]
    fn directions_neither_overflow_nor_vanish() {
        let tiny = DMat4::from_scale(DVec3::splat(1e-60));
        let huge = DMat4::from_scale(DVec3::splat(1e60));
        for matrix in [tiny, huge] {
            let found = object_light(DVec4::new(3.0, -4.0, 0.0, 0.0), &matrix);
            let [x, y, z, w] = values(found);
            assert!(!found.singular && z == 0.0 && w == 0.0);
            assert!((1.0..2.0).contains(&y.abs()) && (x / y + 0.75).abs() < 1e-6, "{x} {y}");
        }
        let small = DVec4::new(1e-300, 1e-310, 0.0, 0.0);
        let [x, y, ..] = values(object_light(small, &DMat4::IDENTITY));
        assert!((1.0..2.0).contains(&x) && (f64::from(y / x) - 1e-10).abs() < 1e-15);
    }

    #[test]
    fn a_point_too_far_for_f32_casts_nothing() {
        let tiny = DMat4::from_scale(DVec3::splat(1e-60));
        assert!(object_light(DVec4::new(1.0, 0.0, 0.0, 1.0), &tiny).singular);
    }
}
