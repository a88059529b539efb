//! Scene files of contrejour: cameras, meshes, materials, lights and shadow settings.
//!
//! [`Scene::open`] turns a file from the command line into a scene: a scene file, or a mesh alone, which then stands
//! on a floor with a light and a camera. [`Scene::built_in`] has the scenes that come with contrejour.
//! The format of scene files is described in [`scene_format`]. Y is up, everywhere.

mod animated_scene;
mod assets;
mod bounds;
mod built_in;
mod error;
mod file_scene;
mod framing;
mod obj_text;
mod orbit;
mod scene;
pub mod scene_format;
mod scene_light;
pub mod shapes;
mod texture;
mod toml_text;

pub use animated_scene::{AnimatedScene, AnimatedSceneError, FrameTimes, SceneFrame};
pub use assets::{MESH_ASSETS, MeshAsset};
pub use bounds::Bounds;
pub use built_in::{BUILT_IN_SCENES, BuiltInScene};
pub use error::{Place, Problem, SceneError};
pub use file_scene::UnknownCamera;
pub use obj_text::obj_text;
pub use orbit::orbit;
pub use scene::{Camera, Material, MeshSource, Scene, SceneMesh};
pub use scene_light::{NoLight, SceneLight, SceneLightError};
pub use texture::{TextureError, TextureReader};
