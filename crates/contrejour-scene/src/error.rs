//! What can be wrong with a scene.

use std::path::PathBuf;

use contrejour_mesh::{LoadError, ReadFileError};
use contrejour_plan::SettingsError;

use crate::Scene;
use crate::file_scene::UnknownCamera;
use crate::shapes::ShapeError;

/// Why there is no scene.
#[derive(Debug, thiserror::Error)]
pub enum SceneError {
    /// The scene file is not read.
    #[error(transparent)]
    File(#[from] ReadFileError),
    /// The scene file is no text.
    #[error("{path}: byte {byte} is not UTF-8 text; save the scene as UTF-8", path = path.display())]
    NotText {
        /// The file.
        path: PathBuf,
        /// The first byte that is none, from 0.
        byte: usize,
    },
    /// Something in the scene file is wrong.
    #[error("{place}: {problem}")]
    InFile {
        /// Where.
        place: Place,
        /// What, and what to do.
        problem: Box<Problem>,
    },
    /// A mesh file has no camera of the name.
    #[error("{path}: {source}", path = path.display())]
    UnknownCamera {
        /// The file.
        path: PathBuf,
        /// The name, and those that there are.
        source: UnknownCamera,
    },
    /// A camera was named for a scene file.
    #[error("{path}: a scene file has one camera, of no name; leave the name out", path = path.display())]
    CameraOfScene {
        /// The file.
        path: PathBuf,
    },
    /// A mesh that was given alone cannot be loaded.
    #[error(transparent)]
    Mesh(#[from] LoadError),
}

/// A place in a scene file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Place {
    /// The file as it was named.
    pub file: String,
    /// Line, from 1.
    pub line: usize,
    /// Column in characters, from 1.
    pub column: usize,
}

impl std::fmt::Display for Place {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(formatter, "{}:{}:{}", self.file, self.line, self.column)
    }
}

/// What is wrong at a place in a scene file, and what to do about it.
#[derive(Debug, thiserror::Error)]
pub enum Problem {
    /// Not TOML.
    #[error("this is not valid TOML: {0}")]
    Syntax(String),
    /// A key that the section does not have.
    #[error("{section} has no key `{key}`; it has {known}", key = key.escape_debug(), known = list(known))]
    UnknownKey {
        /// The key.
        key: String,
        /// The section it stands in.
        section: String,
        /// The keys that the section has.
        known: &'static [&'static str],
    },
    /// A key that must be there.
    #[error("{section} needs the key `{key}`; add it")]
    MissingKey {
        /// The key.
        key: &'static str,
        /// The section it is missing from.
        section: String,
    },
    /// A value of the wrong type.
    #[error("`{key}` is {found}; give {expected}")]
    WrongType {
        /// The key.
        key: String,
        /// What it must be.
        expected: String,
        /// What it is.
        found: &'static str,
    },
    /// A number that makes no sense there.
    #[error("`{key}` is {value}; give {expected}")]
    OutOfRange {
        /// The key.
        key: String,
        /// What it is.
        value: String,
        /// What it must be.
        expected: String,
    },
    /// A name that stands for nothing.
    #[error("`{key}` is {name:?}; give one of {known}", known = list(known))]
    UnknownName {
        /// The key.
        key: String,
        /// The name.
        name: String,
        /// The names that there are.
        known: &'static [&'static str],
    },
    /// A picture that is too large or has no pixel.
    #[error("a picture of {width} x {height} pixels cannot be made; give 1 to {most} each way", most = Scene::MAX_SIDE)]
    PictureSize {
        /// Width, in pixels.
        width: u32,
        /// Height, in pixels.
        height: u32,
    },
    /// A shadow map that no device has.
    #[error("a shadow map of {size} texels a side cannot be made; give 1 to {most}, 1024 is common")]
    MapSize {
        /// What was given.
        size: u32,
        /// The largest.
        most: u32,
    },
    /// Shadow settings out of their ranges.
    #[error(transparent)]
    Shadow(#[from] SettingsError),
    /// More meshes than a scene may have.
    #[error("the scene has more than {most} meshes; join some of them", most = Scene::MAX_MESHES)]
    TooManyMeshes,
    /// More triangles than the shapes of a scene may have together.
    #[error("the shapes up to here have more than {most} triangles together; give them fewer segments", most = Scene::MAX_SHAPE_TRIANGLES)]
    TooManyShapeTriangles,
    /// A file name that no message can show.
    #[error("`file` has a line break or another control character in it; rename the file")]
    FileName,
    /// A mesh with no or with two origins.
    #[error("a mesh needs either `shape` or `file`; give one of them, not both")]
    ShapeOrFile,
    /// No light, or more than a scene may have.
    #[error("there are {count} lights; give 1 to {most}", most = Scene::MAX_LIGHTS)]
    LightCount {
        /// How many.
        count: usize,
    },
    /// An inner cone that is wider than the cone.
    #[error("`inner_cone_angle_degrees` is {inner}, and the cone's angle is {cone}; give no more than that")]
    InnerCone {
        /// What was given, in degrees.
        inner: f64,
        /// Full opening angle of the cone, in degrees.
        cone: f64,
    },
    /// Depths in the wrong order.
    #[error("`far` is {far}, not beyond `near`, {near}; give more")]
    FarNotBeyondNear {
        /// Nearest depth.
        near: f64,
        /// Farthest depth.
        far: f64,
    },
    /// Two points that must differ, or a direction of no length or along the view.
    #[error("`{key}` leaves no direction: {remedy}")]
    NoDirection {
        /// The key.
        key: &'static str,
        /// What to do.
        remedy: &'static str,
    },
    /// A shape that cannot be generated.
    #[error(transparent)]
    Shape(#[from] ShapeError),
    /// A mesh file that cannot be loaded.
    #[error(transparent)]
    Mesh(#[from] LoadError),
}

fn list(names: &[&str]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}
