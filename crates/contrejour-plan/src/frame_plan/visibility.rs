//! Which visibility function a frame's receivers call.

use super::{Pass, TextureKind};
use crate::{CubeFace, EdgeProfile, GaussianKernel, LightKind, Technique, VarianceSoftness};

/// What the visibility function is, and so which maps it reads. Where it changes, the function's text and its bind group
/// layout do: a caller keeps one pipeline for each kind that it meets.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum VisibilityKind {
    /// One hardware comparison.
    Compared(MapSampler),
    /// A bell-shaped percentage-closer filter.
    GaussianPcf(GaussianKernel),
    /// A cubic percentage-closer filter.
    BicubicPcf,
    /// Percentage-closer soft shadows.
    Pcss {
        /// Look-ups of the search for blockers.
        blocker_samples: u32,
        /// Look-ups of the filter.
        filter_samples: u32,
    },
    /// Moments of depth.
    Variance {
        /// Whether depth is warped.
        warped: bool,
        /// Whether the light's size sets how far moments are blurred.
        from_light_size: bool,
    },
    /// Shadow map, smoothie depth and smoothie alpha.
    SmoothiesSplit,
    /// Shadow map and smoothie buffer.
    SmoothiesPacked,
    /// Shadow map and silhouette map.
    SilhouetteMap {
        /// Places at which a soft edge is looked up.
        samples: u32,
        /// How it goes from dark to lit.
        profile: EdgeProfile,
    },
}

/// How receivers find the view of a light that shows them. Like a [`VisibilityKind`], it shapes the function's text.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum ViewChoice {
    /// There is one.
    Only,
    /// By the largest component of the direction from the light, as [`CubeFace::of`](crate::CubeFace::of) says.
    CubeFace,
    /// By depth in the eye's view, as [`Cascades::at`](crate::Cascades::at) says.
    Cascade {
        /// How many there are.
        count: u32,
    },
}

impl ViewChoice {
    /// Every way, for tests and tools.
    pub const EXAMPLES: [Self; 3] = [Self::Only, Self::CubeFace, Self::Cascade { count: 4 }];

    /// How the views of a light are told apart.
    pub fn of(light: &LightKind) -> Self {
        match light {
            LightKind::Spot { .. } | LightKind::Directional { .. } => Self::Only,
            LightKind::Point { .. } => Self::CubeFace,
            LightKind::Cascaded { cascades, .. } => Self::Cascade { count: cascades.count },
        }
    }

    /// Views that there are.
    pub const fn views(self) -> usize {
        match self {
            Self::Only => 1,
            Self::CubeFace => CubeFace::ALL.len(),
            Self::Cascade { count } => count as usize,
        }
    }
}

/// How a map is looked up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum MapSampler {
    /// Compares with the nearest texel.
    CompareNearest,
    /// Compares with the four nearest texels and weighs the results.
    CompareLinear,
    /// Weighs the four nearest texels of the two nearest levels.
    Trilinear,
}

impl VisibilityKind {
    /// The function of a frame with these passes; `None` where it has no maps. Soft shadows of a light without size
    /// are hard ones.
    pub(super) fn of(technique: &Technique, passes: &[Pass], light_has_size: bool) -> Option<Self> {
        let has = |pass| passes.contains(&pass);
        if !passes.iter().any(|pass| pass.fills_shadow_map()) {
            return None;
        }
        Some(match technique {
            _ if has(Pass::SmoothieBuffer) => Self::SmoothiesPacked,
            _ if has(Pass::SmoothieAlpha) => Self::SmoothiesSplit,
            Technique::SilhouetteMap(silhouettes) if passes.iter().any(|pass| pass.fills_silhouette_map()) => {
                let samples = if light_has_size { silhouettes.samples } else { 1 };
                Self::SilhouetteMap { samples, profile: silhouettes.profile }
            }
            Technique::ShadowMap => Self::Compared(MapSampler::CompareNearest),
            Technique::GaussianPcf(gaussian) => Self::GaussianPcf(gaussian.kernel),
            Technique::BicubicPcf => Self::BicubicPcf,
            Technique::Pcss(pcss) if light_has_size => {
                Self::Pcss { blocker_samples: pcss.blocker_samples, filter_samples: pcss.filter_samples }
            }
            Technique::Variance(variance) => Self::Variance {
                warped: variance.is_warped(),
                from_light_size: matches!(variance.softness, VarianceSoftness::FromLightSize { .. }),
            },
            Technique::Pcf | Technique::Pcss(_) | Technique::Smoothies(_) | Technique::SilhouetteMap(_) => {
                Self::Compared(MapSampler::CompareLinear)
            }
        })
    }

    /// Every kind, those with numbers in all their variants of text, for tests and tools.
    pub fn examples() -> impl Iterator<Item = Self> {
        let compared = [MapSampler::CompareNearest, MapSampler::CompareLinear].map(Self::Compared);
        let variance = [(false, false), (false, true), (true, false), (true, true)]
            .map(|(warped, from_light_size)| Self::Variance { warped, from_light_size });
        let others = [
            Self::BicubicPcf,
            Self::Pcss { blocker_samples: 8, filter_samples: 8 },
            Self::SmoothiesSplit,
            Self::SmoothiesPacked,
            Self::SilhouetteMap { samples: 1, profile: EdgeProfile::Linear },
            Self::SilhouetteMap { samples: 4, profile: EdgeProfile::Disk },
        ];
        compared.into_iter().chain(GaussianKernel::ALL.map(Self::GaussianPcf)).chain(variance).chain(others)
    }

    /// The maps that it reads, in the order of their bindings from 1 on; the receiver view is at 0.
    pub const fn textures(self) -> &'static [TextureKind] {
        match self {
            Self::Compared(_) | Self::GaussianPcf(_) | Self::BicubicPcf | Self::Pcss { .. } => {
                &[TextureKind::ShadowHardwareDepth]
            }
            Self::Variance { .. } => &[TextureKind::Moments],
            Self::SmoothiesSplit => &[TextureKind::ShadowDepth, TextureKind::SmoothieDepth, TextureKind::SmoothieAlpha],
            Self::SmoothiesPacked => &[TextureKind::ShadowDepth, TextureKind::SmoothieBuffer],
            Self::SilhouetteMap { .. } => &[TextureKind::ShadowDepth, TextureKind::SilhouetteMap],
        }
    }

    /// The sampler that it looks its first map up with; its binding follows the maps'.
    pub const fn sampler(self) -> Option<MapSampler> {
        match self {
            Self::Compared(sampler) => Some(sampler),
            Self::BicubicPcf => Some(MapSampler::CompareNearest),
            Self::GaussianPcf(_) | Self::Pcss { .. } => Some(MapSampler::CompareLinear),
            Self::Variance { .. } => Some(MapSampler::Trilinear),
            Self::SmoothiesSplit | Self::SmoothiesPacked | Self::SilhouetteMap { .. } => None,
        }
    }
}
