//! What a frame costs each contestant, measured taking turns.

use contrejour_plan::Light;
use contrejour_render::{Contestant, FrameCost, rocked};

use super::effort::Effort;
use super::error::RunError;
use super::event::{Event, Tell};
use crate::metrics::Timing;
use crate::report::{Cost, StageCost};

/// Times of one contestant, a value a frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Samples {
    wall_ms: Vec<f64>,
    record_ms: Vec<f64>,
    device_ms: Vec<f64>,
    passes_ms: Vec<(String, Vec<f64>)>,
}

/// Lets all contestants draw frame by frame, each round in another order, so that drift and neighbours hit all alike.
/// The light moves by a hair from frame to frame, so that none may keep its maps.
pub(super) fn take_turns(
    contestants: &mut [(String, Contestant)],
    light: &Light,
    effort: &Effort,
    seed: u64,
    tell: Tell,
) -> Result<Vec<Samples>, RunError> {
    let mut samples = vec![Samples::default(); contestants.len()];
    let mut order: Vec<usize> = (0..contestants.len()).collect();
    let mut random = fastrand::Rng::with_seed(seed);
    for round in 0..effort.warm_up_rounds + effort.timed_rounds {
        random.shuffle(&mut order);
        for &index in &order {
            let (label, contestant) = &mut contestants[index];
            let cost = contestant.draw(&rocked(light, round))?;
            tell(&Event::FrameDone);
            if round < effort.warm_up_rounds {
                continue;
            }
            if cost.is_unchanged {
                return Err(RunError::StoodStill { label: label.clone() });
            }
            samples[index].add(cost);
        }
    }
    Ok(samples)
}

impl Samples {
    fn add(&mut self, frame: FrameCost) {
        self.wall_ms.push(frame.wall_ms);
        self.record_ms.push(frame.cpu_ms);
        self.device_ms.extend(frame.gpu_ms);
        for pass in frame.passes {
            match self.passes_ms.iter_mut().find(|(name, _)| *name == pass.name) {
                Some((_, times)) => times.push(pass.gpu_ms),
                None => self.passes_ms.push((pass.name, vec![pass.gpu_ms])),
            }
        }
    }

    /// Medians and spreads, with the memory that the contestant holds. Timestamps of a software device tell little of
    /// compute passes, so it has times of its passes and none of the device as a whole.
    pub fn cost(&self, contestant: &Contestant, is_software: bool) -> Result<Cost, RunError> {
        let stage = |(name, times): &(String, Vec<f64>)| {
            Ok::<_, RunError>(StageCost { name: name.clone(), timing: Timing::from_samples(times)? })
        };
        let has_device_time = !is_software && !self.device_ms.is_empty();
        Ok(Cost {
            stages: self.passes_ms.iter().map(stage).collect::<Result<_, _>>()?,
            device: has_device_time.then(|| Timing::from_samples(&self.device_ms)).transpose()?,
            wall: Timing::from_samples(&self.wall_ms)?,
            record: Timing::from_samples(&self.record_ms)?,
            map_bytes: contestant.map_bytes(),
            buffer_bytes: contestant.buffer_bytes(),
        })
    }
}

#[cfg(test)]
mod tests {
    use contrejour_render::PassTime;

    use super::*;

    #[test]
    fn a_frame_has_a_time_of_its_own_beside_its_passes() {
        let frame = |times: [f64; 2]| FrameCost {
            cpu_ms: 0.5,
            wall_ms: 9.0,
            gpu_ms: Some(times[0] + times[1] + 0.5),
            passes: ["shadow_map", "visibility"]
                .into_iter()
                .zip(times)
                .map(|(name, gpu_ms)| PassTime { name: name.into(), gpu_ms })
                .collect(),
            is_unchanged: false,
            repeats: 0,
        };
        let mut samples = Samples::default();
        samples.add(frame([1.0, 2.0]));
        samples.add(frame([3.0, 5.0]));
        samples.add(FrameCost { gpu_ms: None, passes: Vec::new(), ..frame([0.0; 2]) });
        assert_eq!(samples.device_ms, [3.5, 8.5]);
        assert_eq!(samples.wall_ms.len(), 3);
        let passes = [("shadow_map".to_owned(), vec![1.0, 3.0]), ("visibility".to_owned(), vec![2.0, 5.0])];
        assert_eq!(samples.passes_ms, passes);
    }
}
