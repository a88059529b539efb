//! Pictures of textures, decoded within bounds.

use std::io::Cursor;

use contrejour_mesh::EncodedImage;
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, RgbaImage};

/// Texels that the textures of any scene may have together: 64 MiB.
const MOST_TEXELS: u64 = 1 << 24;

/// Texels for each byte of the pictures' files on top of that. A PNG of one colour has thousands, a photograph some 20.
const TEXELS_PER_BYTE: u64 = 256;

/// What a PNG's colour profile may unpack to before the picture's size is checked.
const MOST_HEADER_BYTES: u64 = 1 << 23;

/// Decodes the pictures of one scene. What they take is bounded by the bytes of their files: a file of a few bytes can
/// unpack to gigabytes.
#[derive(Debug, Default)]
pub struct TextureReader {
    bytes: u64,
    texels: u64,
}

/// Why a picture is no texture; each message is one line with place, problem and remedy.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum TextureError {
    /// Neither PNG nor JPEG, or damaged.
    #[error("{place}: the texture is not decoded: {problem}; save it again as PNG or JPEG")]
    Undecodable {
        /// The file, and the image in it.
        place: String,
        /// What is wrong.
        problem: String,
    },
    /// More texels along a side than every device allows, or none.
    #[error("{place}: the texture has {width} x {height} texels; save it with 1 to {most} each way", most = TextureReader::MAX_SIDE)]
    Size {
        /// The file, and the image in it.
        place: String,
        /// Texels from left to right.
        width: u32,
        /// Texels from top to bottom.
        height: u32,
    },
    /// By here there are too many texels for files of such sizes.
    #[error(
        "{place}: the textures up to here have {texels} texels, and files of their sizes may have {most}; save them smaller"
    )]
    TooManyTexels {
        /// The file, and the image in it.
        place: String,
        /// Texels so far.
        texels: u64,
        /// How many there may be.
        most: u64,
    },
}

impl TextureReader {
    /// Most texels along a side of a texture: what every device with WebGPU's defaults allows.
    pub const MAX_SIDE: u32 = 8192;

    /// Decodes a picture: rows from the top, sRGB colours and linear alpha, 8 bits each.
    ///
    /// # Errors
    ///
    /// [`TextureError`]; a picture that is too large is refused by its header, before it takes memory. All pictures together
    /// may have 2^24 texels and 256 for each byte of their files.
    pub fn read(&mut self, image: &EncodedImage) -> Result<RgbaImage, TextureError> {
        let undecodable = |problem: &dyn ToString| {
            let problem = problem.to_string().split_whitespace().collect::<Vec<_>>().join(" ");
            TextureError::Undecodable { place: image.place.clone(), problem }
        };
        let mut reader = ImageReader::new(Cursor::new(&image.bytes));
        let format = image::guess_format(&image.bytes).ok();
        let known = format.filter(|format| matches!(format, ImageFormat::Png | ImageFormat::Jpeg));
        reader.set_format(known.ok_or_else(|| undecodable(&"it is neither PNG nor JPEG"))?);
        let mut limits = image::Limits::no_limits();
        limits.max_alloc = Some(MOST_HEADER_BYTES);
        reader.limits(limits);
        let decoder = reader.into_decoder().map_err(|error| undecodable(&error))?;

        let (width, height) = decoder.dimensions();
        let sides = 1..=Self::MAX_SIDE;
        if !sides.contains(&width) || !sides.contains(&height) {
            return Err(TextureError::Size { place: image.place.clone(), width, height });
        }
        self.bytes += image.bytes.len() as u64;
        self.texels += u64::from(width) * u64::from(height);
        let most = MOST_TEXELS + TEXELS_PER_BYTE * self.bytes;
        if self.texels > most {
            return Err(TextureError::TooManyTexels { place: image.place.clone(), texels: self.texels, most });
        }
        Ok(DynamicImage::from_decoder(decoder).map_err(|error| undecodable(&error))?.into_rgba8())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use image::codecs::png::{CompressionType, FilterType, PngEncoder};
    use image::{GrayImage, Rgb, RgbImage, Rgba};

    fn encoded(picture: &DynamicImage, format: ImageFormat) -> EncodedImage {
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, format).expect("it fits into memory");
        EncodedImage { place: "leaf.gltf: image 0".into(), bytes: bytes.into_inner() }
    }

    #[test]
    fn png_and_jpeg_are_decoded() {
        let picture: DynamicImage = RgbImage::from_pixel(16, 8, Rgb([200, 100, 50])).into();
        for (format, most) in [(ImageFormat::Png, 0), (ImageFormat::Jpeg, 4)] {
            let decoded = TextureReader::default().read(&encoded(&picture, format)).expect("it is good");
            assert_eq!(decoded.dimensions(), (16, 8));
            let Rgba(texel) = *decoded.get_pixel(9, 3);
            let difference = texel.iter().zip([200, 100, 50, 255]).map(|(a, b)| a.abs_diff(b)).max();
            assert!(difference <= Some(most), "{format:?}: {texel:?}");
        }
    }

    #[test]
    fn what_is_no_picture_is_refused() {
        let message = |bytes: &[u8]| {
            let image = EncodedImage { place: "leaf.gltf: image 0".into(), bytes: bytes.to_vec() };
            TextureReader::default().read(&image).expect_err("it is no picture").to_string()
        };
        let told = message(b"GIF89a");
        assert!(told.starts_with("leaf.gltf: image 0: ") && told.contains("neither PNG nor JPEG"), "{told}");
        let whole = encoded(&GrayImage::new(64, 64).into(), ImageFormat::Png).bytes;
        for end in [8, 20, whole.len() / 2] {
            let told = message(&whole[..end]);
            assert!(told.contains("save it again") && !told.contains('\n'), "{told}");
        }
    }

    #[test]
    fn bombs_are_refused_before_they_are_decoded() {
        let wide = encoded(&GrayImage::new(TextureReader::MAX_SIDE + 1, 1).into(), ImageFormat::Png);
        let error = TextureReader::default().read(&wide).expect_err("it is too wide");
        assert!(matches!(error, TextureError::Size { width: 8193, height: 1, .. }), "{error}");

        let mut bytes = Vec::new();
        let encoder = PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::NoFilter);
        GrayImage::new(4096, 3072).write_with_encoder(encoder).expect("it fits into memory");
        let black = EncodedImage { place: "leaf.gltf: image 0".into(), bytes };
        assert!(black.bytes.len() < 20_000, "{}", black.bytes.len());
        let mut reader = TextureReader::default();
        reader.read(&black).expect("one is allowed");
        let error = reader.read(&black).expect_err("two are too many");
        assert!(matches!(error, TextureError::TooManyTexels { texels: 25_165_824, .. }), "{error}");
        // Ones that are as large as their files say are fine.
        let mut noise = GrayImage::new(4096, 3072);
        let mut state = 1_u32;
        for texel in noise.iter_mut() {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            *texel = (state >> 24) as u8;
        }
        let mut reader = TextureReader::default();
        let noise = encoded(&noise.into(), ImageFormat::Jpeg);
        for _ in 0..3 {
            reader.read(&noise).expect("it is a photograph");
        }
    }
}
