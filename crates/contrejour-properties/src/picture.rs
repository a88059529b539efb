//! Bytes as the picture of a texture: refused in one line, or texels.

use contrejour_mesh::EncodedImage;
use contrejour_scene::TextureReader;

use crate::mesh_file::assert_one_line;

/// Decodes bytes as a picture, twice by one reader; returns the number of its texels, `None` where it is refused.
///
/// # Panics
///
/// When a refusal has more or less than one line, or a picture is larger than a texture may be.
pub fn check_picture(bytes: &[u8]) -> Option<u64> {
    let image = EncodedImage { place: "any.gltf: image 0".to_owned(), bytes: bytes.to_vec() };
    let mut reader = TextureReader::default();
    let texels = [(); 2].map(|()| match reader.read(&image) {
        Ok(picture) => {
            let (width, height) = picture.dimensions();
            let sides = 1..=TextureReader::MAX_SIDE;
            assert!(sides.contains(&width) && sides.contains(&height), "a picture has {width} x {height} texels");
            Some(u64::from(width) * u64::from(height))
        }
        Err(error) => {
            assert_one_line(&error.to_string());
            None
        }
    });
    texels[0]
}
