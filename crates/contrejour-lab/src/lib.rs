//! Measuring contrejour: what a shadow costs, how wrong it is, and a report that tells it.

pub mod metrics;
pub mod report;
mod torus;

pub use torus::{Triangles, torus};
