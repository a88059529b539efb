//! Error against time of one scene.

use super::figure::{Axis, Plot, Scale, Series, Stroke};
use super::{Contestant, Report};
use crate::metrics::pareto_front;

impl Report {
    /// RMSE against time of a scene: who stands for each family, joined over the map sizes, and the Pareto front of
    /// these points. None where no group has a time that a logarithmic axis takes.
    pub fn error_plot(&self, scene: &str) -> Option<Plot> {
        let has_time = |contestant: &&Contestant| contestant.cost.whole().median_ms > 0.0;
        let families = self.families().into_iter().map(|family| {
            let standing = self.groups_of(scene).filter_map(|group| group.standing_for(family));
            let points = standing.filter(has_time).map(Contestant::time_and_error).collect();
            Series { label: family.to_owned(), points, stroke: Stroke::Line }
        });
        let mut series: Vec<Series> = families.filter(|series| !series.points.is_empty()).collect();
        let points: Vec<[f64; 2]> = series.iter().flat_map(|series| series.points.iter().copied()).collect();
        if points.is_empty() {
            return None;
        }
        let mut front: Vec<[f64; 2]> = points
            .iter()
            .zip(pareto_front(&points))
            .filter(|(_, on_front)| *on_front)
            .map(|(point, _)| *point)
            .collect();
        front.sort_by(|a, b| a[0].total_cmp(&b[0]));
        series.push(Series { label: "Pareto front".to_owned(), points: front, stroke: Stroke::Ringed });
        Some(Plot {
            x: Axis { label: "time of the whole shadow work in ms".to_owned(), scale: Scale::Log },
            y: Axis { label: "RMSE of visibility".to_owned(), scale: Scale::Linear },
            series,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::sample::{contestant, group, report};

    #[test]
    fn families_are_joined_over_sizes_and_the_front_is_marked() {
        let report = report(vec![
            group(
                "square",
                512,
                vec![
                    contestant("plain", "plain", "shadow-map", 0.2, 1.0),
                    contestant("pcss a", "pcss", "pcss", 0.1, 2.0),
                    contestant("pcss b", "pcss", "pcss", 0.3, 9.0),
                ],
            ),
            group(
                "square",
                1024,
                vec![
                    contestant("plain", "plain", "shadow-map", 0.15, 3.0),
                    contestant("pcss a", "pcss", "pcss", 0.05, 4.0),
                ],
            ),
            group("other", 1024, vec![contestant("plain", "plain", "shadow-map", 0.0, 0.1)]),
        ]);
        let plot = report.error_plot("square").expect("there are times");
        let found: Vec<_> =
            plot.series.iter().map(|series| (series.label.as_str(), series.points.as_slice())).collect();
        assert_eq!(
            found,
            [
                ("plain", [[1.0, 0.2], [3.0, 0.15]].as_slice()),
                ("pcss", &[[2.0, 0.1], [4.0, 0.05]]),
                ("Pareto front", &[[1.0, 0.2], [2.0, 0.1], [4.0, 0.05]]),
            ]
        );
        assert_eq!(report.error_plot("none"), None);
    }
}
