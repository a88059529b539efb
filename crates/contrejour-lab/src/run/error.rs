//! Why a run stops.

use std::io;
use std::path::PathBuf;

use contrejour_mesh::{ReadFileError, TopologyError};
use contrejour_plan::{CascadeError, LightError};
use contrejour_render::{ComposeError, DrawError, NewContestantError, NewJudgeError, ReadError, SaveError};
use contrejour_scene::shapes::ShapeError;
use contrejour_scene::{NoLight, SceneError};
use contrejour_trace::{OccluderError, TraceError};

use super::contestants::EntrantsError;
use crate::metrics::MetricError;
use crate::report::WriteError;

/// Why a run stops. Groups that were finished are kept, and the same command goes on from there.
#[derive(Debug, thiserror::Error)]
pub enum RunError {
    /// Nobody has a name that was asked for.
    #[error(transparent)]
    Entrants(#[from] EntrantsError),
    /// There is no scene or no map size, so nothing to measure.
    #[error("there is no {what} to measure; give at least one")]
    Nothing {
        /// What there is none of.
        what: &'static str,
    },
    /// Two scenes or two sizes could not be told apart.
    #[error("{what} is there twice; give each scene and size once, scenes with file names of their own")]
    Twice {
        /// The name or size.
        what: String,
    },
    /// A map does not fit on the device.
    #[error("a map of {map_size} texels is larger than this device's {limit}; give smaller --sizes")]
    MapTooLarge {
        /// Texels along its side.
        map_size: u32,
        /// The device's `max_texture_dimension_2d`.
        limit: u32,
    },
    /// The folder holds another run.
    #[error(
        "{folder} holds a run with another {what}; give another folder with -o, or --restart to measure all again",
        folder = folder.display()
    )]
    AnotherRun {
        /// The folder.
        folder: PathBuf,
        /// What differs.
        what: &'static str,
    },
    /// A file of an earlier run is not as it was written.
    #[error("{path} is damaged: {error}; delete it, or measure all again with --restart", path = path.display())]
    Damaged {
        /// The file.
        path: PathBuf,
        /// What is wrong.
        error: serde_json::Error,
    },
    /// A file of an earlier run cannot be read.
    #[error(transparent)]
    File(#[from] ReadFileError),
    /// A file or folder of an earlier run cannot be removed.
    #[error("{path}: {error}; give another folder with -o", path = path.display())]
    Folder {
        /// The file or folder.
        path: PathBuf,
        /// What the system says.
        error: io::Error,
    },
    /// No pixel can be compared.
    #[error(
        "in the picture of {scene} no surface receives shadow, lies in the light's maps and faces all of the light, so \
         there is nothing to compare; move its camera or light"
    )]
    NothingToCompare {
        /// The scene.
        scene: String,
    },
    /// A frame had nothing to do, so its time says nothing.
    #[error("{label} kept its maps though the light moved, so it can't be timed; check the light's position")]
    StoodStill {
        /// The contestant.
        label: String,
    },
    /// A figure names a scene that does not come with contrejour.
    #[error("a figure needs the built-in scene {name}, which is not there; name another in the figure's file")]
    NoScene {
        /// Its name.
        name: &'static str,
    },
    /// A scene has no light.
    #[error(transparent)]
    NoLight(#[from] NoLight),
    /// A scene of a figure is none.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A shape of a figure cannot be generated.
    #[error(transparent)]
    Shape(#[from] ShapeError),
    /// A mesh has no topology.
    #[error(transparent)]
    Topology(#[from] TopologyError),
    /// The scene does not fit on the device.
    #[error(transparent)]
    Judge(#[from] NewJudgeError),
    /// A technique does not run on the device.
    #[error(transparent)]
    Contestant(#[from] NewContestantError),
    /// A frame cannot be drawn.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// A result cannot be read back.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// A picture cannot be shaded.
    #[error(transparent)]
    Compose(#[from] ComposeError),
    /// The tracer does not take the scene's meshes.
    #[error(transparent)]
    Occluders(#[from] OccluderError),
    /// The tracer does not take a receiver or an option.
    #[error(transparent)]
    Trace(#[from] TraceError),
    /// The scene's light has no views.
    #[error(transparent)]
    Views(#[from] CascadeError),
    /// The scene's light is none.
    #[error(transparent)]
    Light(#[from] LightError),
    /// A figure cannot be computed.
    #[error(transparent)]
    Metric(#[from] MetricError),
    /// A result cannot be written as JSON.
    #[error("a result can't be written as JSON: {0}")]
    Json(#[from] serde_json::Error),
    /// A result cannot be kept.
    #[error(transparent)]
    Save(#[from] SaveError),
    /// The report cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}
