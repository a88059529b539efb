//! What follows from the measured figures.

use std::cmp::Ordering;

use super::cost::{Cost, CostRatio, StageRatio};
use super::model::{Contestant, Group, Report};
use crate::metrics::pareto_front;

/// Name of the technique that all costs are compared with.
pub const BASELINE_TECHNIQUE: &str = "shadow-map";

impl Report {
    /// Settles every group.
    pub fn settle(&mut self) {
        self.groups.iter_mut().for_each(Group::settle);
    }
}

impl Group {
    /// Fills in what follows from the measured figures: who stands for its family, who is on the Pareto front of error
    /// and time, and all ratios to the plain shadow map.
    pub fn settle(&mut self) {
        let baseline = self.baseline().map(|baseline| baseline.cost.clone());
        let front = pareto_front(&self.contestants.iter().map(Contestant::time_and_error).collect::<Vec<_>>());
        let stands: Vec<bool> = (0..self.contestants.len()).map(|index| index == self.best_of_family(index)).collect();
        for ((contestant, on_front), stands) in self.contestants.iter_mut().zip(front).zip(stands) {
            contestant.on_front = on_front;
            contestant.stands = stands;
            contestant.ratio = baseline.as_ref().map(|baseline| CostRatio::of(&contestant.cost, baseline));
        }
    }

    /// The plain shadow map: the first contestant with its technique.
    pub fn baseline(&self) -> Option<&Contestant> {
        self.contestants.iter().find(|contestant| contestant.technique == BASELINE_TECHNIQUE)
    }

    /// Those that stand for their families, in the order of the group.
    pub fn standing(&self) -> impl Iterator<Item = &Contestant> {
        self.contestants.iter().filter(|contestant| contestant.stands)
    }

    /// Index of the variant that stands for a contestant's family; of equal ones the first.
    fn best_of_family(&self, index: usize) -> usize {
        let family = &self.contestants[index].family;
        let variants = (0..self.contestants.len()).filter(|&other| self.contestants[other].family == *family);
        variants.min_by(|&a, &b| self.contestants[a].by_error_then_time(&self.contestants[b])).unwrap_or(index)
    }
}

impl Contestant {
    /// Median time in milliseconds, and RMSE over receivers.
    pub fn time_and_error(&self) -> [f64; 2] {
        [self.cost.whole().median_ms, self.errors.receivers.rmse]
    }

    /// The more exact one is less, of equally exact ones the faster.
    fn by_error_then_time(&self, other: &Self) -> Ordering {
        let [[time, error], [other_time, other_error]] = [self, other].map(Self::time_and_error);
        error.total_cmp(&other_error).then(time.total_cmp(&other_time))
    }
}

impl CostRatio {
    /// A cost over that of the plain shadow map.
    pub fn of(cost: &Cost, baseline: &Cost) -> Self {
        let bytes = |bytes: u64, of: u64| (of > 0).then(|| bytes as f64 / of as f64);
        Self {
            stages: cost
                .stages
                .iter()
                .map(|stage| StageRatio { name: stage.name.clone(), ratio: stage.timing.over(baseline.whole()) })
                .collect(),
            device: cost.device.as_ref().zip(baseline.device.as_ref()).and_then(|(device, whole)| device.over(whole)),
            wall: cost.wall.over(&baseline.wall),
            record: cost.record.over(&baseline.record),
            maps: bytes(cost.map_bytes, baseline.map_bytes),
            buffers: bytes(cost.buffer_bytes, baseline.buffer_bytes),
        }
    }
}

#[cfg(test)]
mod tests {
    use contrejour_plan::Technique;

    use super::super::findings::OURS;
    use super::super::sample::{contestant, group};
    use super::BASELINE_TECHNIQUE;
    use crate::metrics::Ratio;

    #[test]
    fn the_techniques_that_are_singled_out_exist() {
        for name in [BASELINE_TECHNIQUE, OURS] {
            assert!(Technique::NAMES.contains(&name), "{name}");
        }
        assert!(!Technique::NAMES.contains(&"smoothie"));
    }

    #[test]
    fn the_most_exact_variant_stands_for_its_family() {
        let mut group = group(
            "square",
            1024,
            vec![
                contestant("plain", "plain", "shadow-map", 0.11, 1.0),
                contestant("pcss, radius 1", "pcss", "pcss", 0.03, 2.0),
                contestant("pcss, radius 2", "pcss", "pcss", 0.02, 3.0),
                contestant("pcss, radius 3", "pcss", "pcss", 0.02, 2.5),
            ],
        );
        group.settle();
        let standing: Vec<_> = group.standing().map(|contestant| contestant.label.as_str()).collect();
        // Of two equally exact ones the faster.
        assert_eq!(standing, ["plain", "pcss, radius 3"]);
        // The first pcss is on the front, though it does not stand; the second is beaten by the third.
        assert_eq!(group.contestants.iter().map(|c| c.on_front).collect::<Vec<_>>(), [true, true, false, true]);
    }

    #[test]
    fn ratios_are_to_the_plain_shadow_map() {
        let mut group = group(
            "square",
            1024,
            vec![contestant("pcss", "pcss", "pcss", 0.02, 3.0), contestant("plain", "plain", "shadow-map", 0.11, 2.0)],
        );
        group.settle();
        let wall = |index: usize| group.contestants[index].ratio.as_ref().and_then(|ratio| ratio.wall);
        // The sample spreads times by 10 % each way.
        let [low, high] = [2.7 / 2.2, 3.3 / 1.8];
        let Some(Ratio { median, low: found_low, high: found_high }) = wall(0) else { panic!("there is a ratio") };
        assert!((median - 1.5).abs() < 1e-12 && (found_low - low).abs() < 1e-12 && (found_high - high).abs() < 1e-12);
        assert_eq!(wall(1).map(|ratio| ratio.median), Some(1.0));

        group.contestants.remove(1);
        group.settle();
        assert_eq!(group.contestants[0].ratio, None, "nothing to compare with");
    }

    #[test]
    fn without_bytes_or_timestamps_there_is_no_ratio() {
        let mut plain = contestant("plain", "plain", "shadow-map", 0.11, 2.0);
        plain.cost.buffer_bytes = 0;
        plain.cost.device = None;
        let mut group = group("square", 1024, vec![plain, contestant("pcss", "pcss", "pcss", 0.02, 3.0)]);
        group.settle();
        let ratio = group.contestants[1].ratio.as_ref().expect("there is a plain shadow map");
        assert_eq!((ratio.buffers, ratio.device), (None, None));
        assert!(ratio.maps.is_some() && ratio.wall.is_some());
        // Wall-clock time stands in.
        assert_eq!(ratio.whole(), ratio.wall);
        let whole = group.contestants[0].cost.wall;
        assert_eq!(ratio.stages[0].ratio, group.contestants[1].cost.stages[0].timing.over(&whole));
    }
}
