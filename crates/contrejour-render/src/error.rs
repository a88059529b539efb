//! What can go wrong with a scene or a frame.

use contrejour_gpu::CountersError;
use contrejour_scene::SceneLightError;

use crate::animated::AnimationError;
use crate::caster_meshes::CasterMeshError;
use crate::casters::{CastShadowsError, PrepareShadowsError};
use crate::gpu::DeviceFault;
use crate::readback::ReadError;
use crate::scene_meshes::UploadMeshesError;
use crate::targets::SizeTooLarge;

/// Frames after which a picture that still misses something is given up; buffers grow to what was counted, so two are
/// enough.
pub(crate) const MAX_REPEATS: usize = 8;

/// Why a scene cannot be brought to the device.
#[derive(Debug, thiserror::Error)]
pub enum NewRendererError {
    /// The picture is larger than the device's textures.
    #[error(transparent)]
    SizeTooLarge(#[from] SizeTooLarge),
    /// A light of the scene is out of range.
    #[error(transparent)]
    SceneLight(#[from] SceneLightError),
    /// A mesh does not fit, or a texture is not decoded.
    #[error(transparent)]
    Upload(#[from] UploadMeshesError),
    /// A mesh that casts has no topology, or a mask does not fit it.
    #[error(transparent)]
    CasterMesh(#[from] CasterMeshError),
    /// The shadow settings, a mesh or the device do not allow shadows.
    #[error(transparent)]
    Shadows(#[from] CastShadowsError),
    /// The scene's light or the device does not allow its shadow.
    #[error(transparent)]
    Prepare(#[from] PrepareShadowsError),
    /// The scene does not move.
    #[error(transparent)]
    Animation(#[from] AnimationError),
    /// The timestamps cannot be set up.
    #[error("the graphics device's timestamps cannot be used")]
    Timer(#[from] wgpu_profiler::CreationError),
    /// The device failed.
    #[error(transparent)]
    Device(#[from] DeviceFault),
}

/// Why a frame cannot be drawn.
#[derive(Debug, thiserror::Error)]
pub enum DrawError {
    /// The light or the device does not allow this frame.
    #[error(transparent)]
    Prepare(#[from] PrepareShadowsError),
    /// The counters did not come back.
    #[error(transparent)]
    Counters(#[from] CountersError),
    /// The timestamps are not used as they should.
    #[error("the frame's timestamps cannot be used")]
    Timer(#[from] wgpu_profiler::EndFrameError),
    /// The device failed.
    #[error(transparent)]
    Device(#[from] DeviceFault),
    /// Something could not be read back.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The picture to draw into has another size than pictures have.
    #[error(
        "the picture has {}x{} pixels and {}x{} are drawn; resize the renderer first",
        found[0], found[1], wanted[0], wanted[1]
    )]
    TargetSize {
        /// Its width and height, in pixels.
        found: [u32; 2],
        /// Those of what is drawn.
        wanted: [u32; 2],
    },
    /// The buffers never became large enough.
    #[error("the frame still misses something after {MAX_REPEATS} repetitions; use a smaller mesh or a smaller map")]
    Incomplete,
}
