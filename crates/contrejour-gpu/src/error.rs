//! What can go wrong, and what to do about it.

use contrejour_plan::{LightError, PlanError, SettingsError};

use crate::pool::MeshHandle;

/// Why [`Shadows::new`](crate::Shadows::new) refuses.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum NewShadowsError {
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
    /// A setting is out of range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
}

/// Why [`Shadows::add_mesh`](crate::Shadows::add_mesh) refuses.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AddMeshError {
    /// All meshes together are more than 32 bits can index.
    #[error("with this mesh a pool would hold {words} words, at most 4294967295 can be indexed: split the scene")]
    PoolTooLarge {
        /// Words that the largest pool would hold.
        words: u64,
    },
}

/// Why [`Shadows::prepare`](crate::Shadows::prepare) refuses; nothing was uploaded.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PrepareError {
    /// The light is no light.
    #[error(transparent)]
    Light(#[from] LightError),
    /// The device can't hold what the frame needs.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// A caster names a mesh that was not added here.
    #[error("caster {caster} names mesh {mesh:?}, which was not added to this object: use the handle of `add_mesh`")]
    UnknownMesh {
        /// Index of the caster.
        caster: usize,
        /// The handle.
        mesh: MeshHandle,
    },
    /// A caller's position buffer does not hold what the mesh needs.
    #[error(
        "the positions of caster {caster} end at byte {needed} of a buffer of {available} bytes, or its offset \
         ({offset}) or stride ({stride}) is no multiple of 4 or the stride is below 12, or the buffer lacks COPY_SRC: \
         give one position for each source vertex of the mesh"
    )]
    Positions {
        /// Index of the caster.
        caster: usize,
        /// Where the last position would end, in bytes.
        needed: u64,
        /// Size of the buffer in bytes.
        available: u64,
        /// Offset of the first position in bytes.
        offset: u64,
        /// From one position to the next, in bytes.
        stride: u64,
    },
}

/// Why [`Shadows::wait_for_counters`](crate::Shadows::wait_for_counters) has none.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CountersError {
    /// The device was lost or the wait failed.
    #[error("the device did not finish the frame: {0}")]
    Poll(#[from] wgpu::PollError),
    /// A frame was encoded and its commands were not submitted.
    #[error("an encoded frame was not submitted: submit its encoder before waiting for its counters")]
    NotSubmitted,
    /// No frame with silhouette stages is under way.
    #[error("no frame with counters was submitted: call prepare, encode and submit first")]
    NoFrame,
}
