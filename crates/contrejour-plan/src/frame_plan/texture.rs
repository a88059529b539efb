//! The maps of a light view.

use super::DeviceFacts;
use crate::{DepthPrecision, ShadowSettings, Technique, VarianceSettings, VarianceSoftness};

/// A texture of a light view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum TextureKind {
    /// Linear depth of the shadow map.
    ShadowDepth,
    /// Hardware depth of the shadow map; only while it is drawn, where linear depth is what is read.
    ShadowHardwareDepth,
    /// Hardware depth of the smoothies, of two passes.
    SmoothieDepth,
    /// Alpha of the smoothies, of two passes.
    SmoothieAlpha,
    /// Linear depth and alpha of the smoothies, of one pass.
    SmoothieBuffer,
    /// Moments of depth, with all levels.
    Moments,
    /// Depth of the nearest silhouette and signed distance to it.
    SilhouetteMap,
    /// By what the nearest silhouette wins; only while they are drawn.
    SilhouetteOrder,
}

/// What a texel holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
pub enum TextureFormat {
    /// One 32-bit float.
    R32Float,
    /// A 32-bit depth.
    Depth32Float,
    /// One 16-bit float.
    R16Float,
    /// Two 16-bit floats.
    Rg16Float,
    /// Two 32-bit floats.
    Rg32Float,
    /// Four 16-bit floats.
    Rgba16Float,
    /// Four 32-bit floats.
    Rgba32Float,
}

/// A texture that the frame needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TexturePlan {
    /// Which one.
    pub kind: TextureKind,
    /// What a texel holds.
    pub format: TextureFormat,
    /// Texels along each side of the first level.
    pub size: u32,
    /// Layers: one for each view, or one where a texture only serves while a view is drawn.
    pub layers: u32,
    /// Levels, each half as large as the one before.
    pub levels: u32,
    /// Size of the texels of all layers and levels in bytes.
    pub bytes: u64,
}

impl TextureKind {
    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::ShadowDepth => "shadow_depth",
            Self::ShadowHardwareDepth => "shadow_hardware_depth",
            Self::SmoothieDepth => "smoothie_depth",
            Self::SmoothieAlpha => "smoothie_alpha",
            Self::SmoothieBuffer => "smoothie_buffer",
            Self::Moments => "moments",
            Self::SilhouetteMap => "silhouette_map",
            Self::SilhouetteOrder => "silhouette_order",
        }
    }

    /// What a texel holds.
    fn format(self, settings: &ShadowSettings, device: &DeviceFacts) -> TextureFormat {
        let by_precision = |halves, floats| match settings.depth_precision {
            DepthPrecision::Bits16 => halves,
            DepthPrecision::Bits32 => floats,
        };
        match self {
            Self::ShadowDepth => by_precision(TextureFormat::R16Float, TextureFormat::R32Float),
            Self::ShadowHardwareDepth | Self::SmoothieDepth | Self::SilhouetteOrder => TextureFormat::Depth32Float,
            Self::SmoothieAlpha => TextureFormat::R16Float,
            Self::SmoothieBuffer | Self::SilhouetteMap => {
                by_precision(TextureFormat::Rg16Float, TextureFormat::Rg32Float)
            }
            Self::Moments => {
                let warped = settings.technique.is_warped();
                match (warped, settings.moments_have_32_bits(device)) {
                    (false, false) => TextureFormat::Rg16Float,
                    (false, true) => TextureFormat::Rg32Float,
                    (true, false) => TextureFormat::Rgba16Float,
                    (true, true) => TextureFormat::Rgba32Float,
                }
            }
        }
    }
}

impl TextureFormat {
    /// Its name in WebGPU.
    pub const fn name(self) -> &'static str {
        match self {
            Self::R32Float => "r32float",
            Self::Depth32Float => "depth32float",
            Self::R16Float => "r16float",
            Self::Rg16Float => "rg16float",
            Self::Rg32Float => "rg32float",
            Self::Rgba16Float => "rgba16float",
            Self::Rgba32Float => "rgba32float",
        }
    }

    const fn texel_bytes(self) -> u64 {
        match self {
            Self::R16Float => 2,
            Self::R32Float | Self::Depth32Float | Self::Rg16Float => 4,
            Self::Rg32Float | Self::Rgba16Float => 8,
            Self::Rgba32Float => 16,
        }
    }
}

impl TexturePlan {
    pub(super) fn new(kind: TextureKind, settings: &ShadowSettings, device: &DeviceFacts, layers: u32) -> Self {
        let (size, format) = (settings.map_size, kind.format(settings, device));
        let levels = if kind == TextureKind::Moments { moment_levels(settings) } else { 1 };
        let sides = (0..levels).map(|level| u64::from((size >> level).max(1)));
        let texels: u64 = sides.map(|side| side * side).sum();
        Self { kind, format, size, layers, levels, bytes: u64::from(layers) * texels * format.texel_bytes() }
    }
}

/// Levels of moments that receivers can look up. Level n is as blurred as by a disk of more than 2^n texels.
fn moment_levels(settings: &ShadowSettings) -> u32 {
    let all = settings.map_size.ilog2() + 1;
    match settings.technique {
        Technique::Variance(VarianceSettings { softness: VarianceSoftness::Texels(texels), .. }) => {
            all.min(texels.max(1.0).log2().ceil() as u32 + 1)
        }
        _ => all,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moments_have_all_levels() {
        let technique = "evsm-pcss".parse().expect("there is such a technique");
        let settings = ShadowSettings { map_size: 6, technique, ..ShadowSettings::default() };
        let device = DeviceFacts { float32_filterable: true, ..DeviceFacts::default() };
        let plan = TexturePlan::new(TextureKind::Moments, &settings, &device, 1);
        assert_eq!((plan.levels, plan.bytes), (3, 16 * (36 + 9 + 1)));
        let plan = TexturePlan::new(TextureKind::Moments, &settings, &DeviceFacts::default(), 1);
        assert_eq!((plan.format, plan.bytes), (TextureFormat::Rgba16Float, 8 * (36 + 9 + 1)));
    }

    #[test]
    fn an_even_blur_needs_few_levels() {
        let levels = |texels: f64| {
            let mut technique: Technique = "vsm".parse().expect("there is such a technique");
            technique.set("blur_texels", texels).expect("in range");
            let settings = ShadowSettings { map_size: 64, technique, ..ShadowSettings::default() };
            TexturePlan::new(TextureKind::Moments, &settings, &DeviceFacts::default(), 1).levels
        };
        assert_eq!([0.0, 1.0, 4.0, 5.0, 8.0, 1024.0].map(levels), [1, 1, 3, 4, 4, 7]);
    }

    #[test]
    fn half_the_precision_is_half_the_memory() {
        for kind in
            [TextureKind::ShadowDepth, TextureKind::SmoothieBuffer, TextureKind::Moments, TextureKind::SilhouetteMap]
        {
            let bytes = |depth_precision| {
                let settings = ShadowSettings { depth_precision, ..ShadowSettings::default() };
                let device = DeviceFacts { float32_filterable: true, ..DeviceFacts::default() };
                TexturePlan::new(kind, &settings, &device, 1).bytes
            };
            assert_eq!(bytes(DepthPrecision::Bits32), 2 * bytes(DepthPrecision::Bits16));
        }
    }
}
