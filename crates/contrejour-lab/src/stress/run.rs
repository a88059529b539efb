//! Frame after frame.

use std::collections::VecDeque;

use contrejour_gpu::Untimed;
use contrejour_render::{Gpu, StageTimer, had_room};
use cpu_time::ThreadTime;

use super::error::StressError;
use super::options::StressOptions;
use super::stopwatch::Stopwatch;
use super::summary::{StageTime, Summary, median};
use super::verify::Verifier;
use super::world::{Placed, World};

/// Frames after which a frame must have had room for everything.
pub(super) const REPEATS_MAX: usize = 8;

/// Of so many frames one is verified.
const VERIFIED_OF: u64 = 16;

/// Frames at the end whose stages are timed.
const TIMED_FRAMES: usize = 5;

/// What happens in a run.
#[derive(Clone, Copy, Debug)]
pub enum Event {
    /// A frame was drawn.
    Frame {
        /// Frames so far.
        frames: u64,
        /// CPU time of this one. Unit: milliseconds.
        cpu_ms: f64,
        /// Lights of frames that were verified so far.
        verified_light_frames: u64,
        /// How much of the run is done, from 0 to 1.
        done: f64,
    },
}

/// What each frame cost. Unit of all: milliseconds.
#[derive(Debug, Default)]
struct Costs {
    cpu: Vec<f64>,
    upload: Vec<f64>,
    record: Vec<f64>,
    submit: Vec<f64>,
}

/// Draws frames for a while and says what came of it.
///
/// # Errors
///
/// The options are out of range, or the device does not allow the frames or fails.
pub fn run(gpu: &Gpu, options: &StressOptions, tell: &dyn Fn(Event)) -> Result<Summary, StressError> {
    let world = World::new(options)?;
    let mut placed = world.place(gpu, 0)?;
    settle(gpu, &mut placed)?;
    let overflows_before = placed.shadows.stats().overflow_frames;

    let mut summary = Summary { device: gpu.description(), ..world.summary() };
    let mut costs = Costs::default();
    let mut random = fastrand::Rng::with_seed(options.seed ^ 0x5eed);
    let mut verifier = Verifier::new(&world);
    let mut submissions = VecDeque::new();
    let mut watch = Stopwatch::start(options.duration);
    while summary.frames < options.least_frames.max(1) || !watch.is_over() {
        let frame = summary.frames + 1;
        watch.begin_frame();
        submissions.push_back(draw(gpu, &world, &mut placed, frame, &mut costs)?);
        while submissions.len() > gpu.frames_in_flight() {
            gpu.wait(submissions.pop_front())?;
        }
        watch.end_frame();
        let stats = placed.shadows.stats();
        summary.add_frame(&stats);
        summary.upload_bytes_per_frame = stats.upload_bytes + placed.deformer.upload_bytes();
        if options.verify && (frame == 1 || random.u64(..VERIFIED_OF) == 0) {
            gpu.wait(None)?;
            submissions.clear();
            verifier.check(gpu, &mut placed, frame)?;
        }
        tell(Event::Frame {
            frames: frame,
            cpu_ms: costs.cpu.last().copied().unwrap_or(0.0),
            verified_light_frames: verifier.light_frames,
            done: watch.done().min(frame as f64 / options.least_frames.max(1) as f64),
        });
    }
    gpu.wait(None)?;
    watch.tell(&mut summary);
    summary.overflow_frames = placed.shadows.stats().overflow_frames - overflows_before;
    summary.count(&placed.shadows, placed.lights.iter().copied());
    summary.stages = stages(gpu, &world, &mut placed, summary.frames)?;
    gpu.check()?;

    summary.cpu_ms_per_frame = median(costs.cpu);
    summary.cpu_upload_ms = median(costs.upload);
    summary.cpu_record_ms = median(costs.record);
    summary.cpu_submit_ms = median(costs.submit);
    summary.verified_light_frames = verifier.light_frames;
    summary.verified_texels = verifier.texels;
    summary.differences = verifier.differences;
    summary.first_difference = verifier.first_difference;
    Ok(summary)
}

/// Draws the first frame until all lists have room, so that later ones create nothing.
pub(super) fn settle(gpu: &Gpu, placed: &mut Placed) -> Result<(), StressError> {
    let Placed { shadows, deformer, .. } = placed;
    for _ in 0..REPEATS_MAX {
        shadows.prepare(&gpu.device, &gpu.queue)?;
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        deformer.encode(&mut encoder, &mut Untimed);
        shadows.encode(&mut encoder, &mut Untimed);
        gpu.queue.submit([encoder.finish()]);
        gpu.wait(None)?;
        if had_room(gpu, shadows)? {
            return Ok(());
        }
    }
    Err(StressError::Incomplete(REPEATS_MAX))
}

fn draw(
    gpu: &Gpu,
    world: &World,
    placed: &mut Placed,
    frame: u64,
    costs: &mut Costs,
) -> Result<wgpu::SubmissionIndex, StressError> {
    // To know where things are is the program's own work.
    let moment = world.moment(frame);
    let clock = ThreadTime::now();
    let ms = |clock: ThreadTime| 1000.0 * clock.elapsed().as_secs_f64();
    placed.walk(gpu, &moment)?;
    placed.shadows.prepare(&gpu.device, &gpu.queue)?;
    costs.upload.push(ms(clock));
    let record = ThreadTime::now();
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("stress") });
    placed.deformer.encode(&mut encoder, &mut Untimed);
    placed.shadows.encode(&mut encoder, &mut Untimed);
    let commands = encoder.finish();
    costs.record.push(ms(record));
    let submit = ThreadTime::now();
    let submission = gpu.queue.submit([commands]);
    costs.submit.push(ms(submit));
    costs.cpu.push(ms(clock));
    Ok(submission)
}

/// Times the stages of a few more frames, each a pass of its own.
fn stages(gpu: &Gpu, world: &World, placed: &mut Placed, last: u64) -> Result<Vec<StageTime>, StressError> {
    let told = |error: String| StressError::Timer(error);
    let mut timer = StageTimer::new(gpu).map_err(|error| told(error.to_string()))?;
    for frame in (last + 1..).take(TIMED_FRAMES) {
        placed.walk(gpu, &world.moment(frame))?;
        placed.shadows.prepare(&gpu.device, &gpu.queue)?;
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor { label: Some("timed") });
        placed.deformer.encode(&mut encoder, &mut timer);
        placed.shadows.encode(&mut encoder, &mut timer);
        timer.resolve(&mut encoder);
        gpu.queue.submit([encoder.finish()]);
        timer.end_frame().map_err(|error| told(error.to_string()))?;
        gpu.wait(None)?;
        timer.collect();
    }
    let time = |stage: &contrejour_render::TimedStage| StageTime {
        name: stage.name.clone(),
        gpu_ms: median(stage.times_ms.clone()),
    };
    Ok(timer.stages().iter().map(time).collect())
}
