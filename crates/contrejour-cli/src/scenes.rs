//! The scene that an argument names.

use std::path::{Path, PathBuf};

use contrejour_scene::{BUILT_IN_SCENES, Scene, SceneError};

/// Why there is no scene.
#[derive(Debug, thiserror::Error)]
pub enum OpenSceneError {
    #[error(
        "{} is neither a file nor a built-in scene; give a scene (.toml), a mesh (.obj, .gltf, .glb, .ply, .stl) or one of {}",
        path.display(),
        BUILT_IN_SCENES.iter().map(|scene| scene.name).collect::<Vec<_>>().join(", ")
    )]
    Nothing { path: PathBuf },
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// The scene of a file, a built-in one by its name, or without a name the default one. A file goes before a built-in
/// scene of the same name.
pub fn open(name: Option<&str>) -> Result<Scene, OpenSceneError> {
    open_seen_by(name, None)
}

/// The same, seen by a camera of the file.
pub fn open_seen_by(name: Option<&str>, camera: Option<&str>) -> Result<Scene, OpenSceneError> {
    let path = name.map(Path::new);
    if let Some(path) = path.filter(|path| path.exists() || path.extension().is_some()) {
        return Ok(Scene::open_seen_by(path, camera)?);
    }
    if let (Some(path), Some(_)) = (path, camera) {
        return Err(SceneError::CameraOfScene { path: path.into() }.into());
    }
    match Scene::built_in(name) {
        Some(scene) => Ok(scene?),
        None => Err(OpenSceneError::Nothing { path: path.unwrap_or(Path::new("")).into() }),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn built_in_scenes_have_names_and_one_is_the_default() {
        assert!(open(None).is_ok());
        for scene in BUILT_IN_SCENES {
            assert!(open(Some(scene.name)).is_ok(), "{}", scene.name);
        }
    }

    #[test]
    fn an_unknown_name_is_told_the_known_ones() {
        let error = open(Some("no-such-scene")).expect_err("there is none").to_string();
        assert!(error.contains("no-such-scene") && error.contains(BUILT_IN_SCENES[0].name), "{error}");
    }

    #[test]
    fn a_missing_file_is_told_as_one() {
        assert!(matches!(open(Some("no/such/file.obj")), Err(OpenSceneError::Scene(_))));
    }
}
