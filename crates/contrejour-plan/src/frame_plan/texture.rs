//! The maps of a light view.

/// A texture of a light view.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum TextureKind {
    /// Linear depth of the shadow map.
    ShadowDepth,
    /// Hardware depth while the shadow map is drawn.
    ShadowHardwareDepth,
    /// Hardware depth of the smoothies, of two passes.
    SmoothieDepth,
    /// Alpha of the smoothies, of two passes.
    SmoothieAlpha,
    /// Linear depth and alpha of the smoothies, of one pass.
    SmoothieBuffer,
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
    /// Two 32-bit floats.
    Rg32Float,
}

/// A texture that the frame needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TexturePlan {
    /// Which one.
    pub kind: TextureKind,
    /// What a texel holds.
    pub format: TextureFormat,
    /// Texels along each side.
    pub size: u32,
    /// Size of its texels in bytes.
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
        }
    }

    /// What a texel holds.
    pub const fn format(self) -> TextureFormat {
        match self {
            Self::ShadowDepth => TextureFormat::R32Float,
            Self::ShadowHardwareDepth | Self::SmoothieDepth => TextureFormat::Depth32Float,
            Self::SmoothieAlpha => TextureFormat::R16Float,
            Self::SmoothieBuffer => TextureFormat::Rg32Float,
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
            Self::Rg32Float => "rg32float",
        }
    }

    const fn texel_bytes(self) -> u64 {
        match self {
            Self::R16Float => 2,
            Self::R32Float | Self::Depth32Float => 4,
            Self::Rg32Float => 8,
        }
    }
}

impl TexturePlan {
    pub(super) fn new(kind: TextureKind, size: u32) -> Self {
        let format = kind.format();
        let bytes = u64::from(size) * u64::from(size) * format.texel_bytes();
        Self { kind, format, size, bytes }
    }
}
