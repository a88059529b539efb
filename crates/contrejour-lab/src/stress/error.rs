//! Why there is no summary.

use contrejour_gpu::{
    AddDeformingError, AddMeshError, CasterError, CountersError, DeformError, NewDeformerError, NewShadowsError,
    PrepareError, SetPoseError, ShadowLightError,
};
use contrejour_mesh::{DeformingMeshError, TopologyError};
use contrejour_render::{AnimationError, DeviceFault, DrawError, MoveError, NewRendererError, ReadError, SizeTooLarge};
use contrejour_scene::shapes::ShapeError;

use super::StressOptions;

/// Why a run comes to nothing.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum StressError {
    /// Casters can't have so many triangles.
    #[error(
        "casters of {triangles} triangles: give {} to {} a caster",
        StressOptions::MIN_TRIANGLES,
        StressOptions::MAX_TRIANGLES
    )]
    Triangles {
        /// Triangles that were asked for.
        triangles: usize,
    },
    /// There are more lights or casters than a run has.
    #[error("{count} {what}: give at most {most}")]
    TooMany {
        /// Lights or casters.
        what: &'static str,
        /// How many.
        count: usize,
        /// How many there may be.
        most: usize,
    },
    /// The mesh of the casters has no topology.
    #[error(transparent)]
    Topology(#[from] TopologyError),
    /// The mesh can't deform.
    #[error(transparent)]
    Deforming(#[from] DeformingMeshError),
    /// The device does not allow meshes that deform.
    #[error(transparent)]
    Deformer(#[from] NewDeformerError),
    /// A mesh that deforms does not fit.
    #[error(transparent)]
    AddDeforming(#[from] AddDeformingError),
    /// A pose is not taken.
    #[error(transparent)]
    Deform(#[from] DeformError),
    /// A pose does not fit its mesh.
    #[error(transparent)]
    SetPose(#[from] SetPoseError),
    /// The device does not allow shadows.
    #[error(transparent)]
    Shadows(#[from] NewShadowsError),
    /// The mesh does not fit.
    #[error(transparent)]
    Mesh(#[from] AddMeshError),
    /// A caster is not taken.
    #[error(transparent)]
    Caster(#[from] CasterError),
    /// A light is not taken.
    #[error(transparent)]
    Light(#[from] ShadowLightError),
    /// The device does not allow a frame.
    #[error(transparent)]
    Prepare(#[from] PrepareError),
    /// Counters do not come.
    #[error(transparent)]
    Counters(#[from] CountersError),
    /// What a frame left does not come back.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The scene of the pictures does not fit on the device.
    #[error(transparent)]
    Renderer(#[from] NewRendererError),
    /// The floor of the pictures has no shape.
    #[error(transparent)]
    Shape(#[from] ShapeError),
    /// Something does not move in pictures.
    #[error(transparent)]
    Move(#[from] MoveError),
    /// A pose is not shown.
    #[error(transparent)]
    Pose(#[from] AnimationError),
    /// Pictures have no size, or are too large.
    #[error(transparent)]
    Size(#[from] SizeTooLarge),
    /// A picture is not drawn.
    #[error(transparent)]
    Draw(#[from] DrawError),
    /// The device failed.
    #[error(transparent)]
    Fault(#[from] DeviceFault),
    /// The device's clock can't be asked.
    #[error("the device's timestamps can't be had: {0}")]
    Timer(String),
    /// The plan lists a map that is not there.
    #[error("the map {map} of a light is listed and not there: contrejour is wrong, please report this")]
    NoMap {
        /// Its name.
        map: &'static str,
    },
    /// Lists never became large enough.
    #[error("the lists of a frame still have too little room after {0} repetitions")]
    Incomplete(usize),
}
