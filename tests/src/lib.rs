//! The harness of the tests: a shared device, stages run alone, meshes, lights, and comparers that can fail.

pub mod compare;
pub mod gpu;
pub mod harness;
pub mod image_compare;
pub mod stage_run;
