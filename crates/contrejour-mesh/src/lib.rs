//! Topology-aware meshes for contrejour: triangles in; welded, diagnosed, GPU-ready topology out.

mod camera_and_light;
mod load;
mod mask;
mod normals;
mod planes;
mod read_file;
mod rig;
mod tam;
mod texture;
mod topology;
mod triangle_mesh;

pub use camera_and_light::{FileCamera, FileLight, FileLightKind, OutlookError};
pub use load::*;
pub use mask::*;
pub use planes::FacePlanes;
pub use read_file::{ReadFileError, read_file};
pub use rig::{
    AnimatedModel, Animation, DeformingMesh, DeformingMeshError, NodeTransform, PartPose, Pose, PoseError, Rig,
    RigNode, RigPart, Skin, UnknownAnimation,
};
pub use tam::{
    TamError, TamFace, TamForm, TamMemory, TamOptions, TamPrecision, TamStream, edge_fans, face_neighbours,
    face_neighbours_in_pairs,
};
pub use texture::{EncodedImage, Texture, TextureFilter, TextureWrap};
pub use topology::*;
pub use triangle_mesh::*;
