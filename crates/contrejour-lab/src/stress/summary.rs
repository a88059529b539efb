//! What a run came to.

use contrejour_gpu::{FrameStats, LightHandle, Shadows};
use contrejour_layout::BLOCK_SIZE;
use contrejour_plan::{FramePlan, Light, LightKind};
use serde::Serialize;

use super::own::Own;

/// What a run came to.
#[derive(Clone, Debug, Default, Serialize)]
pub struct Summary {
    /// The device, in words.
    pub device: String,
    /// Lights.
    pub lights: usize,
    /// What each light is, in their order.
    pub light_settings: Vec<LightSummary>,
    /// Views of all lights together.
    pub views: usize,
    /// Casters.
    pub casters: usize,
    /// Triangles of each caster.
    pub triangles_per_caster: usize,
    /// Seed of all paths.
    pub seed: u64,
    /// Frames that were drawn.
    pub frames: u64,
    /// CPU time of the thread that places, prepares, records and submits: half of the frames took at most this. Unit:
    /// milliseconds.
    pub cpu_ms_per_frame: f64,
    /// The part in which commands are recorded. Unit: milliseconds.
    pub cpu_record_ms: f64,
    /// The part in which casters and lights are placed and records uploaded. Unit: milliseconds.
    pub cpu_upload_ms: f64,
    /// The part in which commands are submitted. Unit: milliseconds.
    pub cpu_submit_ms: f64,
    /// From the begin of a frame to the begin of the next on the wall, verification aside: half took at most this. Unit:
    /// milliseconds.
    pub wall_ms_per_frame: f64,
    /// Records that a frame uploads. Unit: bytes.
    pub upload_bytes_per_frame: u64,
    /// Draws that a frame records.
    pub draws_recorded: u32,
    /// Dispatches that a frame records.
    pub dispatches_recorded: u32,
    /// Stages and passes of the last frames, of all views together. Empty where the device has no timestamps.
    pub stages: Vec<StageTime>,
    /// Faces of the casters that cast, at most, since blocks count whole: over all views of the last frame that was counted.
    pub faces_tested: u64,
    /// Edges of the same, at most.
    pub edges_tested: u64,
    /// Silhouette edges of the same frame.
    pub silhouette_edges: u64,
    /// Lights whose maps were made, over all frames.
    pub lights_redone: u64,
    /// Lights whose maps stood, over all frames.
    pub lights_kept: u64,
    /// Buffers and textures of all lights. Unit: bytes.
    pub memory_bytes: u64,
    /// What the whole program held in memory after a tenth of the frames' time; `None` where the system does not tell.
    /// Unit: bytes.
    pub resident_bytes_early: Option<u64>,
    /// The same after the last frame: as much as before, or something grows. Unit: bytes.
    pub resident_bytes_late: Option<u64>,
    /// Frames whose quads or corners found too little room.
    pub overflow_frames: u64,
    /// Lights of frames that were verified.
    pub verified_light_frames: u64,
    /// Texels of pictures that were verified.
    pub verified_texels: u64,
    /// Differences from exact arithmetic and from frames drawn from scratch; in pictures each texel counts.
    pub differences: u64,
    /// The first of them, in words.
    pub first_difference: Option<String>,
}

impl Summary {
    /// Adds a frame.
    pub(super) fn add_frame(&mut self, stats: &FrameStats) {
        self.frames += 1;
        self.lights_redone += u64::from(stats.lights_redone);
        self.lights_kept += u64::from(stats.lights_kept);
        self.draws_recorded = stats.draws_recorded;
        self.dispatches_recorded = stats.dispatches_recorded;
    }

    /// Adds what the last frame left.
    pub(super) fn count(&mut self, shadows: &Shadows, lights: impl Iterator<Item = LightHandle>) {
        let lights: Vec<_> = lights.collect();
        let counters = shadows.stats().counters.unwrap_or_default();
        self.faces_tested = u64::from(counters.face_items) * u64::from(BLOCK_SIZE);
        self.edges_tested = u64::from(counters.edge_items) * u64::from(BLOCK_SIZE);
        self.silhouette_edges = counters.silhouette_edges.into();
        let plans: Vec<&FramePlan> = lights.iter().filter_map(|light| shadows.plan(*light)).collect();
        let of_lights = plans.iter().flat_map(|plan| &plan.buffers).filter(|buffer| buffer.kind.is_of_light());
        let shared = plans.first().map_or(&[][..], |plan| &plan.buffers);
        let shared = shared.iter().filter(|buffer| !buffer.kind.is_of_light());
        let textures = plans.iter().flat_map(|plan| &plan.textures);
        self.memory_bytes = of_lights.chain(shared).map(|buffer| buffer.bytes).sum::<u64>()
            + textures.map(|texture| texture.bytes).sum::<u64>();
        self.views = lights.iter().map(|light| shadows.view_choice(*light).views()).sum();
    }
}

/// What a light of a run is.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct LightSummary {
    /// `spot`, `point`, `directional` or `cascaded`.
    pub kind: &'static str,
    /// The name of its technique.
    pub technique: &'static str,
    /// Texels along a side of its maps.
    pub map_size: u32,
    /// How large it is over the common size of its kind; 0 is a point.
    pub softness: f64,
    /// Linear colour.
    pub color: [f32; 3],
}

impl LightSummary {
    pub(super) fn new(light: &Light, own: &Own) -> Self {
        let kind = match light.kind {
            LightKind::Spot { .. } => "spot",
            LightKind::Point { .. } => "point",
            LightKind::Directional { .. } => "directional",
            LightKind::Cascaded { .. } => "cascaded",
        };
        let Own { settings, softness, color } = *own;
        Self { kind, technique: settings.technique.name(), map_size: settings.map_size, softness, color }
    }
}

/// How long a stage or a pass took.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct StageTime {
    /// Its name.
    pub name: String,
    /// Time of a frame on the device: half took at most this. Unit: milliseconds.
    pub gpu_ms: f64,
}

/// The median; 0 of nothing.
pub(super) fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    values.get(values.len() / 2).copied().unwrap_or(0.0)
}
