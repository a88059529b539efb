//! Topology-aware meshes for contrejour: triangles in; welded, diagnosed, GPU-ready topology out.

mod topology;
mod triangle_mesh;

pub use topology::*;
pub use triangle_mesh::*;
