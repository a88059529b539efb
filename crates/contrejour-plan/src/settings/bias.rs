//! Depth bias.

/// How far a receiver must lie behind the map's depth to be in shadow.
///
/// Unit of all: texel footprints, the world size of a shadow map's texel at the receiver's depth, so that the same
/// numbers fit all map sizes and light distances; on maps below some 64 texels a footprint is so large that the bias
/// swallows shadows. Too little: the surface shadows itself in stripes. Too much: a
/// shadow comes loose from its caster, and the soft edge from the hard one.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct DepthBias {
    /// Added to the map's depth on every surface. Range: 0 and up. Default: 0.5.
    pub constant_texels: f32,
    /// Added for each unit of the surface's slope towards the light (the tangent of the angle between its normal and
    /// the direction to the light, at most 64): across a texel the surface recedes that much. Range: 0 and up. Default: 1.5, as the four
    /// nearest texels are looked up.
    pub slope_texels: f32,
    /// The receiver is moved along its normal by this much before the look-up, times the sine of the angle between
    /// normal and light; helps where the slope is steep. Range: 0 and up. Default: 0.5.
    pub normal_texels: f32,
    /// How far behind a smoothie its receiver must lie for the smoothie to be kept. Too little: rounding lets smoothies
    /// darken the caster's own lit side. Too much: the soft edge sets in late where a caster touches its receiver.
    /// In a silhouette map, how far behind what is just outside of it a silhouette may lie and not be hidden by it.
    /// Range: 0 and up. Default: 1.
    pub smoothie_texels: f32,
}

impl DepthBias {
    /// The defaults.
    pub const DEFAULT: Self =
        Self { constant_texels: 0.5, slope_texels: 1.5, normal_texels: 0.5, smoothie_texels: 1.0 };

    pub(super) fn named_values(&self) -> [(&'static str, f32); 4] {
        [
            ("constant bias", self.constant_texels),
            ("slope bias", self.slope_texels),
            ("normal bias", self.normal_texels),
            ("smoothie bias", self.smoothie_texels),
        ]
    }
}

impl Default for DepthBias {
    fn default() -> Self {
        Self::DEFAULT
    }
}
