//! Measuring contrejour: what a shadow costs, how wrong it is, what extreme cases do to it, how many lights and
//! casters it bears, and reports that tell it.

pub mod metrics;
mod mirror_frame;
pub mod report;
pub mod run;
pub mod stability;
pub mod stress;
#[cfg(test)]
mod test_device;
mod torus;

pub use torus::{Triangles, torus};
