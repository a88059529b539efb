//! What moves a model: nodes, skins, morph targets and animations, beside the triangles at rest.

#[cfg_attr(not(feature = "gltf"), expect(dead_code, reason = "the loader of glTF makes animations"))]
mod animation;
mod bounds;
mod deforming;
mod pose;
#[cfg_attr(not(feature = "gltf"), expect(dead_code, reason = "the loader of glTF makes animations"))]
mod sampler;

use std::sync::Arc;

use glam::{DMat4, DQuat, DVec3};

use crate::MeshFile;

pub use animation::{Animation, UnknownAnimation};
#[cfg(feature = "gltf")]
pub(crate) use animation::{Channel, ChannelTarget};
pub use deforming::{DeformingMesh, DeformingMeshError};
pub use pose::{PartPose, Pose, PoseError};
#[cfg(feature = "gltf")]
pub(crate) use sampler::{Interpolation, Sampler, rotation};

/// A mesh file with what moves it.
#[derive(Clone, Debug, Default)]
pub struct AnimatedModel {
    /// The meshes at rest, as [`load`](crate::load) gives them.
    pub file: MeshFile,
    /// What moves them.
    pub rig: Rig,
}

/// Nodes with their skins and animations, and which mesh each of them moves. The default has none of them.
#[derive(Clone, Debug, Default)]
pub struct Rig {
    /// By their index in the file.
    pub nodes: Vec<RigNode>,
    /// By their index in the file; empty where no mesh has them.
    pub skins: Vec<Skin>,
    /// By their index in the file.
    pub animations: Vec<Animation>,
    /// One for each of [`MeshFile::nodes`], in their order; none where the file's format knows no nodes.
    pub parts: Vec<RigPart>,
    /// Indices of all nodes, parents before their children.
    pub(crate) parents_first: Vec<usize>,
}

/// A node at rest.
#[derive(Clone, Debug, PartialEq)]
pub struct RigNode {
    /// Index of its parent.
    pub parent: Option<usize>,
    /// The parent's space, or the world, from its own.
    pub transform: NodeTransform,
    /// Weights of its mesh's morph targets; as many as there are.
    pub morph_weights: Vec<f64>,
}

/// How a node stands in its parent.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum NodeTransform {
    /// A matrix, which no animation moves.
    Matrix(DMat4),
    /// Scaled, then turned, then moved.
    Parts {
        /// Moves.
        translation: DVec3,
        /// Turns; of unit length.
        rotation: DQuat,
        /// Scales along the node's own axes.
        scale: DVec3,
    },
}

impl NodeTransform {
    /// The parent's space from the node's.
    pub fn matrix(&self) -> DMat4 {
        match *self {
            Self::Matrix(matrix) => matrix,
            Self::Parts { translation, rotation, scale } => {
                DMat4::from_scale_rotation_translation(scale, rotation, translation)
            }
        }
    }
}

/// Joints that move the vertices of a mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Skin {
    /// Node of each joint.
    pub joints: Vec<usize>,
    /// For each joint, its space from the one in which the mesh was bound.
    pub inverse_binds: Vec<DMat4>,
}

/// A mesh in its place.
#[derive(Clone, Debug)]
pub struct RigPart {
    /// The node that it stands at.
    pub node: usize,
    /// The skin that moves its vertices. Then they stand in world space, whatever the node says (glTF 2.0, 3.7.3.3).
    pub skin: Option<usize>,
    /// What moves its vertices against each other, in the order of the mesh's positions; none where nothing does.
    pub deforming: Option<Arc<DeformingMesh>>,
}
