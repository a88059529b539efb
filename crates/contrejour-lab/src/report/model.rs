//! What was measured, as data. Fields keep their order in JSON.

use serde::{Deserialize, Serialize};

use super::cost::{Cost, CostRatio};
use super::figure::Figure;
use crate::metrics::{ErrorFigures, MotionExcess, UmbraArea};

/// Everything that one run, or several merged ones, found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Report {
    /// How it was made.
    pub header: Header,
    /// One group a scene and map size, in the order of the page.
    pub groups: Vec<Group>,
    /// Tables and figures of the papers, redone.
    pub figures: Vec<Figure>,
}

/// How a report was made. Groups of shards belong together where all of this but the command and the
/// shard is equal.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Header {
    /// The command that makes it again.
    pub command: String,
    /// Version of contrejour.
    pub version: String,
    /// Whether it was made small, to be ready soon.
    pub extent: Extent,
    /// Seed of everything random.
    pub seed: u64,
    /// Width and height of the compared pictures in pixels.
    pub picture_size: [u32; 2],
    /// Most light samples a pixel of the truth.
    pub truth_samples_max: u64,
    /// Standard error of visibility at which the truth stops sampling. Range: 0 (never) to 1.
    pub truth_target_error: f64,
    /// How many groups all of it has; fewer are there where it is a shard or time ran out. 0 where it is not known.
    #[serde(default)]
    pub groups_asked: usize,
    /// Which shard it is, e.g. `2/3`; none where it is all of a run.
    #[serde(default)]
    pub shard: Option<String>,
}

/// How much a report measures.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Extent {
    /// A few scenes and sizes, small pictures.
    Quick,
    /// Everything.
    Full,
}

/// What a group was measured on. Shards of one report may come from several.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Machine {
    /// Device, driver and backend, as they call themselves.
    pub device: String,
    /// Whether the device is the CPU: its times then say little about a GPU's.
    pub is_software: bool,
    /// Threads that the CPU runs at once.
    pub cores: u32,
}

/// One scene at one map size. All its contestants were timed taking turns, frame by frame.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Group {
    /// Name of the scene.
    pub scene: String,
    /// Texels along the shadow map's side.
    pub map_size: u32,
    /// Faces of all casters.
    pub faces: u64,
    /// Edges of all casters that can be in a silhouette.
    pub edges: u64,
    /// Size of the light as its kind means it: radius in metres, or angular radius in radians.
    pub light_size: f64,
    /// What it was measured on.
    pub machine: Machine,
    /// How exact the truth is.
    pub truth: Truth,
    /// Picture of the truth: its path from the report's folder.
    pub truth_picture: Option<String>,
    /// Who was measured.
    pub contestants: Vec<Contestant>,
}

/// How exact a group's truth is, over its receiver pixels.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Truth {
    /// Mean number of light samples a pixel.
    pub samples_mean: f64,
    /// Root of the mean squared standard error of visibility: the part of every RMSE that is the truth's own.
    pub standard_error_rms: f64,
    /// Largest standard error of a pixel.
    pub standard_error_max: f64,
}

/// One technique with one set of parameters.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Contestant {
    /// Names it among its group, e.g. `pcss 16+32, kernel 1.5`.
    pub label: String,
    /// What it is a variant of, e.g. `pcss 16+32`. A sweep over a technique's parameters is one family.
    pub family: String,
    /// Name of its technique, as `--technique` takes it.
    pub technique: String,
    /// Its parameters, as its own literature names them.
    pub parameters: Vec<Parameter>,
    /// How wrong it is.
    pub errors: Errors,
    /// What it costs.
    pub cost: Cost,
    /// Its visibility as a picture: path from the report's folder.
    pub picture: Option<String>,
    /// Its false-colour difference from the truth: path from the report's folder.
    pub difference: Option<String>,
    /// Whether it stands for its family: the variant of least RMSE, of equal ones the fastest. [`Group::settle`] finds
    /// out.
    #[serde(default)]
    pub stands: bool,
    /// Whether no other contestant of its group is both as exact and as fast, and better in one. [`Group::settle`]
    /// finds out.
    #[serde(default)]
    pub on_front: bool,
    /// Its cost over that of the plain shadow map, where the group has one. [`Group::settle`] computes it.
    #[serde(default)]
    pub ratio: Option<CostRatio>,
}

/// A parameter and its value, both as text.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Parameter {
    /// Its name, e.g. `blocker samples`.
    pub name: String,
    /// Its value with unit, e.g. `16`.
    pub value: String,
}

/// How wrong a contestant is.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Errors {
    /// Over all receiver pixels.
    pub receivers: ErrorFigures,
    /// Inside the true penumbra; none where there is none, as with a light of no size.
    pub penumbra: Option<ErrorFigures>,
    /// Umbra that is too large or too small.
    pub umbra: UmbraArea,
    /// Mean FLIP of the shaded picture (Andersson et al. 2020), 0 to 1; none where it was not measured.
    pub flip: Option<f64>,
    /// How much it jumps while the light moves; none where it was not measured.
    pub motion: Option<MotionExcess>,
}
