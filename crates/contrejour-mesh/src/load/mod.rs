//! Mesh files: from a path, from bytes with the files beside them, and one function for each format.

mod error;
#[cfg(feature = "gltf")]
mod gltf;
#[cfg(feature = "obj")]
mod obj;
#[cfg(feature = "ply")]
mod ply;
#[cfg(feature = "stl")]
mod stl;

use std::path::Path;

use crate::{AnimatedModel, MeshFile, ReadFileError, Rig};

pub use error::LoadError;
#[cfg(feature = "gltf")]
pub use gltf::load_gltf;
#[cfg(feature = "obj")]
pub use obj::load_obj;
#[cfg(feature = "ply")]
pub use ply::load_ply;
#[cfg(feature = "stl")]
pub use stl::load_stl;

/// Loads a mesh file; its extension (.obj, .gltf, .glb, .ply, .stl, in any case) names the format.
///
/// It may have up to [`MAX_FILE_BYTES`]; while it is loaded, memory holds it a few times. A file without triangles is an
/// empty mesh and no error. What the loader leaves out, and that nothing is there, is in [`MeshFile::warnings`].
///
/// # Errors
///
/// Any [`LoadError`]; the file is either loaded completely or refused.
pub fn load(path: &Path) -> Result<MeshFile, LoadError> {
    let format = format_of(path)?;
    load_checked(format, &read_file(path)?, path, &read_file)
}

/// Gives the bytes of a file that a mesh file names: a material library, or a buffer of a glTF file.
///
/// Paths are as the file names them, joined to the folder of the mesh file's own path.
pub type ReadFile<'a> = dyn Fn(&Path) -> Result<Vec<u8>, LoadError> + 'a;

/// Loads a mesh file from its bytes, and the files that it names through `read_beside`: from an archive, say.
///
/// `path` names the format as in [`load`] and is for messages; nothing is opened.
///
/// # Errors
///
/// Any [`LoadError`]; a buffer that `read_beside` refuses is one, a material library is a warning.
pub fn load_bytes(bytes: &[u8], path: &Path, read_beside: &ReadFile) -> Result<MeshFile, LoadError> {
    load_checked(format_of(path)?, bytes, path, read_beside)
}

/// [`load`] with what moves the meshes: nodes, skins, morph targets and animations. Only glTF files have any.
///
/// # Errors
///
/// As [`load`], and where a skin, a morph target or an animation that is read does not follow the format.
pub fn load_animated(path: &Path) -> Result<AnimatedModel, LoadError> {
    let format = format_of(path)?;
    load_animated_checked(format, &read_file(path)?, path, &read_file)
}

/// [`load_animated`] from bytes, as [`load_bytes`].
///
/// # Errors
///
/// As [`load_animated`].
pub fn load_animated_bytes(bytes: &[u8], path: &Path, read_beside: &ReadFile) -> Result<AnimatedModel, LoadError> {
    load_animated_checked(format_of(path)?, bytes, path, read_beside)
}

fn load_animated_checked(
    format: &'static str,
    bytes: &[u8],
    path: &Path,
    read_beside: &ReadFile,
) -> Result<AnimatedModel, LoadError> {
    #[cfg(feature = "gltf")]
    if format == "gltf" {
        check_not_empty(bytes, path)?;
        let mut model = gltf::load_animated(bytes, path, read_beside)?;
        warn_without_faces(&mut model.file, path);
        return Ok(model);
    }
    let file = load_checked(format, bytes, path, read_beside)?;
    Ok(AnimatedModel { file, rig: Rig::default() })
}

/// The cargo feature of the format that a path's extension names.
fn format_of(path: &Path) -> Result<&'static str, LoadError> {
    let extension = path.extension().and_then(|extension| extension.to_str());
    match extension.map(str::to_ascii_lowercase).as_deref() {
        Some("obj") => Ok("obj"),
        Some("gltf" | "glb") => Ok("gltf"),
        Some("ply") => Ok("ply"),
        Some("stl") => Ok("stl"),
        _ if path.is_dir() => Err(ReadFileError::Directory { path: path.into() }.into()),
        _ => Err(LoadError::UnknownFormat { path: path.into() }),
    }
}

fn load_checked(
    format: &'static str,
    bytes: &[u8],
    path: &Path,
    read_beside: &ReadFile,
) -> Result<MeshFile, LoadError> {
    check_not_empty(bytes, path)?;
    let mut file = load_format(format, bytes, path, read_beside)?;
    warn_without_faces(&mut file, path);
    Ok(file)
}

fn check_not_empty(bytes: &[u8], path: &Path) -> Result<(), LoadError> {
    if bytes.is_empty() { Err(LoadError::Empty { path: path.into() }) } else { Ok(()) }
}

fn warn_without_faces(file: &mut MeshFile, path: &Path) {
    if file.triangle_count() == 0 {
        file.warnings.push(format!("{}: there is no face in the file; export the mesh with its faces", path.display()));
    }
}

/// Loads from bytes, where the loader of the format is built in.
#[cfg_attr(
    not(any(feature = "obj", feature = "gltf")),
    expect(unused_variables, reason = "no loader reads the files beside")
)]
fn load_format(format: &'static str, bytes: &[u8], path: &Path, read_beside: &ReadFile) -> Result<MeshFile, LoadError> {
    match format {
        #[cfg(feature = "obj")]
        "obj" => obj::load(bytes, path, read_beside),
        #[cfg(feature = "gltf")]
        "gltf" => gltf::load(bytes, path, read_beside),
        #[cfg(feature = "ply")]
        "ply" => load_ply(bytes, path),
        #[cfg(feature = "stl")]
        "stl" => load_stl(bytes, path),
        feature => Err(LoadError::FormatDisabled { path: path.into(), feature }),
    }
}

/// The most bytes of a mesh file, and of each file that it names: 2 GiB.
pub const MAX_FILE_BYTES: u64 = 1 << 31;

fn read_file(path: &Path) -> Result<Vec<u8>, LoadError> {
    Ok(crate::read_file(path, MAX_FILE_BYTES)?)
}

/// File name without extension: the name of a mesh in formats that name none.
#[cfg(any(feature = "obj", feature = "ply", feature = "stl"))]
fn stem(path: &Path) -> String {
    let stem = path.file_stem().unwrap_or_default();
    stem.to_string_lossy().into_owned()
}

/// Whether all coordinates are finite.
#[cfg(any(feature = "obj", feature = "gltf", feature = "ply", feature = "stl"))]
fn is_finite(position: [f32; 3]) -> bool {
    position.iter().all(|coordinate| coordinate.is_finite())
}

/// Linear colour from an sRGB one (IEC 61966-2-1:1999), each 0..1; other values are clamped.
#[cfg(any(feature = "obj", feature = "ply"))]
fn linear_from_srgb(color: [f32; 3]) -> [f32; 3] {
    color.map(|channel| {
        let channel = channel.clamp(0.0, 1.0);
        if channel > 0.040_45 { ((channel + 0.055) / 1.055).powf(2.4) } else { channel / 12.92 }
    })
}
