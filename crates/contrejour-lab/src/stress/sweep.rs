//! One number of a run is varied, the others stay.

use std::fmt;
use std::str::FromStr;

use contrejour_render::Gpu;

use super::error::StressError;
use super::options::{StressOptions, Variety};
use super::run::{Event, run};
use super::summary::Summary;
use crate::report::{Axis, Plot, Scale, Series, Stroke};

/// What a sweep varies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SweepAxis {
    /// Lights, from 1 to 32.
    Lights,
    /// Casters, from 1 to 256.
    Casters,
    /// Triangles of each caster, from a thousand to 256 thousand.
    Triangles,
}

/// Frames that are drawn with each value: the middle one of fewer says little.
const LEAST_FRAMES: u64 = 15;

/// Triangles of all casters together that a sweep goes up to.
const TRIANGLES_MAX: usize = 2_000_000;

impl SweepAxis {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Lights, Self::Casters, Self::Triangles];

    /// Its name.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Lights => "lights",
            Self::Casters => "casters",
            Self::Triangles => "triangles",
        }
    }

    /// The values that are tried, ascending: as far as all casters together have at most two million triangles. All lights
    /// have the same settings, so that one differs from the next by what is varied alone, and each run has frames enough for
    /// their middle one to say something.
    fn options(self, base: &StressOptions) -> Vec<StressOptions> {
        let same = Variety::Same;
        let least_frames = base.least_frames.max(LEAST_FRAMES);
        let base = &StressOptions { techniques: same, map_sizes: same, softness: same, least_frames, ..base.clone() };
        let values: &[usize] = match self {
            Self::Lights => &[1, 2, 4, 8, 16, 32],
            Self::Casters => &[1, 4, 16, 64, 256],
            Self::Triangles => &[1_000, 4_000, 16_000, 64_000, 256_000],
        };
        let with = |value: &usize| match self {
            Self::Lights => StressOptions { lights: *value, ..base.clone() },
            Self::Casters => StressOptions { casters: *value, ..base.clone() },
            Self::Triangles => StressOptions { triangles_per_caster: *value, ..base.clone() },
        };
        let is_bearable =
            |options: &StressOptions| options.casters.saturating_mul(options.triangles_per_caster) <= TRIANGLES_MAX;
        values.iter().map(with).filter(is_bearable).collect()
    }

    fn value(self, summary: &Summary) -> usize {
        match self {
            Self::Lights => summary.lights,
            Self::Casters => summary.casters,
            Self::Triangles => summary.triangles_per_caster,
        }
    }
}

impl fmt::Display for SweepAxis {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.pad(self.name())
    }
}

impl FromStr for SweepAxis {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        let known = Self::ALL.into_iter().find(|axis| axis.name() == name);
        known.ok_or_else(|| format!("there is no axis {name:?}: give lights, casters or triangles"))
    }
}

/// A run for each value of an axis.
#[derive(Clone, Debug)]
pub struct Sweep {
    /// What was varied.
    pub axis: SweepAxis,
    /// One for each value, ascending.
    pub runs: Vec<Summary>,
}

/// Runs with each value of an axis in turn.
///
/// # Errors
///
/// As [`run`].
pub fn sweep(gpu: &Gpu, axis: SweepAxis, base: &StressOptions, tell: &dyn Fn(Event)) -> Result<Sweep, StressError> {
    let runs = axis.options(base).iter().map(|options| run(gpu, options, tell)).collect::<Result<_, _>>()?;
    Ok(Sweep { axis, runs })
}

/// The columns of [`Sweep::csv`].
pub const SWEEP_COLUMNS: [&str; 14] = [
    "lights",
    "views",
    "casters",
    "triangles_per_caster",
    "frames",
    "cpu_ms_per_frame",
    "cpu_upload_ms",
    "cpu_record_ms",
    "cpu_submit_ms",
    "wall_ms_per_frame",
    "upload_bytes_per_frame",
    "draws_recorded",
    "dispatches_recorded",
    "memory_bytes",
];

impl Sweep {
    /// A line for each run.
    pub fn csv(&self) -> String {
        let mut text = SWEEP_COLUMNS.join(",") + "\n";
        for run in &self.runs {
            let cells = [
                run.lights.to_string(),
                run.views.to_string(),
                run.casters.to_string(),
                run.triangles_per_caster.to_string(),
                run.frames.to_string(),
                run.cpu_ms_per_frame.to_string(),
                run.cpu_upload_ms.to_string(),
                run.cpu_record_ms.to_string(),
                run.cpu_submit_ms.to_string(),
                run.wall_ms_per_frame.to_string(),
                run.upload_bytes_per_frame.to_string(),
                run.draws_recorded.to_string(),
                run.dispatches_recorded.to_string(),
                run.memory_bytes.to_string(),
            ];
            text += &(cells.join(",") + "\n");
        }
        text
    }

    /// CPU time and time on the wall of a frame against what was varied.
    pub fn plot(&self) -> Plot {
        let series = |label: &str, time: fn(&Summary) -> f64| Series {
            label: label.to_owned(),
            points: self.runs.iter().map(|run| [self.axis.value(run) as f64, time(run)]).collect(),
            stroke: Stroke::Line,
        };
        let unit = match self.axis {
            SweepAxis::Triangles => "triangles of each caster",
            axis => axis.name(),
        };
        Plot {
            x: Axis { label: unit.to_owned(), scale: Scale::Log },
            y: Axis { label: "time of a frame in ms".to_owned(), scale: Scale::Log },
            series: vec![
                series("CPU, the recording thread", |run| run.cpu_ms_per_frame),
                series("device and all threads, on the wall", |run| run.wall_ms_per_frame),
            ],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sweep_stays_bearable() {
        let base = StressOptions { casters: 16, techniques: Variety::Own, ..StressOptions::default() };
        let triangles: Vec<_> =
            SweepAxis::Triangles.options(&base).iter().map(|options| options.triangles_per_caster).collect();
        assert_eq!(triangles, [1_000, 4_000, 16_000, 64_000]);
        assert_eq!(SweepAxis::Casters.options(&base).len(), 5);
        assert!(SweepAxis::Lights.options(&base).iter().all(|options| options.techniques == Variety::Same));
        for axis in SweepAxis::ALL {
            assert_eq!(axis.name().parse(), Ok(axis));
        }
    }

    #[test]
    fn lines_and_points_are_those_of_the_runs() {
        let run = |lights| Summary { lights, cpu_ms_per_frame: 0.5, wall_ms_per_frame: 9.0, ..Summary::default() };
        let sweep = Sweep { axis: SweepAxis::Lights, runs: vec![run(1), run(2)] };
        let csv = sweep.csv();
        assert_eq!(csv.lines().count(), 3);
        assert!(csv.lines().all(|line| line.split(',').count() == SWEEP_COLUMNS.len()), "{csv}");
        assert_eq!(sweep.plot().series[0].points, [[1.0, 0.5], [2.0, 0.5]]);
    }
}
