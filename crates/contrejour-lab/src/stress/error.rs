//! Why there is no summary.

use contrejour_gpu::{AddMeshError, CasterError, CountersError, NewShadowsError, PrepareError, ShadowLightError};
use contrejour_mesh::TopologyError;
use contrejour_render::{DeviceFault, ReadError};

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
    /// The mesh of the casters has no topology.
    #[error(transparent)]
    Topology(#[from] TopologyError),
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
    /// The device failed.
    #[error(transparent)]
    Fault(#[from] DeviceFault),
    /// The device's clock can't be asked.
    #[error("the device's timestamps can't be had: {0}")]
    Timer(String),
    /// Lists never became large enough.
    #[error("the lists of a frame still have too little room after {0} repetitions")]
    Incomplete(usize),
}
