//! Topology-aware meshes for contrejour: triangles in; welded, diagnosed, GPU-ready topology out.

mod load;
mod normals;
mod topology;
mod triangle_mesh;

pub use load::*;
pub use topology::*;
pub use triangle_mesh::*;
