//! What frames cost on the wall, and whether memory grows with them.

use std::time::{Duration, Instant};

use super::summary::{Summary, median};

/// Watches the frames of a run.
#[derive(Debug)]
pub(super) struct Stopwatch {
    duration: Duration,
    begin: Instant,
    frame_begin: Instant,
    /// Unit: milliseconds.
    frames: Vec<f64>,
    /// What the program held in memory after a tenth of the time.
    early: Option<Option<u64>>,
}

impl Stopwatch {
    /// Begins a run that is to last so long.
    pub fn start(duration: Duration) -> Self {
        let begin = Instant::now();
        Self { duration, begin, frame_begin: begin, frames: Vec::new(), early: None }
    }

    /// Whether the time is over.
    pub fn is_over(&self) -> bool {
        self.begin.elapsed() >= self.duration
    }

    /// How much of the time is over, from 0 to 1.
    pub fn done(&self) -> f64 {
        (self.begin.elapsed().as_secs_f64() / self.duration.as_secs_f64().max(f64::MIN_POSITIVE)).min(1.0)
    }

    /// Begins a frame: what lies between two frames does not count.
    pub fn begin_frame(&mut self) {
        self.frame_begin = Instant::now();
    }

    /// Ends it.
    pub fn end_frame(&mut self) {
        self.frames.push(1000.0 * self.frame_begin.elapsed().as_secs_f64());
        if self.early.is_none() && self.begin.elapsed() >= self.duration / 10 {
            self.early = Some(resident_bytes());
        }
    }

    /// Says what came of it.
    pub fn tell(self, summary: &mut Summary) {
        summary.wall_ms_per_frame = median(self.frames);
        summary.resident_bytes_early = self.early.flatten();
        summary.resident_bytes_late = resident_bytes();
    }
}

/// What the program holds in memory, where the system tells.
fn resident_bytes() -> Option<u64> {
    memory_stats::memory_stats().map(|stats| stats.physical_mem as u64)
}
