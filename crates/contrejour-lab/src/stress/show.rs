//! The world of a run in pictures.

use contrejour_render::{Gpu, StageCost};
use cpu_time::ThreadTime;

use super::error::StressError;
use super::options::StressOptions;
use super::pictures::{PictureMoment, Pictures};
use super::stopwatch::Stopwatch;
use super::summary::{StageTime, Summary, median};
use super::world::World;

/// The world of a run over a floor, frame after frame in pictures of the caller's, such as a window's.
///
/// The library makes the shadows of the same lights and casters as in [`run`](super::run), and cascades follow the same eye,
/// which is the camera of the pictures; what a frame costs holds the picture too.
#[derive(Debug)]
pub struct Show {
    world: World,
    pictures: Pictures,
    summary: Summary,
    watch: Stopwatch,
    /// CPU time that placing took, frame by frame. Unit: milliseconds.
    placing: Vec<f64>,
}

impl Show {
    /// Sets the world up.
    ///
    /// # Errors
    ///
    /// The options are out of range, or the device does not allow the scene.
    pub fn new(gpu: Gpu, options: &StressOptions, size: [u32; 2]) -> Result<Self, StressError> {
        let world = World::new(options)?;
        let summary = Summary { device: gpu.description(), ..world.summary() };
        let pictures = Pictures::new(gpu, &world, 0, size)?;
        let watch = Stopwatch::start(options.duration);
        Ok(Self { world, pictures, summary, watch, placing: Vec::new() })
    }

    /// Whether the time of the run is over.
    pub fn is_over(&self) -> bool {
        self.watch.is_over()
    }

    /// Draws pictures of another size from now on, in pixels.
    ///
    /// # Errors
    ///
    /// The device's textures are smaller, or a side is 0.
    pub fn resize(&mut self, size: [u32; 2]) -> Result<(), StressError> {
        Ok(self.pictures.renderer.resize(size)?)
    }

    /// Moves everything on and draws it into a picture of the caller's. Returns the CPU's time of the frame. Unit:
    /// milliseconds.
    ///
    /// # Errors
    ///
    /// The device does not allow the frame, or fails.
    pub fn draw_into(&mut self, view: &wgpu::TextureView, format: wgpu::TextureFormat) -> Result<f64, StressError> {
        self.watch.begin_frame();
        let frame = self.summary.frames + 1;
        let moment = PictureMoment::new(&self.world, frame);
        let clock = ThreadTime::now();
        let ms = || 1000.0 * clock.elapsed().as_secs_f64();
        self.pictures.follow(&moment)?;
        self.placing.push(ms());
        self.pictures.renderer.draw_into(view, format)?;
        self.summary.add_frame(&self.pictures.renderer.shadows().stats());
        self.watch.end_frame();
        Ok(ms())
    }

    /// Waits for the last frame and says what came of all of them.
    ///
    /// # Errors
    ///
    /// The device fails.
    pub fn finish(mut self) -> Result<Summary, StressError> {
        let measured = self.pictures.renderer.measurements()?;
        let placing = median(self.placing);
        let time = |stage: &StageCost| StageTime { name: stage.name.clone(), gpu_ms: stage.gpu_ms };
        let mut summary = Summary {
            cpu_ms_per_frame: placing + measured.cpu_ms_per_frame,
            cpu_upload_ms: placing + measured.cpu_upload_ms,
            cpu_record_ms: measured.cpu_record_ms,
            cpu_submit_ms: measured.cpu_submit_ms,
            upload_bytes_per_frame: measured.upload_bytes_per_frame,
            stages: measured.stages.iter().map(time).collect(),
            overflow_frames: measured.overflow_frames,
            ..self.summary
        };
        summary.count(self.pictures.renderer.shadows(), self.pictures.renderer.casting_lights());
        self.watch.tell(&mut summary);
        Ok(summary)
    }
}
