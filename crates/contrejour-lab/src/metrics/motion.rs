//! How much a shadow jumps while its light moves slowly.

use serde::{Deserialize, Serialize};

use super::MetricError;
use super::input::check_visibility;
use super::quantile::percentile;

/// Change of visibility between consecutive frames beyond what the truth does: per pixel and step
/// `max(0, |V' - V| - |T' - T|)` with technique V and truth T. Only the excess counts: a shadow that stands still where
/// it should move is wrong, but does not jump.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct MotionExcess {
    /// Steps from one frame to the next. Range: 1 or more.
    pub steps: u64,
    /// Mean excess over all pixels and steps. Range: 0 to 1.
    pub mean: f64,
    /// The excess that 99 % of all pixels and steps do not exceed (nearest rank). Range: 0 to 1.
    pub percentile_99: f64,
    /// Largest excess. Range: 0 to 1.
    pub largest: f64,
}

/// Compares the frames of a technique with those of the truth under one mask; none where the mask is empty.
///
/// # Errors
///
/// Different numbers of frames, fewer than two, a frame of another length, or a value under the mask that is no
/// visibility.
pub fn motion_excess<Frame: AsRef<[f32]>>(
    truth: &[Frame],
    technique: &[Frame],
    mask: &[bool],
) -> Result<Option<MotionExcess>, MetricError> {
    if truth.len() != technique.len() || truth.len() < 2 {
        return Err(MetricError::Frames { truth: truth.len(), technique: technique.len() });
    }
    for (truth, technique) in truth.iter().zip(technique) {
        check_visibility("the truth", truth.as_ref(), mask)?;
        check_visibility("the technique", technique.as_ref(), mask)?;
    }
    let mut excess = Vec::new();
    for (truth, technique) in truth.windows(2).zip(technique.windows(2)) {
        let changes = changes(truth).zip(changes(technique)).zip(mask);
        excess
            .extend(changes.filter(|&(_, counts)| *counts).map(|((truth, technique), _)| (technique - truth).max(0.0)));
    }
    let mean = excess.iter().sum::<f64>() / excess.len() as f64;
    let largest = excess.iter().copied().fold(0.0, f64::max);
    // Last, for it changes the order.
    let percentile_99 = percentile(&mut excess, 99);
    let steps = truth.len() as u64 - 1;
    Ok(percentile_99.map(|percentile_99| MotionExcess { steps, mean, percentile_99, largest }))
}

/// Absolute change of each pixel from the first of two frames to the second.
fn changes<Frame: AsRef<[f32]>>(frames: &[Frame]) -> impl Iterator<Item = f64> {
    let [before, after] = [frames[0].as_ref(), frames[1].as_ref()];
    before.iter().zip(after).map(|(&before, &after)| (f64::from(after) - f64::from(before)).abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn excess(truth: &[[f32; 3]], technique: &[[f32; 3]], mask: [bool; 3]) -> MotionExcess {
        motion_excess(truth, technique, &mask).expect("the input is sound").expect("pixels count")
    }

    #[test]
    fn only_the_excess_counts() {
        let truth = [[0.0, 0.0, 0.0], [0.25, 0.0, 0.0], [0.5, 0.0, 0.0]];
        // The first pixel jumps 0.5 where the truth moves 0.25, then stands still where the truth moves: the latter is
        // no jump. The second does as the truth does. The third is not a receiver.
        let technique = [[0.0, 1.0, 0.0], [0.5, 1.0, 1.0], [0.5, 1.0, 0.0]];
        assert_eq!(
            excess(&truth, &technique, [true, true, false]),
            MotionExcess { steps: 2, mean: 0.25 / 4.0, percentile_99: 0.25, largest: 0.25 }
        );
    }

    #[test]
    fn moving_as_the_truth_does_is_no_jump_and_snapping_is() {
        let slide: Vec<[f32; 3]> = (0..=4_u8).map(|step| [f32::from(step) / 4.0; 3]).collect();
        assert_eq!(excess(&slide, &slide, [true; 3]).largest, 0.0);
        // An offset that stays is an error, not a jump; the other direction at the same speed neither.
        let reversed: Vec<_> = slide.iter().rev().copied().collect();
        assert_eq!(excess(&slide, &reversed, [true; 3]).mean, 0.0);
        let mut snapping = slide.clone();
        snapping[1..4].fill([0.0; 3]);
        // 1 where the truth moves 0.25, in one of four steps.
        assert_eq!(excess(&slide, &snapping, [true; 3]).mean, 0.75 / 4.0);
    }

    #[test]
    fn unsound_input_is_refused() {
        let frame = [0.5; 3];
        let mask = [true; 3];
        for (truth, technique) in [(1, 1), (2, 3), (0, 0)] {
            assert_eq!(
                motion_excess(&vec![frame; truth], &vec![frame; technique], &mask),
                Err(MetricError::Frames { truth, technique })
            );
        }
        assert!(motion_excess(&[frame, frame], &[frame, [f32::NAN; 3]], &mask).is_err());
        assert_eq!(motion_excess(&[frame, frame], &[frame, frame], &[false; 3]), Ok(None));
    }
}
