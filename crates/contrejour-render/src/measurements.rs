//! What frames cost and what they counted.

use contrejour_gpu::{FilledView, FrameStats};
use contrejour_layout::Counters;
use contrejour_plan::BufferKind;

use crate::Gpu;
use crate::readback::{ReadError, read_buffer};
use crate::renderer::CpuCost;
use crate::stage_timer::TimedStage;

/// What the frames of a [`Renderer`](crate::Renderer) cost.
#[derive(Clone, Debug, PartialEq)]
pub struct Measurements {
    /// Name and driver of the device.
    pub device: String,
    /// Frames that were drawn, repetitions included.
    pub frames: usize,
    /// Frames that could be under way while the next one was recorded: pacing waits for the others, and is no wait of
    /// the pipeline's.
    pub frames_in_flight: usize,
    /// Edges of all meshes that cast.
    pub edges: u64,
    /// Fewest, median and most silhouette edges of a frame, of all views of its lights together; zeros where no frame
    /// looked for silhouettes. A light whose maps stand is not looked at.
    pub silhouette_edges: Spread,
    /// Stages in the order in which they first ran, and the median of each. Empty where the device has no timestamps.
    pub stages: Vec<StageCost>,
    /// Bytes that a frame uploads: the median over the frames after the first, which uploads the scene.
    pub upload_bytes_per_frame: u64,
    /// Times that the pipeline itself waited for a result of the device.
    pub readback_waits: u64,
    /// Median CPU time of the thread that records, uploads and submits a frame. Unit: milliseconds.
    pub cpu_ms_per_frame: f64,
    /// The part of it in which records are uploaded, a median of its own as the next two are. Unit: milliseconds.
    pub cpu_upload_ms: f64,
    /// The part in which commands are recorded. Unit: milliseconds.
    pub cpu_record_ms: f64,
    /// The part in which they are submitted. Unit: milliseconds.
    pub cpu_submit_ms: f64,
    /// Frames whose buffers were too small for what they found.
    pub overflow_frames: u64,
}

/// Fewest, median and most.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Spread {
    /// Fewest.
    pub min: u32,
    /// The middle one; the lower of two.
    pub median: u32,
    /// Most.
    pub max: u32,
}

/// Median time of a stage on the device.
#[derive(Clone, Debug, PartialEq)]
pub struct StageCost {
    /// Its name.
    pub name: String,
    /// Median over the frames. Unit: milliseconds.
    pub gpu_ms: f64,
}

impl Measurements {
    pub(crate) fn new(
        device: String,
        frames_in_flight: usize,
        edges: u64,
        frames: &[CpuCost],
        counters: &[Counters],
        stages: &[TimedStage],
        stats: &FrameStats,
    ) -> Self {
        let steady = if frames.len() > 1 { &frames[1..] } else { frames };
        let median_of = |cost: fn(&CpuCost) -> f64| median(&steady.iter().map(cost).collect::<Vec<_>>()).unwrap_or(0.0);
        let stage_cost =
            |stage: &TimedStage| StageCost { name: stage.name.clone(), gpu_ms: median(&stage.times_ms).unwrap_or(0.0) };
        Self {
            device,
            frames: frames.len(),
            frames_in_flight,
            edges,
            silhouette_edges: Spread::of(counters.iter().map(|frame| frame.silhouette_edges)),
            stages: stages.iter().map(stage_cost).collect(),
            upload_bytes_per_frame: lower_median(steady.iter().map(|frame| frame.upload_bytes)).unwrap_or(0),
            readback_waits: stats.readback_waits,
            cpu_ms_per_frame: median_of(|frame| frame.cpu_ms),
            cpu_upload_ms: median_of(|frame| frame.upload_ms),
            cpu_record_ms: median_of(|frame| frame.record_ms),
            cpu_submit_ms: median_of(|frame| frame.submit_ms),
            overflow_frames: stats.overflow_frames,
        }
    }
}

impl Spread {
    fn of(values: impl Iterator<Item = u32>) -> Self {
        let mut sorted: Vec<u32> = values.collect();
        sorted.sort_unstable();
        match sorted.as_slice() {
            [] => Self::default(),
            sorted => Self { min: sorted[0], median: sorted[(sorted.len() - 1) / 2], max: sorted[sorted.len() - 1] },
        }
    }
}

fn lower_median<T: Ord + Copy>(values: impl Iterator<Item = T>) -> Option<T> {
    let mut sorted: Vec<T> = values.collect();
    sorted.sort_unstable();
    sorted.get(sorted.len().checked_sub(1)? / 2).copied()
}

fn median(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let last = sorted.len().checked_sub(1)?;
    Some(0.5 * (sorted[last / 2] + sorted[last.div_ceil(2)]))
}

/// The counters of every frame, kept on the device until somebody asks, so that no frame waits for them.
#[derive(Debug, Default)]
pub(crate) struct CounterLog {
    full_sheets: Vec<wgpu::Buffer>,
    sheet: Option<wgpu::Buffer>,
    entries_in_sheet: u64,
    /// Entries of each frame: one for each page of its scene and each view that was filled.
    frames: Vec<usize>,
    entries_of_frame: usize,
}

/// Counters in one buffer of the log.
const ENTRIES_PER_SHEET: u64 = 256;

const COUNTERS_BYTES: u64 = size_of::<Counters>() as u64;

impl CounterLog {
    /// Records the copy of the counters of a view that was filled in this frame.
    pub fn record(&mut self, gpu: &Gpu, view: &FilledView<'_>, encoder: &mut wgpu::CommandEncoder) {
        for counters in view.buffers(BufferKind::Counters) {
            if self.entries_in_sheet == ENTRIES_PER_SHEET {
                self.full_sheets.extend(self.sheet.take());
                self.entries_in_sheet = 0;
            }
            let sheet = self.sheet.get_or_insert_with(|| new_sheet(gpu));
            let (from, to) = (counters.offset(), self.entries_in_sheet * COUNTERS_BYTES);
            encoder.copy_buffer_to_buffer(counters.buffer(), from, sheet, to, COUNTERS_BYTES);
            self.entries_in_sheet += 1;
            self.entries_of_frame += 1;
        }
    }

    /// Ends a frame; one that filled no view counts for none.
    pub fn end_frame(&mut self) {
        let entries = std::mem::take(&mut self.entries_of_frame);
        if entries > 0 {
            self.frames.push(entries);
        }
    }

    /// Reads all of them; waits.
    pub fn read(&self, gpu: &Gpu) -> Result<Vec<Counters>, ReadError> {
        let mut entries = Vec::new();
        for sheet in &self.full_sheets {
            entries.extend(read_sheet(gpu, sheet, ENTRIES_PER_SHEET)?);
        }
        if let Some(sheet) = &self.sheet {
            entries.extend(read_sheet(gpu, sheet, self.entries_in_sheet)?);
        }
        let mut entries = entries.into_iter();
        Ok(self.frames.iter().map(|&count| entries.by_ref().take(count).sum()).collect())
    }
}

fn new_sheet(gpu: &Gpu) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("counter log"),
        size: ENTRIES_PER_SHEET * COUNTERS_BYTES,
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    })
}

fn read_sheet(gpu: &Gpu, sheet: &wgpu::Buffer, entries: u64) -> Result<Vec<Counters>, ReadError> {
    Ok(bytemuck::pod_collect_to_vec(&read_buffer(gpu, sheet.slice(..), entries * COUNTERS_BYTES)?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn medians() {
        assert_eq!(median(&[]), None);
        assert_eq!(median(&[3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(&[4.0, 1.0, 2.0, 3.0]), Some(2.5));
        assert_eq!(lower_median([4, 1, 3, 2].into_iter()), Some(2));
        assert_eq!(lower_median(std::iter::empty::<u64>()), None);
        assert_eq!(Spread::of([5, 1, 9, 7].into_iter()), Spread { min: 1, median: 5, max: 9 });
        assert_eq!(Spread::of(std::iter::empty()), Spread::default());
    }

    #[test]
    fn the_first_frame_uploads_the_scene_and_does_not_count() {
        let frames = [
            CpuCost { cpu_ms: 90.0, upload_bytes: 1_000_000, ..CpuCost::default() },
            CpuCost { cpu_ms: 1.0, upload_bytes: 10, ..CpuCost::default() },
        ];
        let measured = Measurements::new(String::new(), 2, 0, &frames, &[], &[], &FrameStats::default());
        assert_eq!(measured.upload_bytes_per_frame, 10);
        assert_eq!(measured.cpu_ms_per_frame, 1.0);
        let measured = Measurements::new(String::new(), 2, 0, &frames[..1], &[], &[], &FrameStats::default());
        assert_eq!(measured.upload_bytes_per_frame, 1_000_000);
    }
}
