//! Picture files as parts of the page.

use std::path::{Path, PathBuf};

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use contrejour_mesh::{ReadFileError, read_file};
use image::ImageFormat;
use image::imageops::FilterType;

use super::files::MAX_FILE_BYTES;

/// Pictures are scaled down to this width in pixels, so that a page with hundreds of them stays small.
const WIDTH_MAX: u32 = 320;

/// Why a picture is not in the page.
#[derive(Debug, thiserror::Error)]
pub enum EmbedError {
    /// The file can't be read.
    #[error(transparent)]
    File(#[from] ReadFileError),
    /// The file is no picture.
    #[error(
        "the picture {path} can't be read: {error}; make the report again, or take the picture out of its JSON",
        path = path.display()
    )]
    Read {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        error: image::ImageError,
    },
    /// The smaller picture can't be written.
    #[error("the picture {path} can't be made smaller: {error}", path = path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        error: image::ImageError,
    },
}

/// A picture as it stands in the page.
pub(super) struct Embedded {
    /// Address that holds the picture itself.
    pub(super) data_uri: String,
    pub(super) width: u32,
    pub(super) height: u32,
}

/// Reads a PNG file below a folder.
pub(super) fn embed(folder: &Path, relative: &str) -> Result<Embedded, EmbedError> {
    let path = folder.join(relative);
    let bytes = read_file(&path, MAX_FILE_BYTES)?;
    let mut picture = match image::load_from_memory_with_format(&bytes, ImageFormat::Png) {
        Ok(picture) => picture,
        Err(error) => return Err(EmbedError::Read { path, error }),
    };
    if picture.width() > WIDTH_MAX {
        picture = picture.resize(WIDTH_MAX, u32::MAX, FilterType::Triangle);
    }
    let mut png = std::io::Cursor::new(Vec::new());
    if let Err(error) = picture.write_to(&mut png, ImageFormat::Png) {
        return Err(EmbedError::Write { path, error });
    }
    let data_uri = format!("data:image/png;base64,{}", STANDARD.encode(png.into_inner()));
    Ok(Embedded { data_uri, width: picture.width(), height: picture.height() })
}

#[cfg(test)]
mod tests {
    use image::{Rgba, RgbaImage};

    use super::*;

    #[test]
    fn pictures_are_made_small_and_kept_whole() {
        let folder = tempfile::tempdir().expect("there is room for a folder");
        RgbaImage::from_pixel(640, 480, Rgba([9, 8, 7, 255])).save(folder.path().join("a.png")).expect("it is written");
        let Embedded { data_uri, width, height } = embed(folder.path(), "a.png").expect("it was just written");
        assert_eq!((width, height), (320, 240));
        let png = STANDARD.decode(data_uri.trim_start_matches("data:image/png;base64,")).expect("it is base64");
        let read = image::load_from_memory(&png).expect("it is a picture").into_rgba8();
        assert_eq!((read.dimensions(), read[(100, 100)].0), ((320, 240), [9, 8, 7, 255]));
    }

    #[test]
    fn missing_and_broken_files_are_named() {
        let folder = tempfile::tempdir().expect("there is room for a folder");
        std::fs::write(folder.path().join("broken.png"), "no picture").expect("it is written");
        for name in ["missing.png", "broken.png"] {
            let error = embed(folder.path(), name).err().expect("there is no picture").to_string();
            assert!(error.contains(name), "{error}");
        }
    }
}
