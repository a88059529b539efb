//! The scenes that come with contrejour.

use std::path::Path;

use crate::{Scene, SceneError};

/// A scene that comes with contrejour.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BuiltInScene {
    /// Its name.
    pub name: &'static str,
    /// Its scene file.
    pub toml: &'static str,
}

/// All of them; the first is the one that is shown when none is asked for.
pub const BUILT_IN_SCENES: &[BuiltInScene] = &[
    BuiltInScene { name: "elephant", toml: include_str!("../assets/scenes/elephant.toml") },
    BuiltInScene { name: "knot", toml: include_str!("../assets/scenes/knot.toml") },
    BuiltInScene { name: "cylinder", toml: include_str!("../assets/scenes/cylinder.toml") },
    BuiltInScene { name: "fence", toml: include_str!("../assets/scenes/fence.toml") },
    BuiltInScene { name: "boxes", toml: include_str!("../assets/scenes/boxes.toml") },
    BuiltInScene { name: "sundial", toml: include_str!("../assets/scenes/sundial.toml") },
    BuiltInScene { name: "lamp", toml: include_str!("../assets/scenes/lamp.toml") },
    BuiltInScene { name: "square", toml: include_str!("../assets/scenes/square.toml") },
    BuiltInScene { name: "night", toml: include_str!("../assets/scenes/night.toml") },
];

impl BuiltInScene {
    /// The scene.
    ///
    /// # Errors
    /// None for the scenes in [`BUILT_IN_SCENES`], as a test asserts.
    pub fn load(&self) -> Result<Scene, SceneError> {
        Scene::from_toml(self.toml, Path::new(""), &format!("built-in scene {}", self.name))
    }
}

impl Scene {
    /// The built-in scene of that name, if there is one; `None` as a name asks for the default scene.
    ///
    /// # Errors
    /// As [`BuiltInScene::load`].
    pub fn built_in(name: Option<&str>) -> Option<Result<Self, SceneError>> {
        let named = |scene: &&BuiltInScene| name.is_none_or(|name| name == scene.name);
        BUILT_IN_SCENES.iter().find(named).map(BuiltInScene::load)
    }
}
