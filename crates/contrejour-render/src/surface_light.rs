//! What the picture's shader needs of a light.

use core::f64::consts::PI;

use contrejour_plan::{ConeFalloff, LightKind, MIN_FALLOFF_DISTANCE};
use contrejour_scene::SceneLight;
use glam::DVec3;

use crate::LocalSpace;

/// `SurfaceLight` in `shaders/shared/surface.wgsl`, which says what the fields mean.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct SurfaceLight {
    place_local: [f32; 4],
    axis_local: [f32; 4],
    color: [f32; 4],
    falloff: [f32; 4],
}

/// A rim that is not told is soft over this part of one minus the cosine of half the cone.
const SOFT_RIM: f64 = 0.1;

/// The least distance of a light that is exposed for its target, over the distance of that.
const LEAST_DISTANCE_SHARE: f64 = 1e-3;

/// A cone that is everywhere.
const NO_CONE: ConeFalloff = ConeFalloff { scale: 0.0, offset: 1.0 };

/// How a light grows weaker, in local units.
struct Strength {
    /// Radiance of a white surface, for a colour of 1 and where the falloff is 1.
    radiance: f64,
    least_distance: f64,
}

impl SurfaceLight {
    /// The record of a light of the world. `exposure` is what a luminance of 1 cd/m^2 is in the picture.
    pub fn new(light: &SceneLight, local: &LocalSpace, exposure: f64) -> Self {
        let local_kind = local.light(&light.light).kind;
        let (place, axis, cone, distance) = match local_kind {
            LightKind::Spot { position, target, cone_angle, .. } => {
                let cone = cone(cone_angle, light.inner_cone_angle);
                (position.extend(1.0), unit(target - position), cone, position.distance(target))
            }
            LightKind::Point { position, far, .. } => (position.extend(1.0), DVec3::NEG_Y, NO_CONE, 0.5 * far),
            LightKind::Directional { towards_light, .. } | LightKind::Cascaded { towards_light, .. } => {
                let towards_light = unit(towards_light);
                (towards_light.extend(0.0), -towards_light, NO_CONE, 0.0)
            }
        };
        let is_directional = place.w == 0.0;
        let Strength { radiance, least_distance } = match light.intensity {
            // A white surface sends E / pi of an illuminance E. Candela are measured in the world's metres.
            Some(intensity) => Strength {
                radiance: intensity / PI * exposure * if is_directional { 1.0 } else { local.length(1.0).powi(2) },
                least_distance: local.length(MIN_FALLOFF_DISTANCE),
            },
            None if is_directional => Strength { radiance: 1.0, least_distance: 0.0 },
            None => {
                let least_distance = LEAST_DISTANCE_SHARE * distance;
                Strength { radiance: distance * distance + least_distance * least_distance, least_distance }
            }
        };
        let range_inverse = light.range.map_or(0.0, |range| local.length(range).recip());
        let [red, green, blue] = light.light.color;
        Self {
            place_local: place.as_vec4().to_array(),
            axis_local: axis.extend(0.0).as_vec4().to_array(),
            color: [red, green, blue, finite(radiance)],
            falloff: [range_inverse, least_distance * least_distance, cone.scale, cone.offset].map(finite),
        }
    }
}

fn cone(cone_angle: f64, inner_cone_angle: Option<f64>) -> ConeFalloff {
    let half = 0.5 * cone_angle;
    let soft_rim = || (half.cos() + SOFT_RIM * (1.0 - half.cos())).acos();
    ConeFalloff::from_angles(inner_cone_angle.map_or_else(soft_rim, |inner| 0.5 * inner), half)
}

/// The number, or the largest of 32 bits in its place: nothing is brighter than that, and nothing nearer.
fn finite(value: f64) -> f32 {
    value.min(f32::MAX.into()) as f32
}

/// A direction of any length as a unit vector; its length may not fit a square.
fn unit(direction: DVec3) -> DVec3 {
    (direction / direction.abs().max_element()).normalize_or_zero()
}

#[cfg(test)]
mod tests {
    use contrejour_plan::{Light, ShadowSettings, distance_falloff};
    use contrejour_scene::Camera;

    use super::*;

    fn spot(scale: f64) -> SceneLight {
        let kind = LightKind::Spot {
            position: DVec3::new(0.0, 3.0 * scale, 0.0),
            target: DVec3::ZERO,
            cone_angle: 1.0,
            radius: 0.0,
            near: 0.1 * scale,
            far: 10.0 * scale,
        };
        SceneLight::new(Light { kind, color: [0.5, 1.0, 2.0] }, ShadowSettings::default())
    }

    /// Local space of which one unit is `world_per_local` of the world's.
    fn local(world_per_local: f64) -> LocalSpace {
        let eye = DVec3::new(0.0, 0.0, world_per_local);
        LocalSpace::around(&Camera { eye, target: DVec3::ZERO, up: DVec3::Y, fov_y: 1.0, near: 0.1, far: 10.0 })
    }

    /// What the shader makes of a record for a white surface on the axis that faces the light.
    fn radiance(record: &SurfaceLight, distance_local: f64) -> f64 {
        let [range_inverse, least_squared, ..] = record.falloff.map(f64::from);
        f64::from(record.color[3]) * distance_falloff(distance_local, range_inverse.recip(), least_squared.sqrt())
    }

    #[test]
    fn a_white_surface_at_the_target_has_the_colour_at_any_scale() {
        for exponent in [-60, 0, 60] {
            let scale = 2f64.powi(exponent);
            let record = SurfaceLight::new(&spot(scale), &local(scale), 1.0);
            assert_eq!(record.color[..3], [0.5, 1.0, 2.0]);
            assert!((radiance(&record, 3.0) - 1.0).abs() < 1e-6, "{}", radiance(&record, 3.0));
            assert!((radiance(&record, 1.5) - 4.0).abs() < 1e-4, "{}", radiance(&record, 1.5));
        }
    }

    #[test]
    fn candela_make_lux_and_lux_luminance_whatever_the_local_space() {
        for world_per_local in [0.25, 1.0, 8.0] {
            let light = SceneLight { intensity: Some(90.0), ..spot(1.0) };
            let record = SurfaceLight::new(&light, &local(world_per_local), 0.5);
            // 90 cd at 3 m are 10 lux, of which a white surface sends 10 / pi cd/m^2.
            let found = radiance(&record, 3.0 / world_per_local);
            assert!((found / (0.5 * 10.0 / PI) - 1.0).abs() < 1e-4, "{found}");
            let ending = SceneLight { range: Some(2.9), ..light };
            assert_eq!(radiance(&SurfaceLight::new(&ending, &local(world_per_local), 0.5), 3.0 / world_per_local), 0.0);
        }
    }

    #[test]
    fn a_sun_does_not_fall_off() {
        let mut sun = spot(1.0);
        sun.light.kind = LightKind::Directional {
            towards_light: DVec3::Y,
            center: DVec3::ZERO,
            half_extent: 1.0,
            half_depth: 1.0,
            angular_radius: 0.0,
        };
        assert_eq!(SurfaceLight::new(&sun, &local(4.0), 0.5).color[3], 1.0);
        let bright = SceneLight { intensity: Some(100.0), ..sun };
        let record = SurfaceLight::new(&bright, &local(4.0), 0.5);
        assert!((f64::from(record.color[3]) - 50.0 / PI).abs() < 1e-5);
        assert_eq!((record.place_local, record.falloff[2..].to_vec()), ([0.0, 1.0, 0.0, 0.0], vec![0.0, 1.0]));
    }

    #[test]
    fn no_number_is_infinite() {
        let bright = SceneLight { intensity: Some(1e300), ..spot(1e-30) };
        let record = SurfaceLight::new(&bright, &local(1e-30), 1e9);
        assert!(bytemuck::cast_slice::<_, f32>(&[record]).iter().all(|value| value.is_finite()), "{record:?}");
    }

    #[test]
    fn a_direction_may_have_any_length() {
        assert!(unit(DVec3::new(0.0, 3e-200, 4e-200)).abs_diff_eq(DVec3::new(0.0, 0.6, 0.8), 1e-12));
    }
}
