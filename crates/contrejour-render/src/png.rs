//! Pictures on disk.

use std::io::Cursor;
use std::path::Path;

use image::{ImageFormat, RgbaImage};

use crate::save::{SaveError, save_file};

/// Writes a picture as PNG; its folder is made where it is missing.
///
/// # Errors
///
/// [`SaveError`]; an older file of the same name then stays as it was.
pub fn save_png(picture: &RgbaImage, path: &Path) -> Result<(), SaveError> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).map_err(|source| SaveError::Encode { path: path.into(), source })?;
    save_file(&bytes.into_inner(), path)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_picture_comes_back_and_nothing_else_is_left() {
        let folder = tempfile::tempdir().expect("there is room for a folder");
        let path = folder.path().join("deep/er/one.png");
        let picture = RgbaImage::from_fn(3, 2, |x, y| image::Rgba([x as u8, y as u8, 7, 255]));
        save_png(&picture, &path).expect("the temporary folder can be written");
        assert_eq!(image::open(&path).expect("it was written").to_rgba8(), picture);
        let entries = std::fs::read_dir(path.parent().expect("it has one")).expect("it exists");
        assert_eq!(entries.count(), 1);
    }
}
