//! Files that nobody here made.

use std::path::{Path, PathBuf};
use std::sync::Once;
use std::{env, fs};

use contrejour_mesh::load;

use super::TestMesh;

/// Where the files are, if not beside the checkout.
const MESHES: &str = "CONTREJOUR_MESHES";

/// The folder; none where it is missing, which is said once.
pub fn shared_folder() -> Option<PathBuf> {
    let folder = env::var_os(MESHES)
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../shared/meshes"), PathBuf::from);
    if folder.is_dir() {
        return Some(folder);
    }
    static SAID: Once = Once::new();
    SAID.call_once(|| eprintln!("no folder {}: testing with the project's own meshes ({MESHES})", folder.display()));
    None
}

/// Files of the shared folder that no loader accepts: indices out of range, coordinates that are not finite.
const REFUSED: [&str; 4] =
    ["BoxWithInfinites.glb", "IndexOutOfRange/IndexOutOfRange.gltf", "inf_nan.obj", "invalid_index.obj"];

/// The files of a folder whose path below it is wanted, in the order of their paths; those that do not load say why.
pub fn of_folder(folder: &Path, is_wanted: impl Fn(&str) -> bool) -> impl Iterator<Item = Result<TestMesh, String>> {
    let mut paths = Vec::new();
    collect_paths(folder, &mut paths);
    paths.sort();
    paths.retain(|path| is_wanted(&name_below(folder, path)));
    paths.into_iter().map(move |path| open(folder, &path))
}

/// Every file of the shared folder but those that are to be refused, in the order of their paths; none where there is no
/// folder.
///
/// # Panics
///
/// When another file does not load.
pub fn shared() -> Vec<TestMesh> {
    let Some(folder) = shared_folder() else { return Vec::new() };
    let is_refused = |path: &str| REFUSED.iter().any(|refused| Path::new(path).ends_with(refused));
    let meshes = of_folder(&folder, |path| !is_refused(path));
    meshes.map(|mesh| mesh.unwrap_or_else(|error| panic!("{error}"))).collect()
}

/// The files of the shared folder with these paths below it; none where there is no folder.
///
/// # Panics
///
/// When the folder is there and a file does not load.
pub fn shared_named(names: &[&str]) -> Vec<TestMesh> {
    let Some(folder) = shared_folder() else { return Vec::new() };
    names.iter().map(|name| open(&folder, &folder.join(name)).unwrap_or_else(|error| panic!("{error}"))).collect()
}

fn open(folder: &Path, path: &Path) -> Result<TestMesh, String> {
    let name = name_below(folder, path);
    let file = load(path).map_err(|error| error.to_string())?;
    TestMesh::of_file(&name, &file)
}

fn name_below(folder: &Path, path: &Path) -> String {
    path.strip_prefix(folder).unwrap_or(path).display().to_string()
}

fn collect_paths(folder: &Path, paths: &mut Vec<PathBuf>) {
    let Ok(entries) = fs::read_dir(folder) else { return };
    for path in entries.filter_map(|entry| entry.ok().map(|entry| entry.path())) {
        if path.is_dir() {
            collect_paths(&path, paths);
        } else if is_mesh(&path) {
            paths.push(path);
        }
    }
}

fn is_mesh(path: &Path) -> bool {
    let extension = path.extension().map(|extension| extension.to_ascii_lowercase());
    ["obj", "gltf", "glb", "ply", "stl"].into_iter().any(|known| extension.as_deref() == Some(known.as_ref()))
}
