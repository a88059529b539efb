//! The uniforms of a view.

use contrejour_layout::{LightView, ReceiverView, VIEW_CULLS, VIEW_PANCAKES, VIEW_TESTS};

use super::caster_place::words_of;
use super::{CastersInFront, Projection, View};
use crate::{DepthPrecision, ShadowSettings, SmoothieWidth, Technique, VarianceSoftness};

/// The smallest smoothie width: less, and the rim falls between texels.
pub(super) const MIN_WIDTH_TEXELS: f64 = 1.5;

/// Texels by which a frustum is widened for filters and for rounding.
const GUARD_TEXELS: f64 = 2.0;

/// How much there is to work on, and room for it, as a [`LightView`] tells the shaders.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct ViewCounts {
    /// Casters, also those that cast for no view.
    pub casters: u32,
    /// Blocks of faces of all casters.
    pub face_blocks: u32,
    /// Blocks of edges of all casters.
    pub edge_blocks: u32,
    /// Room in the list of undecided faces.
    pub undecided: u32,
    /// Room in the list of silhouette edges.
    pub silhouettes: u32,
    /// Room in the list of quads.
    pub quads: u32,
    /// Room in the list of corners.
    pub corners: u32,
}

/// The width of a smoothie, or of the band of a silhouette map on one side, at a blocker's q is `clamp(per_q * (q_max - q), min, max)`, in NDC.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct WidthTerms {
    per_q: f64,
    min: f64,
    max: f64,
}

impl View {
    /// What the compute stages and the raster passes of the maps need.
    pub fn light_view(&self, settings: &ShadowSettings, counts: &ViewCounts) -> LightView {
        let width = self.width_terms(settings).unwrap_or_default();
        LightView {
            perspective: self.is_perspective(),
            map_size: settings.map_size,
            face_block_count: counts.face_blocks,
            edge_block_count: counts.edge_blocks,
            undecided_capacity: counts.undecided,
            silhouette_capacity: counts.silhouettes,
            quad_capacity: counts.quads,
            corner_capacity: counts.corners,
            near_depth: self.near_depth as f32,
            far_depth: self.far_depth as f32,
            ndc_scale: self.ndc_scale() as f32,
            ndc_offset: self.ndc_offset() as f32,
            q_max: self.q_max() as f32,
            sphere_half_side: self.sphere_half_side() as f32,
            width_per_q_ndc: width.per_q as f32,
            width_min_ndc: width.min as f32,
            width_max_ndc: width.max as f32,
            bias_smoothie_texels: settings.bias.smoothie_texels,
            texel_world: self.texel_world(settings.map_size) as f32,
            depth_unit: self.depth_unit(settings),
            warp_exponent: match settings.technique {
                Technique::Variance(variance) => variance.warp_exponent,
                _ => 0.0,
            },
            caster_count: counts.casters,
            flags: VIEW_CULLS
                | VIEW_TESTS
                | if self.casters_in_front == CastersInFront::Pancaked { VIEW_PANCAKES } else { 0 },
            reach_ndc: self.reach_ndc(settings) as f32,
            light_world: rows_of(self.light_world.to_array()),
            light_clip_from_world: rows_of(self.light_clip_from_world.to_cols_array()),
        }
    }

    /// What the visibility function needs.
    pub fn receiver_view(&self, settings: &ShadowSettings) -> ReceiverView {
        let bias = &settings.bias;
        let mut record = ReceiverView {
            light_clip_from_world: self.light_clip_from_world.as_mat4().to_cols_array(),
            light_world: self.unit_light_world().as_vec4().to_array(),
            perspective: self.is_perspective(),
            map_size: settings.map_size,
            near_depth: self.near_depth as f32,
            far_depth: self.far_depth as f32,
            texel_world: self.texel_world(settings.map_size) as f32,
            bias_constant_texels: bias.constant_texels,
            bias_slope_texels: bias.slope_texels,
            bias_normal_texels: bias.normal_texels,
            depth_unit: self.depth_unit(settings),
            ndc_scale: self.ndc_scale() as f32,
            ndc_offset: self.ndc_offset() as f32,
            light_size: self.light_size as f32,
            ..ReceiverView::default()
        };
        match settings.technique {
            Technique::Pcss(pcss) => record.search_max_ndc = pcss.search_max_ndc,
            Technique::Variance(variance) => {
                match variance.softness {
                    VarianceSoftness::Texels(texels) => record.blur_texels = texels,
                    VarianceSoftness::FromLightSize { search_max_ndc } => record.search_max_ndc = search_max_ndc,
                }
                record.bleed_cut = variance.bleed_cut;
                record.min_variance = variance.min_variance;
                record.warp_exponent = variance.warp_exponent;
            }
            Technique::SilhouetteMap(silhouettes) => {
                record.search_max_ndc = silhouettes.width_max_ndc;
                record.edge_texels = silhouettes.edge_texels;
            }
            _ => {}
        }
        record
    }

    /// What 1 stands for in maps of linear depth: 16-bit floats hold shares of the farthest depth, so that no depth is
    /// too large for them.
    fn depth_unit(&self, settings: &ShadowSettings) -> f32 {
        match settings.depth_precision {
            DepthPrecision::Bits32 => 1.0,
            DepthPrecision::Bits16 => self.far_depth as f32,
        }
    }

    /// How far outside the frustum's sides a caster still matters, in NDC: it may have a smoothie in the map, and filters
    /// look there.
    pub fn reach_ndc(&self, settings: &ShadowSettings) -> f64 {
        self.widest_edge_ndc(settings) + GUARD_TEXELS * 2.0 / f64::from(settings.map_size)
    }

    /// How far from its silhouette the technique draws, at most, for a blocker anywhere between near and far, or in front
    /// of a cascade: the widest smoothie, or the farthest distance in a silhouette map. Unit: NDC. 0 for other techniques.
    pub fn widest_edge_ndc(&self, settings: &ShadowSettings) -> f64 {
        let Some(width) = self.width_terms(settings) else { return 0.0 };
        if self.casters_in_front == CastersInFront::Pancaked && width.per_q > 0.0 {
            return self.widest_ndc(width.max);
        }
        let unclamped = width.per_q * (self.q_max() - self.q_of_depth(self.near_depth));
        self.widest_ndc(unclamped.clamp(width.min, width.max))
    }

    fn width_terms(&self, settings: &ShadowSettings) -> Option<WidthTerms> {
        let (min_texels, max, width) = match &settings.technique {
            Technique::Smoothies(smoothies) => (MIN_WIDTH_TEXELS, smoothies.width_max_ndc, smoothies.width),
            Technique::SilhouetteMap(silhouettes) => {
                let reach = silhouettes.least_reach_texels().into();
                (reach, silhouettes.width_max_ndc, SmoothieWidth::FromLightSize)
            }
            _ => return None,
        };
        let min = min_texels * 2.0 / f64::from(settings.map_size);
        // On tiny maps some texels can be more than the largest width.
        let max = f64::from(max).max(min);
        Some(match width {
            SmoothieWidth::Ndc(given) => WidthTerms { per_q: 0.0, min: f64::from(given).clamp(min, max), max },
            SmoothieWidth::FromLightSize => WidthTerms { per_q: self.light_size, min, max },
        })
    }

    fn is_perspective(&self) -> u32 {
        (self.projection == Projection::Perspective).into()
    }
}

/// The words of 64-bit floats, two numbers to a row.
fn rows_of<const N: usize, const ROWS: usize>(numbers: [f64; N]) -> [[u32; 4]; ROWS] {
    core::array::from_fn(|row| {
        let [[x, y], [z, w]] = [2 * row, 2 * row + 1].map(|place| words_of(numbers[place]));
        [x, y, z, w]
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{DepthBias, Light, LightKind, SmoothieSettings, views};
    use glam::{DVec3, Mat4, Vec4};

    fn spot() -> View {
        let kind = LightKind::Spot {
            position: DVec3::new(0.0, 10.0, 0.0),
            target: DVec3::ZERO,
            cone_angle: 1.2,
            radius: 0.3,
            near: 0.5,
            far: 30.0,
        };
        views(&Light { kind, color: [1.0; 3] }).expect("a good spot")[0]
    }

    fn sun() -> View {
        let kind = LightKind::Directional {
            towards_light: DVec3::new(0.0, 30.0, 40.0),
            center: DVec3::ZERO,
            half_extent: 4.0,
            half_depth: 5.0,
            angular_radius: 0.02,
        };
        views(&Light { kind, color: [1.0; 3] }).expect("a good sun")[0]
    }

    fn settings(width: SmoothieWidth) -> ShadowSettings {
        let smoothies = SmoothieSettings { width, width_max_ndc: 2.0, ..SmoothieSettings::default() };
        ShadowSettings { technique: Technique::Smoothies(smoothies), map_size: 1024, ..ShadowSettings::default() }
    }

    /// The width as the shaders compute it, from the record.
    fn width_ndc(view: &LightView, depth: f32) -> f32 {
        let q = if view.perspective == 1 { -1.0 / depth } else { depth };
        let width = view.width_per_q_ndc * (view.q_max - q);
        width.clamp(view.width_min_ndc, view.width_max_ndc)
    }

    #[test]
    fn widths_from_the_light_end_where_the_penumbra_ends() {
        let settings = settings(SmoothieWidth::FromLightSize);
        // t(b) is the half penumbra on a receiver infinitely far away: R / (b tan(fov / 2)).
        let view = spot().light_view(&settings, &ViewCounts::default());
        let expected = 0.3 / (4.0 * 0.6_f64.tan());
        assert!((f64::from(width_ndc(&view, 4.0)) - expected).abs() < 1e-6);
        // And on a receiver at the farthest depth: tan(a) (far - b) / half extent.
        let view = sun().light_view(&settings, &ViewCounts::default());
        let expected = 0.02_f64.tan() * (10.0 - 4.0) / 4.0;
        assert!((f64::from(width_ndc(&view, 4.0)) - expected).abs() < 1e-6);
    }

    #[test]
    fn given_widths_do_not_depend_on_depth() {
        for view in [spot(), sun()] {
            let record = view.light_view(&settings(SmoothieWidth::Ndc(0.08)), &ViewCounts::default());
            assert_eq!(width_ndc(&record, 1.0), 0.08);
            assert_eq!(width_ndc(&record, 9.0), 0.08);
        }
    }

    #[test]
    fn widths_are_clamped() {
        let record = spot().light_view(&settings(SmoothieWidth::Ndc(1e-6)), &ViewCounts::default());
        assert_eq!(width_ndc(&record, 3.0), 3.0 / 1024.0, "one and a half texels");
        let mut narrow = settings(SmoothieWidth::FromLightSize);
        narrow.technique =
            Technique::Smoothies(SmoothieSettings { width_max_ndc: 0.05, ..SmoothieSettings::default() });
        let record = spot().light_view(&narrow, &ViewCounts::default());
        assert_eq!(width_ndc(&record, 0.6), 0.05);
        narrow.map_size = 16;
        let record = spot().light_view(&narrow, &ViewCounts::default());
        assert!(record.width_min_ndc <= record.width_max_ndc, "a clamp needs its ends in order");
    }

    #[test]
    fn no_blocker_has_more_than_the_widest() {
        for view in [spot(), sun()] {
            for width in [SmoothieWidth::Ndc(0.02), SmoothieWidth::FromLightSize] {
                let settings = settings(width);
                let widest = view.widest_edge_ndc(&settings);
                let record = view.light_view(&settings, &ViewCounts::default());
                for step in 1..=100 {
                    let share = f64::from(step) / 100.0;
                    let depth = view.near_depth + share * (view.far_depth - view.near_depth);
                    assert!(f64::from(width_ndc(&record, depth as f32)) <= widest * (1.0 + 1e-6));
                }
            }
        }
    }

    #[test]
    fn counts_and_map_reach_the_record() {
        let counts = ViewCounts {
            casters: 7,
            face_blocks: 1,
            edge_blocks: 2,
            undecided: 3,
            silhouettes: 4,
            quads: 5,
            corners: 6,
        };
        let record = sun().light_view(&settings(SmoothieWidth::Ndc(0.1)), &counts);
        let stored = [
            record.face_block_count,
            record.edge_block_count,
            record.undecided_capacity,
            record.silhouette_capacity,
            record.quad_capacity,
            record.corner_capacity,
            record.caster_count,
        ];
        assert_eq!(stored, [1, 2, 3, 4, 5, 6, 7]);
        assert_eq!((record.perspective, record.map_size), (0, 1024));
        assert_eq!((record.near_depth, record.far_depth, record.q_max), (0.0, 10.0, 10.0));
        assert_eq!(record.texel_world, 8.0 / 1024.0);
    }

    #[test]
    fn a_receiver_finds_its_depth() {
        let bias = DepthBias { constant_texels: 1.0, slope_texels: 2.0, normal_texels: 3.0, smoothie_texels: 4.0 };
        let settings = ShadowSettings { map_size: 512, bias, ..ShadowSettings::default() };
        let record = spot().receiver_view(&settings);
        let clip = Mat4::from_cols_array(&record.light_clip_from_world) * Vec4::new(0.0, 3.0, 0.0, 1.0);
        assert!((clip.w - 7.0).abs() < 1e-5);
        assert_eq!(record.light_world, [0.0, 10.0, 0.0, 1.0]);
        assert_eq!([record.bias_constant_texels, record.bias_slope_texels, record.bias_normal_texels], [1.0, 2.0, 3.0]);
        assert_eq!(sun().receiver_view(&settings).light_world, [0.0, 0.6, 0.8, 0.0], "of unit length");
    }
}
