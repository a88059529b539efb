//! Many moving lights over many moving casters: what a frame costs the CPU and the device, and whether every silhouette
//! is the exact one all the same.
//!
//! Lights and casters walk on paths that follow from a seed and the number of the frame alone, so that a run can be had
//! again. [`run`] draws frame after frame for a while, and keeps two frames under way; [`Summary`] is what came of it.

mod error;
mod kind;
mod options;
mod paths;
mod run;
mod summary;
mod sweep;
mod verify;
mod world;

pub use error::StressError;
pub use kind::LightMix;
pub use options::StressOptions;
pub use run::{Event, run};
pub use summary::{StageTime, Summary};
pub use sweep::{SWEEP_COLUMNS, Sweep, SweepAxis, sweep};
