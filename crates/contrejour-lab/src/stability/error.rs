//! Why a run stops, and what the library may refuse.

use contrejour_gpu::{AddMeshError, CasterError, CountersError, NewShadowsError, PrepareError, ShadowLightError};
use contrejour_mesh::TopologyError;
use contrejour_render::{DeviceFault, ReadError};

use super::family::UnknownFamily;
use super::files::WriteError;
use crate::metrics::MetricError;
use crate::run::RunError;

/// Why a run stops.
#[derive(Debug, thiserror::Error)]
pub enum StabilityError {
    /// No family has a name that was asked for.
    #[error(transparent)]
    Family(#[from] UnknownFamily),
    /// The device failed.
    #[error("{family} at {parameter}: {source}")]
    Device {
        /// Name of the family.
        family: &'static str,
        /// The case.
        parameter: String,
        /// What is wrong.
        source: CaseError,
    },
    /// The results can't be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

/// Why a case has no result.
#[derive(Debug, thiserror::Error)]
pub enum CaseError {
    /// The counters did not come back.
    #[error(transparent)]
    Counters(#[from] CountersError),
    /// Something could not be read back.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// The device failed.
    #[error(transparent)]
    Fault(#[from] DeviceFault),
    /// The lists never became large enough.
    #[error("the frame still misses quads or corners after {0} repetitions")]
    Incomplete(usize),
    /// A clock went wrong, or a visibility is none.
    #[error(transparent)]
    Metric(#[from] MetricError),
    /// The case can't be looked at.
    #[error(transparent)]
    Sight(Box<RunError>),
    /// What was seen can't be kept.
    #[error("a picture can't be written as PNG: {0}")]
    Picture(#[from] image::ImageError),
}

impl From<RunError> for CaseError {
    fn from(error: RunError) -> Self {
        Self::Sight(Box::new(error))
    }
}

/// What the library refuses, with a type and a remedy: a result, and no failure.
#[derive(Debug, thiserror::Error)]
pub(super) enum Refusal {
    #[error(transparent)]
    Topology(#[from] TopologyError),
    #[error(transparent)]
    NewShadows(#[from] NewShadowsError),
    #[error(transparent)]
    AddMesh(#[from] AddMeshError),
    #[error(transparent)]
    AddCaster(#[from] CasterError),
    #[error(transparent)]
    ShadowLight(#[from] ShadowLightError),
    #[error(transparent)]
    Prepare(#[from] PrepareError),
}

/// What ends a case before it has a result.
#[derive(Debug, thiserror::Error)]
pub(super) enum Ended {
    #[error(transparent)]
    Refused(#[from] Refusal),
    #[error(transparent)]
    Failed(#[from] CaseError),
}
