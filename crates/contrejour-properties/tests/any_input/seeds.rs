//! The seeds of the fuzz targets, which must be worth starting from.

use std::fs;
use std::io::Cursor;
use std::path::{Path, PathBuf};

use contrejour_properties::{Format, check_mesh_file, check_picture, check_rig, check_scene_text};
use image::{DynamicImage, ImageFormat, Rgba, RgbaImage};

/// Files in a target's folder of seeds, by name.
fn files(target: &str) -> Vec<PathBuf> {
    let folder = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../../fuzz/seeds")).join(target);
    let entries = fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("is readable").path()).collect();
    paths.sort();
    paths
}

fn read(path: &PathBuf) -> Vec<u8> {
    fs::read(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn folder(format: Format) -> &'static str {
    match format {
        Format::Obj => "obj",
        Format::Gltf => "gltf",
        Format::Ply => "ply",
        Format::Stl => "stl",
    }
}

/// Seeds of a mesh format.
pub fn seeds(format: Format) -> Vec<Vec<u8>> {
    files(folder(format)).iter().map(read).collect()
}

/// Seeds of scene files.
pub fn scene_seeds() -> Vec<String> {
    let text = |path| String::from_utf8(read(path)).expect("scenes are text");
    files("scene").iter().map(text).collect()
}

/// Small pictures of both formats.
pub fn picture_seeds() -> Vec<Vec<u8>> {
    let picture = RgbaImage::from_fn(9, 7, |x, y| Rgba([20 * x as u8, 30 * y as u8, 200, 255 - 9 * x as u8]));
    let encode = |picture: DynamicImage, format| {
        let mut bytes = Cursor::new(Vec::new());
        picture.write_to(&mut bytes, format).expect("it fits into memory");
        bytes.into_inner()
    };
    let picture = DynamicImage::from(picture);
    vec![
        encode(picture.clone(), ImageFormat::Png),
        encode(picture.to_luma16().into(), ImageFormat::Png),
        encode(picture.to_rgb8().into(), ImageFormat::Jpeg),
    ]
}

#[test]
fn all_pictures_are_decoded() {
    assert!(picture_seeds().iter().all(|bytes| check_picture(bytes) == Some(63)));
}

#[test]
fn most_seeds_load() {
    for format in Format::ALL {
        let seeds = seeds(format);
        let loaded: Vec<_> = seeds.iter().filter_map(|bytes| check_mesh_file(format, bytes)).collect();
        assert!(loaded.len() + 1 >= seeds.len() && loaded.len() >= 2, "{format:?}: {loaded:?}");
        assert!(loaded.iter().all(|loaded| loaded.triangles > 0), "{format:?}: {loaded:?}");
    }
    let deforming = seeds(Format::Gltf).iter().filter_map(|bytes| check_rig(bytes)).filter(|&parts| parts > 0).count();
    assert!(deforming >= 2, "{deforming} seeds deform");
    let scenes: Vec<_> = scene_seeds().iter().filter_map(|text| check_scene_text(text)).collect();
    assert!(scenes.len() >= 2, "{scenes:?}");
}
