//! What must hold for any input: of a mesh file, of its rig, of a scene file, and of triangles under a light.
//!
//! Each property is a function that panics where it does not hold. Fuzz targets call it with what the fuzzer makes up,
//! tests with what proptest does, so both mean the same.

mod caster;
mod caster_frame;
mod hostile;
mod mesh_file;
mod most_bytes;
mod picture;
#[cfg(test)]
mod planted;
mod rig;
mod scene_text;
mod silhouette;

pub use caster::{Caster, Lens};
pub use mesh_file::{Format, Loaded, check_mesh_file};
pub use most_bytes::{most_bytes_of_mesh_file, most_bytes_of_picture, most_bytes_of_scene, most_bytes_of_silhouette};
pub use picture::check_picture;
pub use rig::check_rig;
pub use scene_text::check_scene_text;
pub use silhouette::check_silhouette;
