//! Measuring contrejour: benches and reports.

mod torus;

pub use torus::{Triangles, torus};
