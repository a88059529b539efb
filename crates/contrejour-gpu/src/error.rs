//! What can go wrong, and what to do about it.

use contrejour_plan::{CascadeError, LightError, PlanError, SettingsError};

use std::error::Error;

use crate::casters::CasterHandle;
use crate::lights::LightHandle;
use crate::pool::MeshHandle;

/// What the device itself fails at. The object that reports it can be used further, unless the device is lost.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum DeviceError {
    /// The device has no memory for what a frame needs; nothing that was made for the frame is kept.
    #[error(
        "the device has no memory for the {bytes} bytes that are needed ({text}): choose a smaller map, a technique \
         with fewer maps, or smaller meshes"
    )]
    OutOfMemory {
        /// Bytes of everything that the frame needs.
        bytes: u64,
        /// What wgpu says, with the name of what could not be made.
        text: String,
    },
    /// The device does not make what a frame needs; nothing that was made for the frame is kept.
    #[error(
        "the device refuses what is needed ({text}): check formats and buffers that were given; where they are right, \
         the driver or contrejour is wrong: please report this text"
    )]
    Refused {
        /// What wgpu says.
        text: String,
    },
    /// The device is lost, and everything that was made on it.
    #[error("the device is lost: open a device again and make everything anew on it")]
    Lost,
    /// What is waited for does not come.
    #[error("the device does not finish what it is waited for ({0}): submit the work first, or wait longer")]
    Unfinished(#[from] wgpu::PollError),
}

impl DeviceError {
    /// An error of wgpu's, in one line; `bytes` is what was asked for.
    pub(crate) fn from_wgpu(error: &wgpu::Error, bytes: u64) -> Self {
        match error {
            wgpu::Error::OutOfMemory { source } => Self::OutOfMemory { bytes, text: with_causes(&**source) },
            wgpu::Error::Validation { description, .. } | wgpu::Error::Internal { description, .. } => {
                Self::Refused { text: one_line(description) }
            }
        }
    }
}

fn with_causes(error: &(dyn Error + 'static)) -> String {
    let chain = std::iter::successors(Some(error), |&error| error.source());
    chain.map(|error| one_line(&error.to_string())).collect::<Vec<_>>().join(": ")
}

fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

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
    /// The device fails.
    #[error(transparent)]
    Device(#[from] DeviceError),
}

/// Why [`Shadows::add_mesh`](crate::Shadows::add_mesh) refuses.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum AddMeshError {
    /// The positions of all meshes together are more than 32 bits can index.
    #[error(
        "with this mesh there would be {words} words of positions, at most 4294967295 can be indexed: split the scene"
    )]
    PoolTooLarge {
        /// Words of positions that there would be.
        words: u64,
    },
    /// The masks of all meshes together are more than 32 bits can index.
    #[error(
        "with this mesh there would be {words} words of masks, at most 4294967295 can be indexed: make pictures smaller"
    )]
    MasksTooLarge {
        /// Words of masks that there would be.
        words: u64,
    },
}

/// Why [`Shadows::remove_mesh`](crate::Shadows::remove_mesh) refuses.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum RemoveMeshError {
    /// The handle is of a mesh that was removed, or of another object.
    #[error("there is no {mesh:?} here: use the handle of `add_mesh`, until the mesh is removed")]
    UnknownMesh {
        /// The handle.
        mesh: MeshHandle,
    },
    /// Casters stand on the mesh.
    #[error("casters stand on {mesh:?}, {casters} of them: remove them with `remove_caster` before the mesh")]
    StillCasts {
        /// The handle.
        mesh: MeshHandle,
        /// How many.
        casters: usize,
    },
}

/// Why a caster is not added, moved or removed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CasterError {
    /// The handle is of a caster that was removed, or of another object.
    #[error("there is no {caster:?} here: use the handle of `add_caster`, until the caster is removed")]
    UnknownCaster {
        /// The handle.
        caster: CasterHandle,
    },
    /// It names a mesh that was removed, or is of another object.
    #[error("the caster names {mesh:?}, which is not here: use the handle of `add_mesh`, until the mesh is removed")]
    UnknownMesh {
        /// The handle.
        mesh: MeshHandle,
    },
    /// The caller's position buffer does not hold what the mesh needs.
    #[error(
        "the caster's positions end at byte {needed} of a buffer of {available} bytes, or its offset ({offset}) or stride \
         ({stride}) is no multiple of 4 or the stride is below 12, or the buffer lacks COPY_SRC: give one position for \
         each source vertex of the mesh"
    )]
    Positions {
        /// Where the last position would end, in bytes.
        needed: u64,
        /// Size of the buffer in bytes.
        available: u64,
        /// Offset of the first position in bytes.
        offset: u64,
        /// From one position to the next, in bytes.
        stride: u64,
    },
    /// A box of positions that is none.
    #[error(
        "the box of the caster's positions goes from {min:?} to {max:?}: give finite corners, the smallest one first, or no \
         `known` where nobody knows them"
    )]
    Bounds {
        /// What should be the smallest corner.
        min: [f32; 3],
        /// What should be the largest corner.
        max: [f32; 3],
    },
    /// A caster without positions of its own can't get others.
    #[error("{caster:?} has the positions of its mesh: add it with `Positions::InBuffer`")]
    PositionsOfMesh {
        /// The handle.
        caster: CasterHandle,
    },
}

/// Why a light is not added, changed or removed.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum ShadowLightError {
    /// The light is no light.
    #[error(transparent)]
    Light(#[from] LightError),
    /// A setting is out of range.
    #[error(transparent)]
    Settings(#[from] SettingsError),
    /// The eye is out of range, or the maps are too small for cascades.
    #[error(transparent)]
    Cascades(CascadeError),
    /// The handle is of a light that was removed, or of another object.
    #[error("there is no {light:?} here: use the handle of `add_light`, until the light is removed")]
    UnknownLight {
        /// The handle.
        light: LightHandle,
    },
}

impl From<CascadeError> for ShadowLightError {
    fn from(error: CascadeError) -> Self {
        match error {
            CascadeError::Light(error) => Self::Light(error),
            CascadeError::Settings(error) => Self::Settings(error),
            other => Self::Cascades(other),
        }
    }
}

/// Why [`Shadows::prepare`](crate::Shadows::prepare) refuses.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum PrepareError {
    /// The maps of a cascaded light follow an eye, and none was given.
    #[error("{light:?} is cascaded and has no eye: call `set_eye` with what the camera sees before `prepare`")]
    NoEye {
        /// The light.
        light: LightHandle,
    },
    /// The device can't hold what the frame needs.
    #[error(transparent)]
    Plan(#[from] PlanError),
    /// The device fails.
    #[error(transparent)]
    Device(#[from] DeviceError),
}

/// Why [`Shadows::wait_for_counters`](crate::Shadows::wait_for_counters) has none.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum CountersError {
    /// The device is lost or the wait failed.
    #[error(transparent)]
    Device(#[from] DeviceError),
    /// A frame was encoded and its commands were not submitted.
    #[error("an encoded frame was not submitted: submit its encoder before waiting for its counters")]
    NotSubmitted,
    /// No frame with silhouette stages is under way.
    #[error("no frame with counters was submitted: call prepare, encode and submit first")]
    NoFrame,
}
