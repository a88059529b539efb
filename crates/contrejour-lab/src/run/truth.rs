//! The truth of a scene: traced once, for all map sizes and contestants.

use contrejour_plan::Light;
use contrejour_scene::orbit;
use contrejour_trace::{Facing, Visibility};

use super::effort::Effort;
use super::error::RunError;
use super::event::{Event, Tell};
use super::subject::Subject;
use crate::metrics::penumbra_mask;
use crate::report::Truth;

/// Steps of a full turn of the moving light: a quarter of a degree each.
const STEPS_OF_A_TURN: u32 = 1440;

/// What the tracer found, for each pixel of a scene's picture.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct SceneTruth {
    /// Visibility; 1 where there is no receiver.
    pub visibility: Vec<f32>,
    /// Standard error of visibility.
    pub standard_error: Vec<f32>,
    /// Rays that were traced.
    pub samples: Vec<f32>,
    /// Whether the pixel is compared: it shows a receiver in the light's maps that has the whole light above its plane.
    pub compared: Vec<bool>,
    /// Visibility at each step of the moving light, with fewer samples; the first is the light itself.
    pub motion: Vec<Vec<f32>>,
    /// Whether the pixel is compared at every step.
    pub motion_compared: Vec<bool>,
}

/// The light at a step of its slow way.
pub(crate) fn moved(light: &Light, step: u32) -> Light {
    orbit(light, step, STEPS_OF_A_TURN)
}

impl SceneTruth {
    /// Traces a scene.
    pub fn trace(subject: &Subject, effort: &Effort, seed: u64, scene: &str, tell: Tell) -> Result<Self, RunError> {
        let rounds = 2 + u64::from(effort.motion_steps);
        let of = rounds * subject.pixels().len() as u64;
        tell(&Event::TruthBegins { scene, receivers: of });
        let progress = |receivers: usize| tell(&Event::TruthGrows { receivers: receivers as u64 });

        let pixels = subject.pixel_count();
        let mut truth = Self {
            visibility: vec![1.0; pixels],
            standard_error: vec![0.0; pixels],
            samples: vec![0.0; pixels],
            compared: vec![false; pixels],
            motion: Vec::new(),
            motion_compared: vec![false; pixels],
        };
        let light = &subject.light;
        let answers = subject.trace(light, &effort.truth_options(seed), 1, &progress)?;
        let in_maps = subject.in_maps(light)?;
        for ((&pixel, answer), in_maps) in subject.pixels().iter().zip(&answers).zip(in_maps) {
            truth.visibility[pixel] = answer.mean as f32;
            truth.standard_error[pixel] = answer.standard_error as f32;
            truth.samples[pixel] = answer.samples as f32;
            truth.compared[pixel] = in_maps && is_fair(answer);
        }
        truth.motion_compared.clone_from(&truth.compared);
        for step in 0..=effort.motion_steps {
            let light = moved(light, step);
            let answers = subject.trace(&light, &effort.motion_options(seed), 1, &progress)?;
            let in_maps = subject.in_maps(&light)?;
            let mut frame = vec![1.0; pixels];
            for ((&pixel, answer), in_maps) in subject.pixels().iter().zip(&answers).zip(in_maps) {
                frame[pixel] = answer.mean as f32;
                truth.motion_compared[pixel] &= in_maps && is_fair(answer);
            }
            truth.motion.push(frame);
        }
        tell(&Event::TruthDone);
        Ok(truth)
    }

    /// The compared pixels in the true penumbra.
    pub fn penumbra(&self) -> Result<Vec<bool>, RunError> {
        Ok(penumbra_mask(&self.visibility, &self.standard_error, &self.compared)?)
    }

    /// How exact it is over the compared pixels; none where there are none.
    pub fn exactness(&self) -> Option<Truth> {
        let compared = || self.compared.iter().enumerate().filter(|&(_, compares)| *compares).map(|(pixel, _)| pixel);
        let count = compared().count() as f64;
        let errors = || compared().map(|pixel| f64::from(self.standard_error[pixel]));
        (count > 0.0).then(|| Truth {
            samples_mean: compared().map(|pixel| f64::from(self.samples[pixel])).sum::<f64>() / count,
            standard_error_rms: (errors().map(|error| error * error).sum::<f64>() / count).sqrt(),
            standard_error_max: errors().fold(0.0, f64::max),
        })
    }
}

/// A technique sees one point of the light and calls a side that is averted from it dark; the truth sees the part of
/// the light above the receiver's plane. They mean the same where that is all of it.
pub(crate) fn is_fair(answer: &Visibility) -> bool {
    answer.facing == Facing::Towards
}
