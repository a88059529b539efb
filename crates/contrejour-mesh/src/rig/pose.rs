//! Where everything is at a time, in 64-bit floats.

use glam::{DMat4, DVec3};

use super::animation::ChannelTarget;
use super::{Animation, NodeTransform, Rig, RigPart};
use crate::OutlookError;

/// All nodes at a time.
#[derive(Clone, Debug, PartialEq)]
pub struct Pose {
    /// World space from each node's space, by node.
    pub world_from_nodes: Vec<DMat4>,
    /// Weights of morph targets, by node.
    pub morph_weights: Vec<Vec<f64>>,
}

/// One mesh at a time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PartPose {
    /// World space from the mesh's object space, after what moves its vertices against each other.
    pub world_from_object: DMat4,
    /// For each joint of its skin, object space from the space in which the mesh was bound.
    pub joint_matrices: Vec<DMat4>,
    /// Weight of each of its morph targets.
    pub morph_weights: Vec<f64>,
}

/// A pose that no number can hold.
#[derive(Debug, thiserror::Error)]
pub enum PoseError {
    /// A node's matrix or weights are too large or no numbers.
    #[error("at {time} s the place or a weight of node {node} is not finite; correct the keys of its animation")]
    NotFinite {
        /// The node.
        node: usize,
        /// The time, in seconds.
        time: f64,
    },
    /// A node is where its camera or light can't look or shine from.
    #[error("at {time} s the camera or light of node {node}: {source}")]
    Outlook {
        /// The node.
        node: usize,
        /// The time, in seconds.
        time: f64,
        /// Why it can't.
        source: OutlookError,
    },
}

impl Rig {
    /// All nodes at a time, in seconds; at rest without an animation. Before the first and after the last key of a
    /// channel that key holds.
    ///
    /// # Errors
    ///
    /// [`PoseError`] where a number overflows.
    pub fn pose(&self, animation: Option<&Animation>, time: f64) -> Result<Pose, PoseError> {
        let mut transforms: Vec<NodeTransform> = self.nodes.iter().map(|node| node.transform).collect();
        let mut morph_weights: Vec<Vec<f64>> = self.nodes.iter().map(|node| node.morph_weights.clone()).collect();
        if let Some(Animation { samplers, channels, .. }) = animation {
            for channel in channels {
                let sampler = &samplers[channel.sampler];
                let vector = || DVec3::from_slice(&sampler.at(time));
                match (channel.target, &mut transforms[channel.node]) {
                    (ChannelTarget::MorphWeights, _) => morph_weights[channel.node] = sampler.at(time),
                    (_, NodeTransform::Matrix(_)) => {}
                    (ChannelTarget::Translation, NodeTransform::Parts { translation, .. }) => *translation = vector(),
                    (ChannelTarget::Scale, NodeTransform::Parts { scale, .. }) => *scale = vector(),
                    (ChannelTarget::Rotation, NodeTransform::Parts { rotation, .. }) => {
                        *rotation = sampler.rotation_at(time);
                    }
                }
            }
        }

        let mut world_from_nodes = vec![DMat4::IDENTITY; self.nodes.len()];
        for &node in &self.parents_first {
            let parent_from_node = transforms[node].matrix();
            world_from_nodes[node] = match self.nodes[node].parent {
                Some(parent) => world_from_nodes[parent] * parent_from_node,
                None => parent_from_node,
            };
            let is_finite = world_from_nodes[node].is_finite() && morph_weights[node].iter().all(|w| w.is_finite());
            if !is_finite {
                return Err(PoseError::NotFinite { node, time });
            }
        }
        Ok(Pose { world_from_nodes, morph_weights })
    }

    /// One mesh of a pose.
    pub fn part_pose(&self, part: &RigPart, pose: &Pose) -> PartPose {
        let morph_weights = pose.morph_weights[part.node].clone();
        match part.skin.map(|skin| &self.skins[skin]) {
            None => PartPose {
                world_from_object: pose.world_from_nodes[part.node],
                joint_matrices: Vec::new(),
                morph_weights,
            },
            Some(skin) => {
                let pairs = skin.joints.iter().zip(&skin.inverse_binds);
                let joint_matrices = pairs.map(|(&joint, inverse_bind)| pose.world_from_nodes[joint] * inverse_bind);
                PartPose { world_from_object: DMat4::IDENTITY, joint_matrices: joint_matrices.collect(), morph_weights }
            }
        }
    }
}
