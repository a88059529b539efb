//! Whether two runs found the same.

use super::{Contestant, CostRatio, Group, Report};
use crate::metrics::Ratio;

/// Something that two reports of the same command on the same machine should agree on and do not.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum Disagreement {
    /// A scene and map size that one report lacks.
    #[error("{scene} at {map_size}: only one of the reports has it; run both with the same scenes and sizes")]
    Group {
        /// The scene.
        scene: String,
        /// The map size.
        map_size: u32,
    },
    /// A contestant that one report lacks.
    #[error("{scene} at {map_size}, {label}: only one of the reports has it; run both with the same techniques")]
    Contestant {
        /// The scene.
        scene: String,
        /// The map size.
        map_size: u32,
        /// The contestant.
        label: String,
    },
    /// Error figures that differ in some digit.
    #[error("{scene} at {map_size}, {label}: error figures differ; something drew or traced otherwise the second time")]
    Errors {
        /// The scene.
        scene: String,
        /// The map size.
        map_size: u32,
        /// The contestant.
        label: String,
    },
    /// A time ratio that is outside the spread that the other report gives.
    #[error(
        "{scene} at {map_size}, {label}: {clock} time is {found} times the plain shadow map's, and {low} to {high} \
         times in the other report; measure more frames on a quieter machine"
    )]
    Ratio {
        /// The scene.
        scene: String,
        /// The map size.
        map_size: u32,
        /// The contestant.
        label: String,
        /// Which time.
        clock: &'static str,
        /// The ratio of one report.
        found: f64,
        /// The least ratio within the other's spread.
        low: f64,
        /// The largest ratio within the other's spread.
        high: f64,
    },
}

impl Report {
    /// What two runs do not agree on: error figures are the same to the last digit, each time ratio is within the other
    /// report's spread. Empty where they agree.
    pub fn disagreements(&self, other: &Self) -> Vec<Disagreement> {
        let mut found = Vec::new();
        for (a, b) in [(self, other), (other, self)] {
            for group in &a.groups {
                match b.groups.iter().find(|like| like.is_like(group)) {
                    Some(like) => compare_groups(group, like, &mut found),
                    None => found.push(Disagreement::Group { scene: group.scene.clone(), map_size: group.map_size }),
                }
            }
        }
        found
    }
}

impl Group {
    fn is_like(&self, other: &Self) -> bool {
        self.scene == other.scene && self.map_size == other.map_size
    }
}

/// Holds the ratios of one group against the spreads of the other. The caller asks both ways round.
fn compare_groups(group: &Group, like: &Group, found: &mut Vec<Disagreement>) {
    for contestant in &group.contestants {
        let (scene, map_size, label) = (group.scene.clone(), group.map_size, contestant.label.clone());
        match like.contestants.iter().find(|like| like.label == contestant.label) {
            None => found.push(Disagreement::Contestant { scene, map_size, label }),
            Some(like) => {
                if contestant.errors != like.errors {
                    found.push(Disagreement::Errors { scene: scene.clone(), map_size, label: label.clone() });
                }
                found.extend(ratios_outside(contestant, like).map(|(clock, found, spread)| Disagreement::Ratio {
                    scene: scene.clone(),
                    map_size,
                    label: label.clone(),
                    clock,
                    found,
                    low: spread.low,
                    high: spread.high,
                }));
            }
        }
    }
}

/// One of a contestant's time ratios.
type Clock = fn(&CostRatio) -> Option<Ratio>;

/// A contestant's time ratios that are outside the spreads of its like.
fn ratios_outside(contestant: &Contestant, like: &Contestant) -> impl Iterator<Item = (&'static str, f64, Ratio)> {
    let ratio = |contestant: &Contestant, clock: Clock| contestant.ratio.as_ref().and_then(clock);
    let clocks: [(&str, Clock); 3] =
        [("device", |ratio| ratio.device), ("wall-clock", |ratio| ratio.wall), ("CPU record", |ratio| ratio.record)];
    let pairs = clocks.map(|(name, clock)| Some((name, ratio(contestant, clock)?.median, ratio(like, clock)?)));
    let is_outside = |(_, found, spread): &(&str, f64, Ratio)| !(spread.low..=spread.high).contains(found);
    pairs.into_iter().flatten().filter(is_outside)
}

#[cfg(test)]
mod tests {
    use super::super::sample;
    use super::*;

    fn report(rmse: f64, time_ms: f64) -> Report {
        let contestants = vec![
            sample::contestant("plain", "plain", "shadow-map", 0.11, 1.0),
            sample::contestant("smoothies", "smoothies", "smoothies", rmse, time_ms),
        ];
        sample::report(vec![sample::group("square", 1024, contestants)])
    }

    #[test]
    fn equal_errors_and_times_within_the_spread_agree() {
        assert_eq!(report(0.14, 1.3).disagreements(&report(0.14, 1.3)), []);
        assert_eq!(report(0.14, 1.3).disagreements(&report(0.14, 1.4)), []);
    }

    #[test]
    fn one_digit_of_an_error_is_seen() {
        let found = report(0.14, 1.3).disagreements(&report(0.14_f64.next_up(), 1.3));
        let errors = Disagreement::Errors { scene: "square".into(), map_size: 1024, label: "smoothies".into() };
        assert_eq!(found, [errors.clone(), errors]);
    }

    #[test]
    fn times_outside_the_spread_are_seen() {
        let found = report(0.14, 1.3).disagreements(&report(0.14, 2.6));
        assert_eq!(found.len(), 6, "three clocks, both ways round");
        assert!(found.iter().all(|found| matches!(found, Disagreement::Ratio { .. })));
        assert!(found[0].to_string().contains("smoothies: device time is 1.3 times"), "{}", found[0]);
    }

    #[test]
    fn what_one_report_lacks_is_seen_from_both_sides() {
        let whole = report(0.14, 1.3);
        let mut without_contestant = whole.clone();
        without_contestant.groups[0].contestants.pop();
        let mut without_group = whole.clone();
        without_group.groups.clear();
        for (a, b) in [(&whole, &without_contestant), (&without_contestant, &whole)] {
            assert!(matches!(a.disagreements(b).as_slice(), [Disagreement::Contestant { .. }]));
        }
        for (a, b) in [(&whole, &without_group), (&without_group, &whole)] {
            assert!(matches!(a.disagreements(b).as_slice(), [Disagreement::Group { .. }]));
        }
    }
}
