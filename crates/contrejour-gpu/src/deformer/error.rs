//! What can go wrong with deforming meshes, and what to do about it.

use super::DeformHandle;
use crate::error::DeviceError;

/// Why [`Deformer::new`](super::Deformer::new) refuses.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NewDeformerError {
    /// The device has less than the library needs.
    #[error(
        "the device allows {available} storage buffers a shader stage, contrejour needs {needed}: create the device \
         with `Shadows::required_limits()`"
    )]
    Limits {
        /// What the device allows.
        available: u32,
        /// What is needed.
        needed: u32,
    },
    /// The device fails.
    #[error(transparent)]
    Device(#[from] DeviceError),
}

/// Why [`Deformer::add`](super::Deformer::add) refuses.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AddDeformingError {
    /// All meshes together do not fit.
    #[error(
        "with this mesh the {what} of deforming meshes would take {bytes} bytes, and the device allows {most}: \
         simplify the mesh, or use a `Deformer` for each part of the scene"
    )]
    TooLarge {
        /// What of the meshes.
        what: &'static str,
        /// Bytes that there would be.
        bytes: u64,
        /// Bytes that a buffer may have.
        most: u64,
    },
}

/// Why [`Deformer::prepare`](super::Deformer::prepare) refuses.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DeformError {
    /// A mesh has no pose.
    #[error("the mesh {caster:?} has no pose: set one with `set_pose`, or remove it")]
    MissingPose {
        /// The handle.
        caster: DeformHandle,
    },
    /// The device fails.
    #[error(transparent)]
    Device(#[from] DeviceError),
}

/// Why [`Deformer::set_pose`](super::Deformer::set_pose) refuses.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SetPoseError {
    /// It names a mesh that is not there.
    #[error("a pose names the mesh {caster:?}, which is not here: use the handle of `add` and no removed one")]
    UnknownCaster {
        /// The handle.
        caster: DeformHandle,
    },
    /// A pose has another number of joints or weights than its mesh.
    #[error("the pose of the mesh {caster:?} has {given} {what}, the mesh {needed}: give one for each")]
    Count {
        /// The handle.
        caster: DeformHandle,
        /// Joint matrices or morph weights.
        what: &'static str,
        /// How many the pose has.
        given: usize,
        /// How many the mesh has.
        needed: u32,
    },
    /// A number of a pose is not finite in 32 bits.
    #[error("the pose of the mesh {caster:?} has {what} that are not finite 32-bit numbers: keep matrices below 3e38")]
    NotFinite {
        /// The handle.
        caster: DeformHandle,
        /// Joint matrices or morph weights.
        what: &'static str,
    },
}
