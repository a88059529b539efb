//! Textures as a file brings them: pictures that are not decoded, and how they are looked up.

use std::fmt;
use std::sync::Arc;

/// A picture in its file format. Loaders do not decode it, so that it takes no more memory than its file.
#[derive(Clone, PartialEq, Eq)]
pub struct EncodedImage {
    /// Where it is from, for messages: the file, and the image in it.
    pub place: String,
    /// PNG or JPEG, as its first bytes tell; colours are sRGB.
    pub bytes: Vec<u8>,
}

impl fmt::Debug for EncodedImage {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(formatter, "EncodedImage({:?}, {} bytes)", self.place, self.bytes.len())
    }
}

/// A picture and how it is looked up. Textures of one picture share it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Texture {
    /// The picture.
    pub image: Arc<EncodedImage>,
    /// What is beyond the picture's edges: left and right, above and below.
    pub wrap: [TextureWrap; 2],
    /// What is between its texels.
    pub filter: TextureFilter,
}

/// What a texture shows beyond its edges.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum TextureWrap {
    /// The picture again.
    #[default]
    Repeat,
    /// The picture again, each second one mirrored.
    Mirror,
    /// The texels at its edge.
    Clamp,
}

/// What a texture shows where it is larger than its texels.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum TextureFilter {
    /// A mean of the nearest four.
    #[default]
    Linear,
    /// The nearest one.
    Nearest,
}
