//! Measuring contrejour: what a shadow costs, how wrong it is, and a report that tells it.

pub mod metrics;
pub mod report;
pub mod run;
mod torus;

pub use torus::{Triangles, torus};
