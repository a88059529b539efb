//! How long each stage takes on the device.

use contrejour_gpu::PassTimer;
use wgpu_profiler::{GpuProfiler, GpuProfilerQuery, GpuProfilerSettings, GpuTimerQueryResult};

use crate::Gpu;
use crate::error::DrawError;

/// Times passes by timestamps; where the device has none, nothing is timed.
pub struct StageTimer {
    profiler: GpuProfiler,
    timestamp_period: f32,
    stages: Vec<TimedStage>,
}

impl std::fmt::Debug for StageTimer {
    fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.debug_struct("StageTimer").field("stages", &self.stages).finish_non_exhaustive()
    }
}

/// Times of one stage, one a frame that came back.
#[derive(Clone, Debug, PartialEq)]
pub struct TimedStage {
    /// Its name.
    pub name: String,
    /// Time of each frame. Unit: milliseconds.
    pub times_ms: Vec<f64>,
}

/// How long one stage or pass of one frame took on the device.
#[derive(Clone, Debug, PartialEq)]
pub struct PassTime {
    /// Its name.
    pub name: String,
    /// Time between its timestamps. Unit: milliseconds.
    pub gpu_ms: f64,
}

/// Frames whose timestamps may be under way before the oldest is dropped.
const MAX_PENDING_FRAMES: usize = 8;

impl StageTimer {
    /// A timer on a device.
    ///
    /// # Errors
    ///
    /// The profiler's settings do not fit the device.
    pub fn new(gpu: &Gpu) -> Result<Self, wgpu_profiler::CreationError> {
        let settings = GpuProfilerSettings {
            enable_timer_queries: gpu.device.features().contains(wgpu::Features::TIMESTAMP_QUERY),
            enable_debug_groups: false,
            max_num_pending_frames: MAX_PENDING_FRAMES,
        };
        Ok(Self {
            profiler: GpuProfiler::new(&gpu.device, settings)?,
            timestamp_period: gpu.queue.get_timestamp_period(),
            stages: Vec::new(),
        })
    }

    /// Records the copy of a frame's timestamps; the last commands of a frame.
    pub fn resolve(&mut self, encoder: &mut wgpu::CommandEncoder) {
        self.profiler.resolve_queries(encoder);
    }

    /// Ends a frame after its submission.
    ///
    /// # Errors
    ///
    /// Queries of the frame were not resolved.
    pub fn end_frame(&mut self) -> Result<(), wgpu_profiler::EndFrameError> {
        self.profiler.end_frame()
    }

    /// Takes the times that have arrived.
    pub fn collect(&mut self) {
        while let Some(frame) = self.take_frame() {
            add_frame(&mut self.stages, frame.passes);
        }
    }

    /// Takes the times of the oldest frame that have arrived, in the order in which its stages ran.
    pub(crate) fn take_frame(&mut self) -> Option<FrameTime> {
        self.profiler.process_finished_frame(self.timestamp_period).map(|passes| FrameTime::of(&passes))
    }

    /// Ends a frame after its submission, waits, and takes its times.
    pub(crate) fn last_frame(&mut self, gpu: &Gpu) -> Result<FrameTime, DrawError> {
        self.end_frame()?;
        gpu.wait(None)?;
        let mut last = FrameTime::default();
        while let Some(frame) = self.take_frame() {
            last = frame;
        }
        Ok(last)
    }

    /// The stages in the order in which they first ran.
    pub fn stages(&self) -> &[TimedStage] {
        &self.stages
    }
}

/// Times of a frame on the device.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct FrameTime {
    /// From the begin of the first pass to the end of the last, what lies between them included; `None` without
    /// timestamps. Unit: milliseconds.
    pub whole_ms: Option<f64>,
    /// Its passes; those of the same name are one stage, and their times are added.
    pub passes: Vec<PassTime>,
}

impl FrameTime {
    fn of(timed: &[GpuTimerQueryResult]) -> Self {
        let mut passes: Vec<PassTime> = Vec::new();
        let mut span: Option<(f64, f64)> = None;
        for pass in timed {
            let Some(time) = &pass.time else { continue };
            let (begin, end) = span.unwrap_or((time.start, time.end));
            span = Some((begin.min(time.start), end.max(time.end)));
            let gpu_ms = 1000.0 * (time.end - time.start);
            match passes.iter_mut().find(|stage| stage.name == pass.label) {
                Some(stage) => stage.gpu_ms += gpu_ms,
                None => passes.push(PassTime { name: pass.label.clone(), gpu_ms }),
            }
        }
        Self { whole_ms: span.map(|(begin, end)| 1000.0 * (end - begin)), passes }
    }
}

fn add_frame(stages: &mut Vec<TimedStage>, frame: Vec<PassTime>) {
    for PassTime { name, gpu_ms } in frame {
        match stages.iter_mut().find(|stage| stage.name == name) {
            Some(stage) => stage.times_ms.push(gpu_ms),
            None => stages.push(TimedStage { name, times_ms: vec![gpu_ms] }),
        }
    }
}

impl PassTimer for StageTimer {
    type Query = GpuProfilerQuery;

    fn begin(&mut self, name: &'static str, encoder: &mut wgpu::CommandEncoder) -> GpuProfilerQuery {
        self.profiler.begin_pass_query(name, encoder)
    }

    fn compute_writes(query: &GpuProfilerQuery) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        query.compute_pass_timestamp_writes()
    }

    fn render_writes(query: &GpuProfilerQuery) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        query.render_pass_timestamp_writes()
    }

    fn end(&mut self, query: GpuProfilerQuery, encoder: &mut wgpu::CommandEncoder) {
        self.profiler.end_query(encoder, query);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pass(label: &str, begin: f64, end: f64) -> GpuTimerQueryResult {
        GpuTimerQueryResult {
            label: label.into(),
            pid: 0,
            tid: std::thread::current().id(),
            time: Some(begin..end),
            nested_queries: Vec::new(),
        }
    }

    #[test]
    fn passes_of_one_name_are_one_stage() {
        let mut stages = Vec::new();
        let frame = FrameTime::of(&[pass("b", 0.0, 1.0), pass("a", 1.0, 1.5), pass("b", 2.0, 2.25)]);
        assert_eq!(frame.whole_ms, Some(2250.0), "with the half second in which nothing ran");
        add_frame(&mut stages, frame.passes);
        add_frame(&mut stages, FrameTime::of(&[pass("a", 3.0, 3.5)]).passes);
        assert_eq!(
            stages,
            [
                TimedStage { name: "b".into(), times_ms: vec![1250.0] },
                TimedStage { name: "a".into(), times_ms: vec![500.0, 500.0] }
            ]
        );
    }

    #[test]
    fn a_pass_without_timestamps_counts_for_nothing() {
        let untimed = GpuTimerQueryResult { time: None, ..pass("a", 0.0, 1.0) };
        assert_eq!(FrameTime::of(&[untimed]), FrameTime::default());
    }
}
