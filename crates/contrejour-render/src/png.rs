//! Pictures on disk.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::{fs, io};

use image::{ImageFormat, RgbaImage};

/// Why a file could not be written.
#[derive(Debug, thiserror::Error)]
pub enum SaveError {
    /// The folder cannot be made.
    #[error("cannot make the folder {}; choose another place", path.display())]
    Folder {
        /// The folder.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The file cannot be written.
    #[error("cannot write {}; check that the folder can be written and the disk has room", path.display())]
    Write {
        /// The file.
        path: PathBuf,
        /// What the system says.
        source: io::Error,
    },
    /// The path names no file.
    #[error("{} names no file; give a path that ends in a file name", path.display())]
    NoFileName {
        /// The path.
        path: PathBuf,
    },
    /// The picture cannot be encoded.
    #[error("cannot encode {} as PNG", path.display())]
    Encode {
        /// The file.
        path: PathBuf,
        /// What the encoder says.
        source: image::ImageError,
    },
}

/// Writes a picture as PNG; its folder is made where it is missing.
///
/// # Errors
///
/// [`SaveError`]; an older file of the same name then stays as it was.
pub fn save_png(picture: &RgbaImage, path: &Path) -> Result<(), SaveError> {
    let mut bytes = io::Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png).map_err(|source| SaveError::Encode { path: path.into(), source })?;
    save_file(&bytes.into_inner(), path)
}

/// Writes a file as a whole or not at all: under another name first, which is then changed. Its folder is made where
/// it is missing.
///
/// # Errors
///
/// [`SaveError`]; an older file of the same name then stays as it was.
pub fn save_file(bytes: &[u8], path: &Path) -> Result<(), SaveError> {
    let name = path.file_name().ok_or_else(|| SaveError::NoFileName { path: path.into() })?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty());
    if let Some(folder) = folder {
        fs::create_dir_all(folder).map_err(|source| SaveError::Folder { path: folder.into(), source })?;
    }
    let mut unfinished_name = OsString::from(".");
    unfinished_name.push(name);
    unfinished_name.push(format!(".{}.unfinished", std::process::id()));
    let unfinished = path.with_file_name(unfinished_name);
    fs::write(&unfinished, bytes).and_then(|()| fs::rename(&unfinished, path)).map_err(|source| {
        // The first error is the one to tell; a file that cannot be removed either adds nothing.
        let _ = fs::remove_file(&unfinished);
        SaveError::Write { path: path.into(), source }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn folder(name: &str) -> PathBuf {
        let folder = std::env::temp_dir().join(format!("contrejour-render-{}-{name}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        folder
    }

    #[test]
    fn a_picture_comes_back_and_nothing_else_is_left() {
        let folder = folder("png");
        let path = folder.join("deep/er/one.png");
        let picture = RgbaImage::from_fn(3, 2, |x, y| image::Rgba([x as u8, y as u8, 7, 255]));
        save_png(&picture, &path).expect("the temporary folder can be written");
        assert_eq!(image::open(&path).expect("it was written").to_rgba8(), picture);
        assert_eq!(fs::read_dir(path.parent().expect("it has one")).expect("it exists").count(), 1);
        fs::remove_dir_all(&folder).expect("it was made here");
    }

    #[test]
    fn a_folder_in_the_way_is_an_error_and_stays() {
        let folder = folder("way");
        let path = folder.join("taken.png");
        fs::create_dir_all(path.join("inside")).expect("the temporary folder can be written");
        let error = save_file(b"x", &path).expect_err("a folder has that name");
        assert!(matches!(error, SaveError::Write { .. }), "{error}");
        assert_eq!(fs::read_dir(&folder).expect("it exists").count(), 1);
        fs::remove_dir_all(&folder).expect("it was made here");
    }

    #[test]
    fn a_path_without_a_name_is_an_error() {
        assert!(matches!(save_file(b"x", Path::new("/")), Err(SaveError::NoFileName { .. })));
    }
}
