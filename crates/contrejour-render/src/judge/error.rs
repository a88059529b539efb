//! Why nothing can be judged.

use contrejour_scene::NoLight;

use crate::caster_meshes::CasterMeshError;
use crate::casters::{CastShadowsError, PrepareShadowsError};
use crate::gpu::DeviceFault;
use crate::judge::TooManyFaces;
use crate::readback::ReadError;
use crate::scene_meshes::UploadMeshesError;
use crate::targets::SizeTooLarge;

/// Why a scene cannot be judged.
#[derive(Debug, thiserror::Error)]
pub enum NewJudgeError {
    /// The picture is larger than the device's textures.
    #[error(transparent)]
    SizeTooLarge(#[from] SizeTooLarge),
    /// The scene has no light.
    #[error(transparent)]
    NoLight(#[from] NoLight),
    /// The scene has more faces than can be numbered.
    #[error(transparent)]
    TooManyFaces(#[from] TooManyFaces),
    /// A mesh that casts has no topology, or a mask does not fit it.
    #[error(transparent)]
    CasterMesh(#[from] CasterMeshError),
    /// A mesh does not fit, or a texture is not decoded.
    #[error(transparent)]
    Upload(#[from] UploadMeshesError),
    /// The device failed.
    #[error(transparent)]
    Device(#[from] DeviceFault),
}

/// Why a technique cannot take part.
#[derive(Debug, thiserror::Error)]
pub enum NewContestantError {
    /// The shadow settings, a mesh or the device do not allow shadows.
    #[error(transparent)]
    Shadows(#[from] CastShadowsError),
    /// The scene's light or the device does not allow its shadow.
    #[error(transparent)]
    Prepare(#[from] PrepareShadowsError),
    /// The timestamps cannot be set up.
    #[error("the graphics device's timestamps cannot be used")]
    Timer(#[from] wgpu_profiler::CreationError),
    /// The device failed.
    #[error(transparent)]
    Device(#[from] DeviceFault),
}

/// Why a picture cannot be composed.
#[derive(Debug, thiserror::Error)]
pub enum ComposeError {
    /// There is not one value for each pixel.
    #[error("{values} visibilities were given for a picture of {width}x{height}; give one for each pixel")]
    Count {
        /// How many there are.
        values: usize,
        /// Width in pixels.
        width: u32,
        /// Height in pixels.
        height: u32,
    },
    /// A value is infinite or no number.
    #[error("the visibility of pixel ({x}, {y}) is {value}; give a number from 0, dark, to 1, lit")]
    NotFinite {
        /// Column from the left.
        x: u32,
        /// Row from the top.
        y: u32,
        /// What was given.
        value: f32,
    },
    /// Something could not be read back.
    #[error(transparent)]
    Read(#[from] ReadError),
}
