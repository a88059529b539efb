//! Figures of silhouettes alone: how large they are, and how fast three ways find them.

mod device_stages;
mod lone_mesh;
mod ordered_map;
pub(super) mod size;
pub(super) mod time;

pub(super) use lone_mesh::LoneMesh;
