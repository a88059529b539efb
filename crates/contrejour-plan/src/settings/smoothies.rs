//! What can be set about smoothies.

/// What can be set about smoothies.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct SmoothieSettings {
    /// How wide the soft edge is. Default: from the light's size.
    pub width: SmoothieWidth,
    /// Largest width in NDC (the map's side is 2). Range: more than 0, up to 2. Default: 2, which is no limit. Less
    /// bounds the fill cost of a large light near its casters; their penumbra is then too narrow.
    pub width_max_ndc: f32,
    /// Whether the edge hardens towards the contact. Default: it does.
    pub remap: AlphaRemap,
    /// How overlapping smoothies are blended. Default: as well as the device can.
    pub blend: SmoothieBlend,
}

/// How wide a smoothie is. One of a point light is that wide in the middle of its map, and elsewhere as much wider as a
/// sphere's penumbra is: see [`LightOutline`](crate::LightOutline).
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum SmoothieWidth {
    /// The same everywhere. Unit: NDC (the map's side is 2). Range: more than 0, up to 2; Chan and Durand (2003) show
    /// 0.02 and 0.08.
    Ndc(f32),
    /// As the light's size asks at each blocker's depth, so that the rim is where the outer penumbra ends.
    FromLightSize,
}

/// What happens to a smoothie's alpha where its receiver is near.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum AlphaRemap {
    /// The penumbra shrinks to nothing where the caster touches its receiver.
    #[default]
    Contact,
    /// The penumbra is as wide at the contact as anywhere: shows what the remap cures.
    Off,
}

/// How the nearest depth and the smallest alpha of overlapping smoothies are found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "kebab-case"))]
pub enum SmoothieBlend {
    /// In one pass where the device blends 32-bit floats, else in two.
    #[default]
    BestOfDevice,
    /// In two passes on every device: the depth by the hardware's depth test, then the alpha in 16-bit floats.
    TwoPasses,
}

impl SmoothieSettings {
    /// The defaults.
    pub const DEFAULT: Self = Self {
        width: SmoothieWidth::FromLightSize,
        width_max_ndc: 2.0,
        remap: AlphaRemap::Contact,
        blend: SmoothieBlend::BestOfDevice,
    };
}

impl Default for SmoothieSettings {
    fn default() -> Self {
        Self::DEFAULT
    }
}
