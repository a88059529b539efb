//! How long a run will take, from a small part of its work.

use std::time::{Duration, Instant};

use contrejour_render::{Gpu, rocked};

use super::arena::truth_key;
use super::contestants::Entrant;
use super::error::RunError;
use super::folder::RunFolder;
use super::manifest::Work;
use super::options::RunOptions;
use super::subject::{NamedScene, Subject};
use super::truth::SceneTruth;

/// One of so many receivers is traced.
const STRIDE: usize = 101;

/// Frames that an entrant draws: the first compiles, so the others are timed.
const FRAMES: usize = 3;

/// Time of a scene's work at one map size, for one entrant.
#[derive(Clone, Copy, Debug, Default)]
struct EntrantTime {
    set_up: f64,
    frame: f64,
}

/// Estimates the time of all groups that are still to be measured.
pub(super) fn estimate(
    gpu: &Gpu,
    options: &RunOptions,
    entrants: &[Entrant],
    pending: &[Work],
    folder: &RunFolder,
) -> Result<Duration, RunError> {
    let mut seconds = 0.0;
    for (index, named) in options.scenes.iter().enumerate() {
        let sizes: Vec<u32> = pending.iter().filter(|work| work.scene == index).map(|work| work.map_size).collect();
        let (Some(&least), Some(&most)) = (sizes.iter().min(), sizes.iter().max()) else { continue };
        let subject = Subject::new(gpu, named, options.effort.picture_size)?;
        seconds += truth_seconds(&subject, named, options, folder)?;
        let at_least = entrant_time(&subject, entrants, least)?;
        let at_most = if most == least { at_least } else { entrant_time(&subject, entrants, most)? };
        for size in sizes {
            let EntrantTime { set_up, frame } = at_least.towards(at_most, share_by_area(size, least, most));
            seconds += entrants.len() as f64 * (set_up + options.effort.frames() as f64 * frame);
        }
    }
    Ok(Duration::from_secs_f64(seconds))
}

/// Time to trace what is not kept yet.
fn truth_seconds(
    subject: &Subject,
    named: &NamedScene,
    options: &RunOptions,
    folder: &RunFolder,
) -> Result<f64, RunError> {
    if SceneTruth::load(&truth_key(named, subject, options), &folder.truth_file(&named.name)).is_some() {
        return Ok(0.0);
    }
    let effort = &options.effort;
    let positions = f64::from(effort.motion_steps + 1);
    let mut seconds = 0.0;
    for (times, options) in
        [(1.0, effort.truth_options(options.seed)), (positions, effort.motion_options(options.seed))]
    {
        let clock = Instant::now();
        subject.trace(&subject.light, &options, STRIDE, &|_| ())?;
        seconds += times * STRIDE as f64 * clock.elapsed().as_secs_f64();
    }
    Ok(seconds)
}

/// Mean time of the first, the middle and the last entrant.
fn entrant_time(subject: &Subject, entrants: &[Entrant], map_size: u32) -> Result<EntrantTime, RunError> {
    let chosen = [0, entrants.len() / 2, entrants.len() - 1].map(|index| &entrants[index]);
    let mut mean = EntrantTime::default();
    for entrant in chosen {
        let clock = Instant::now();
        let mut drawing = subject.judge.contestant(&entrant.settings(&subject.shadow, map_size))?;
        drawing.draw(&subject.light)?;
        mean.set_up += clock.elapsed().as_secs_f64() / chosen.len() as f64;
        let clock = Instant::now();
        for frame in 1..FRAMES {
            drawing.draw(&rocked(&subject.light, frame))?;
        }
        mean.frame += clock.elapsed().as_secs_f64() / (chosen.len() * (FRAMES - 1)) as f64;
    }
    Ok(mean)
}

/// How far a map's area is on the way from the least to the most.
fn share_by_area(size: u32, least: u32, most: u32) -> f64 {
    let area = |size: u32| f64::from(size) * f64::from(size);
    let range = area(most) - area(least);
    if range > 0.0 { (area(size) - area(least)) / range } else { 0.0 }
}

impl EntrantTime {
    fn towards(self, other: Self, share: f64) -> Self {
        let mix = |a: f64, b: f64| a + share * (b - a);
        Self { set_up: mix(self.set_up, other.set_up), frame: mix(self.frame, other.frame) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn time_follows_the_area_between_what_was_tried() {
        assert_eq!([256, 512, 1024].map(|size| share_by_area(size, 256, 1024)), [0.0, 0.2, 1.0]);
        assert_eq!(share_by_area(512, 512, 512), 0.0);
        let [low, high] = [1.0, 3.0].map(|frame| EntrantTime { set_up: 2.0, frame });
        assert_eq!(low.towards(high, 0.25).frame, 1.5);
    }
}
