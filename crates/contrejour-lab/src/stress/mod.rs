//! Many moving lights over many moving casters: what a frame costs the CPU and the device, and whether every silhouette
//! is the exact one all the same.
//!
//! Casters are tori: every second one is mirrored, every third one stretched, and every fourth one bends by two joints and
//! swells by a morph target. Lights, casters and the eye that cascades follow walk on paths that follow from a seed and the
//! number of the frame alone, so that a run can be had again. [`run`] draws frame after frame for a while, with as many
//! [under way](contrejour_render::Gpu::frames_in_flight) as any renderer of ours; [`Summary`] is what came of it.

mod error;
mod flexible;
mod kind;
mod options;
mod own;
mod paths;
mod pictures;
mod run;
mod show;
mod stopwatch;
mod summary;
mod sweep;
mod verify;
mod world;

pub use error::StressError;
pub use kind::LightMix;
pub use options::{Motion, StressOptions, Variety};
pub use run::{Event, run};
pub use show::Show;
pub use summary::{LightSummary, StageTime, Summary};
pub use sweep::{SWEEP_COLUMNS, Sweep, SweepAxis, sweep};
