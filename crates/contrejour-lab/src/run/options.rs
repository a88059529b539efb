//! What is asked of a run.

use std::path::PathBuf;

use super::effort::Effort;
use super::shard::Shard;
use super::subject::NamedScene;
use crate::report::{Extent, Header};

/// Map sizes of a quick report. Unit: texels.
pub const QUICK_SIZES: [u32; 3] = [256, 512, 1024];

/// Map sizes of a full report. Unit: texels.
pub const FULL_SIZES: [u32; 4] = [256, 512, 1024, 2048];

/// Scenes of a quick report, all built in: one with each kind of light.
pub const QUICK_SCENES: [&str; 3] = ["square", "sundial", "lamp"];

/// What is asked of a run.
#[derive(Clone, Debug)]
pub struct RunOptions {
    /// What is drawn. Range: at least one, with names of their own.
    pub scenes: Vec<NamedScene>,
    /// Texels along the shadow map's side. Range: at least one, each once.
    pub sizes: Vec<u32>,
    /// Names of techniques and families; all where it is empty. With names the report has no figures of the papers, which
    /// compare techniques of their own.
    pub techniques: Vec<String>,
    /// How much is measured. [`Effort::of`] has what reports are made with.
    pub effort: Effort,
    /// Seed of everything random.
    pub seed: u64,
    /// Which part of the work is done.
    pub shard: Shard,
    /// Whether what earlier runs left in the folder is measured again.
    pub restart: bool,
    /// The command that makes the report again.
    pub command: String,
    /// Where everything goes; made where it is missing.
    pub folder: PathBuf,
}

/// The map sizes of an extent where none are asked for.
pub fn default_sizes(extent: Extent) -> &'static [u32] {
    match extent {
        Extent::Quick => &QUICK_SIZES,
        Extent::Full => &FULL_SIZES,
    }
}

impl RunOptions {
    pub(super) fn header(&self) -> Header {
        let Effort { extent, picture_size, truth_target_error, .. } = self.effort;
        Header {
            command: self.command.clone(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            extent,
            seed: self.seed,
            picture_size,
            truth_samples_max: self.effort.truth_samples_max(),
            truth_target_error,
            groups_asked: self.scenes.len() * self.sizes.len(),
            shard: (self.shard != Shard::WHOLE).then(|| self.shard.to_string()),
        }
    }
}
