//! What a contestant's shadow costs, and how that compares with the plain shadow map.

use serde::{Deserialize, Serialize};

use crate::metrics::{Ratio, Timing};

/// What one frame's shadow costs.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Cost {
    /// Device time of each stage and pass, in the order in which they run; empty where the device has no timestamps.
    pub stages: Vec<StageCost>,
    /// Device time of the whole shadow work; none where the device has no timestamps that cover all of it, as where it
    /// is software.
    pub device: Option<Timing>,
    /// Time from submission to completion of the whole shadow work.
    pub wall: Timing,
    /// CPU time to prepare and record.
    pub record: Timing,
    /// Memory of the maps that the technique keeps, in bytes.
    pub map_bytes: u64,
    /// Memory of the buffers that the technique keeps, in bytes.
    pub buffer_bytes: u64,
}

/// Device time of one stage or pass.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StageCost {
    /// Name of the stage or pass, which is also the name of its shader file.
    pub name: String,
    /// Its time.
    pub timing: Timing,
}

/// A cost as multiples of the plain shadow map's in the same group. None where there is nothing to divide by.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct CostRatio {
    /// Of each stage's time to that of the *whole* shadow map, since most stages have no like there. As many as the
    /// cost has stages.
    pub stages: Vec<StageRatio>,
    /// Of device times.
    pub device: Option<Ratio>,
    /// Of the times from submission to completion.
    pub wall: Option<Ratio>,
    /// Of the CPU times.
    pub record: Option<Ratio>,
    /// Of the bytes of all maps.
    pub maps: Option<f64>,
    /// Of the bytes of all buffers.
    pub buffers: Option<f64>,
}

/// One stage's time as a multiple of the plain shadow map's whole time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct StageRatio {
    /// Name of the stage or pass.
    pub name: String,
    /// Its time over the shadow map's.
    pub ratio: Option<Ratio>,
}

impl Cost {
    /// The time that stands for the contestant: device time, or where that is missing wall-clock time.
    pub fn whole(&self) -> &Timing {
        self.device.as_ref().unwrap_or(&self.wall)
    }
}

impl CostRatio {
    /// The ratio that stands for the contestant: of device times, or where that is missing of wall-clock times.
    pub fn whole(&self) -> Option<Ratio> {
        self.device.or(self.wall)
    }
}
