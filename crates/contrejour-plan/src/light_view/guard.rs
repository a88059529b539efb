//! How much of its neighbours a view must see.

use core::f64::consts::SQRT_2;

use super::LightOutline;
use super::records::MIN_WIDTH_TEXELS;
use crate::{Light, LightKind, ShadowSettings, SmoothieWidth, Technique, VarianceSoftness};

/// The widest guard band: half of the map's half side. A wider one would leave too few texels to what is looked at;
/// soft edges that are wider still are cut where they cross a border.
pub const MAX_GUARD_NDC: f64 = 0.5;

/// Texels for the four nearest ones and for rounding.
const NEAREST_TEXELS: f64 = 2.0;

/// The pyramid's Gaussian has a visible part up to so many times the radius of the disk that it stands for.
const BLUR_REACH: f64 = 2.0;

/// Width of the guard band that the views of a light need, so that soft edges and filters miss nothing where one view
/// ends and its neighbour begins. Unit: NDC of the widened view. Range: 0 to [`MAX_GUARD_NDC`].
///
/// It holds the widest smoothie, or the widest filter, that the technique can have with the light's size, and
/// the texels by which look-ups reach beyond their place. 0 for lights of a single view, and for cascades, which have a
/// guard band of their own in [`cascade_views`](crate::cascade_views).
pub fn guard_ndc(light: &Light, settings: &ShadowSettings) -> f64 {
    match light.kind {
        // The penumbra of a caster at the nearest depth on a receiver infinitely far away, R / (near tan(fov / 2)): the
        // guard makes near and the tangent's inverse smaller alike.
        LightKind::Point { radius, near, .. } => guard_of_size(radius / near, LightOutline::Sphere, settings),
        LightKind::Spot { .. } | LightKind::Directional { .. } | LightKind::Cascaded { .. } => 0.0,
    }
}

/// The guard band where a disk makes half penumbras of up to `penumbra_ndc`.
pub(super) fn guard_of_size(penumbra_ndc: f64, outline: LightOutline, settings: &ShadowSettings) -> f64 {
    let mut texels = NEAREST_TEXELS;
    let mut reach_ndc = 0.0;
    match &settings.technique {
        Technique::ShadowMap | Technique::Pcf => {}
        // The kernel's middle is anywhere on a texel.
        Technique::GaussianPcf(gaussian) => texels += 0.5 * f64::from(gaussian.kernel.texels()),
        Technique::BicubicPcf => texels += 1.0,
        Technique::Pcss(_) => reach_ndc = penumbra_ndc,
        Technique::Variance(variance) => match variance.softness {
            VarianceSoftness::Texels(blur) => texels += BLUR_REACH * f64::from(blur),
            VarianceSoftness::FromLightSize { .. } => reach_ndc = BLUR_REACH * penumbra_ndc,
        },
        Technique::Smoothies(smoothies) => {
            let width = match smoothies.width {
                SmoothieWidth::Ndc(width) => width.into(),
                SmoothieWidth::FromLightSize => penumbra_ndc,
            };
            let least = MIN_WIDTH_TEXELS * 2.0 / f64::from(settings.map_size);
            reach_ndc = width.min(smoothies.width_max_ndc.into()).max(least);
        }
        Technique::SilhouetteMap(silhouettes) => {
            let least = f64::from(silhouettes.least_reach_texels()) * 2.0 / f64::from(settings.map_size);
            reach_ndc = penumbra_ndc.min(silhouettes.width_max_ndc.into()).max(least);
        }
    }
    if outline == LightOutline::Sphere {
        reach_ndc = sphere_reach_ndc(reach_ndc);
    }
    // The normal offset moves a look-up by so many footprints, each of which spans sqrt(2) texels at most where the
    // view is seen at 45 degrees; the depth that it changes moves it by as much again.
    texels += 2.0 * SQRT_2 * f64::from(settings.bias.normal_texels);
    (reach_ndc + texels * 2.0 / f64::from(settings.map_size)).min(MAX_GUARD_NDC)
}

/// How wide soft edges get on the map of a face with as wide a guard band, where a disk's are `width_ndc` wide.
///
/// Where an edge's image passes the middle at the distance d, in units of depth 1, a sphere's are sqrt(1 + d^2) times
/// as wide: sqrt(3) / (1 - g) times at most in the corners of a map with the guard g. So g (1 - g) is sqrt(3) times the
/// width, up to g = 1 / 2.
fn sphere_reach_ndc(width_ndc: f64) -> f64 {
    let squared = 1.0 - 4.0 * 3.0_f64.sqrt() * width_ndc;
    if squared > 0.0 { 0.5 * (1.0 - squared.sqrt()) } else { MAX_GUARD_NDC }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{SmoothieSettings, VarianceSettings, View, ViewCounts, views_with_guard};
    use glam::{DVec2, DVec3};

    fn lamp(radius: f64) -> Light {
        let kind = LightKind::Point { position: DVec3::ZERO, radius, near: 1.0, far: 20.0 };
        Light { kind, color: [1.0; 3] }
    }

    fn settings(technique: Technique) -> ShadowSettings {
        ShadowSettings { technique, map_size: 1024, ..ShadowSettings::default() }
    }

    /// Of edges whose image crosses a map.
    fn widest_on_map(view: &View, smoothies: &SmoothieSettings) -> f64 {
        let counts = ViewCounts::default();
        let record = view.light_view(&settings(Technique::Smoothies(*smoothies)), &counts);
        let q = view.q_of_depth(view.near_depth) as f32;
        let width = record.width_per_q_ndc * (record.q_max - q);
        let width = width.clamp(record.width_min_ndc, record.width_max_ndc);
        f64::from(width) * view.rim_offset(DVec2::ONE, DVec2::ONE.normalize()).length()
    }

    #[test]
    fn the_widest_smoothie_fits_with_texels_to_spare() {
        for radius in [0.0, 0.02, 0.05, 0.1] {
            for width in [SmoothieWidth::FromLightSize, SmoothieWidth::Ndc(0.08)] {
                let smoothies = SmoothieSettings { width, ..SmoothieSettings::DEFAULT };
                let guard = guard_ndc(&lamp(radius), &settings(Technique::Smoothies(smoothies)));
                for view in views_with_guard(&lamp(radius), guard).expect("a good lamp") {
                    let room_texels = (guard - widest_on_map(&view, &smoothies)) * 512.0;
                    assert!((1.0..40.0).contains(&room_texels), "{radius}, {width:?}: {room_texels}");
                }
            }
        }
    }

    #[test]
    fn guards_follow_the_technique_and_end() {
        let of = |technique, radius| guard_ndc(&lamp(radius), &settings(technique));
        assert_eq!(of(Technique::Pcf, 0.0), of(Technique::Pcf, 0.3), "the light's size does not matter");
        assert!(of(Technique::BicubicPcf, 0.0) > of(Technique::ShadowMap, 0.0));
        let wide = VarianceSettings { softness: VarianceSoftness::Texels(16.0), ..VarianceSettings::VSM };
        assert!(of(Technique::Variance(wide), 0.0) > of(Technique::Variance(VarianceSettings::VSM), 0.0));
        assert!(of(Technique::Variance(VarianceSettings::VSM_PCSS), 0.1) > 0.2);
        assert_eq!(of(Technique::Smoothies(SmoothieSettings::DEFAULT), 40.0), MAX_GUARD_NDC);
        let tiny = ShadowSettings { map_size: 1, ..ShadowSettings::default() };
        assert_eq!(guard_ndc(&lamp(0.0), &tiny), MAX_GUARD_NDC);
    }
}
