//! What can be set about variance shadow maps.

/// What can be set about variance shadow maps. What casts should receive too, and the other way round: a receiver that is
/// not in the map has no variance to soften its own light by.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct VarianceSettings {
    /// Exponent of the warp of depth, which runs from -1 to 1 over the view (Lauritzen and McCool 2008); 0 leaves depth as
    /// it is, which makes a plain variance shadow map. Range: 0 to 42, the most that 32-bit moments hold; with 16
    /// bits, also on devices that do not filter 32-bit floats, at most 5.54. Default: 0, and 5.54 where it warps. The larger, the less light
    /// bleeds through overlapping shadows, and the closer to percentage-closer filtering.
    pub warp_exponent: f32,
    /// How soft the edges are. Default: a disk of 4 texels.
    pub softness: VarianceSoftness,
    /// Visibility up to which light is taken for bleeding and removed (Lauritzen 2007, light bleeding reduction). Range:
    /// 0 to 0.95. Default: 0.2, and 0.05 where depth is warped. Too much makes penumbrae narrower.
    pub bleed_cut: f32,
    /// Smallest variance, as a share of the view's depth range squared. Range: 0 to 1. Default: 1e-6, and 1e-8 where depth
    /// is warped. Too little: surfaces shadow themselves; too much: light bleeds at contacts.
    pub min_variance: f32,
}

/// How far moments are blurred.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum VarianceSoftness {
    /// Everywhere as by a disk of this radius. Unit: texels. Range: 0 to 1024.
    Texels(f32),
    /// As the light's size and the blockers' depth ask, which the moments tell too (Yang, Dong, Feng, Seidel and Kautz
    /// 2010, "Variance soft shadow mapping"). One area is searched as a whole; Yang et al. subdivide it where blockers
    /// in it are far apart in depth, so light leaks more here, into small cavities above all.
    FromLightSize {
        /// Largest radius of the search for blockers in NDC (the map's side is 2). Range: more than 0, up to 2. Default:
        /// 0.2.
        search_max_ndc: f32,
    },
}

impl VarianceSettings {
    /// The largest exponent whose squares 16-bit moments hold: exp(2 * 5.54) is below 65504.
    pub const MAX_EXPONENT_OF_HALVES: f32 = 5.54;

    /// Plain, evenly blurred.
    pub const VSM: Self =
        Self { warp_exponent: 0.0, softness: VarianceSoftness::Texels(4.0), bleed_cut: 0.2, min_variance: 1e-6 };

    /// Warped, evenly blurred.
    pub const EVSM: Self = Self {
        warp_exponent: Self::MAX_EXPONENT_OF_HALVES,
        softness: VarianceSoftness::Texels(4.0),
        bleed_cut: 0.05,
        min_variance: 1e-8,
    };

    /// Plain, blurred as the light's size asks.
    pub const VSM_PCSS: Self = Self { softness: VarianceSoftness::FROM_LIGHT_SIZE, ..Self::VSM };

    /// Warped, blurred as the light's size asks.
    pub const EVSM_PCSS: Self = Self { softness: VarianceSoftness::FROM_LIGHT_SIZE, ..Self::EVSM };
}

impl VarianceSettings {
    /// Whether depth is warped: an exponential variance shadow map.
    pub fn is_warped(&self) -> bool {
        self.warp_exponent > 0.0
    }
}

impl VarianceSoftness {
    /// From the light's size with the default search.
    pub const FROM_LIGHT_SIZE: Self = Self::FromLightSize { search_max_ndc: 0.2 };
}

impl Default for VarianceSettings {
    fn default() -> Self {
        Self::VSM
    }
}
