//! What can be set about percentage-closer filters.

/// What can be set about the bell-shaped percentage-closer filter.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct GaussianPcfSettings {
    /// Its kernel. Default: 5 texels, in 9 look-ups.
    pub kernel: GaussianKernel,
}

/// A kernel of Castano (2013), by the texels along its side.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum GaussianKernel {
    /// 3 texels, 4 look-ups.
    Three,
    /// 5 texels, 9 look-ups.
    Five,
    /// 7 texels, 16 look-ups.
    Seven,
}

/// What can be set about percentage-closer soft shadows.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PcssSettings {
    /// Look-ups of the search for blockers. Range: 1 to 1024. Default: 16.
    pub blocker_samples: u32,
    /// Look-ups of the filter. Range: 1 to 1024. Default: 32. Few show as noise.
    pub filter_samples: u32,
    /// Largest radius of the search in NDC (the map's side is 2). Range: more than 0, up to 2. Default: 0.2. The search
    /// goes as far as a blocker at the light's near plane could matter; where that is much farther than any blocker
    /// needs, the samples lie too thinly and miss blockers.
    pub search_max_ndc: f32,
}

impl GaussianPcfSettings {
    /// The defaults.
    pub const DEFAULT: Self = Self { kernel: GaussianKernel::Five };
}

impl Default for GaussianPcfSettings {
    fn default() -> Self {
        Self::DEFAULT
    }
}

impl GaussianKernel {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Three, Self::Five, Self::Seven];

    /// Texels along a side.
    pub const fn texels(self) -> u32 {
        match self {
            Self::Three => 3,
            Self::Five => 5,
            Self::Seven => 7,
        }
    }

    /// Weights of the texels along a side; the kernel is their product in x and y. Castano's look-ups are these, each
    /// between two texels, when the kernel's middle moves evenly from texel to texel.
    pub const fn weights(self) -> &'static [f32] {
        match self {
            Self::Three => &[1.0, 2.0, 1.0],
            Self::Five => &[1.0, 3.0, 4.0, 3.0, 1.0],
            Self::Seven => &[1.0, 5.0, 12.0, 16.0, 12.0, 5.0, 1.0],
        }
    }
}

impl PcssSettings {
    /// The defaults.
    pub const DEFAULT: Self = Self { blocker_samples: 16, filter_samples: 32, search_max_ndc: 0.2 };
}

impl Default for PcssSettings {
    fn default() -> Self {
        Self::DEFAULT
    }
}
