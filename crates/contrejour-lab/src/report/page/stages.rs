//! Device time of each stage and pass.

use maud::{Markup, html};

use super::super::number::significant;
use super::super::{Group, Report};
use super::table::{boxed, number, timing};

pub(super) fn tables(report: &Report) -> Markup {
    let groups: Vec<&Group> = report.scenes().into_iter().filter_map(|scene| report.headline_of(scene)).collect();
    let timed: Vec<&Group> = groups.into_iter().filter(|group| !stages(group).is_empty()).collect();
    html! {
        @if !timed.is_empty() {
            p.lead {
                "Median device time of each stage and pass in milliseconds, in the order in which they run, for the "
                "variant that stands for its family. A dash: the technique has no such stage, so nothing runs."
            }
            @for (number, group) in timed.iter().enumerate() {
                // One is open, so that readers see what is in the others.
                details open[number == 0] {
                    summary { strong { (group.scene) } " at " (group.map_size) " texels" }
                    @let caption = format!("Stages and passes: {}, {} texels", group.scene, group.map_size);
                    (boxed(&caption, &[], head(group), body(group)))
                }
            }
        }
    }
}

fn head(group: &Group) -> Markup {
    html! {
        tr {
            th scope="col" { "Family" }
            th scope="col" { (whole(group)) }
            @for stage in stages(group) { th scope="col" { code { (stage.replace('_', "_\u{200b}")) } } }
        }
    }
}

/// Head of the column of whole times. Where device times do not cover all of the work, wall-clock stands in.
fn whole(group: &Group) -> &'static str {
    if group.standing().all(|contestant| contestant.cost.device.is_some()) { "whole" } else { "whole (wall-clock)" }
}

fn body(group: &Group) -> Markup {
    html! {
        @for contestant in group.standing() {
            tr {
                th scope="row" { (contestant.family) }
                td { (timing(contestant.cost.whole())) }
                @for name in stages(group) {
                    @let stage = contestant.cost.stages.iter().find(|stage| stage.name == name);
                    (number(stage.map(|stage| significant(stage.timing.median_ms, 2)), false))
                }
            }
        }
    }
}

/// Names of the stages of all that stand for their families. A stage that only some have comes after the one before
/// which it runs there.
fn stages(group: &Group) -> Vec<&str> {
    let mut names: Vec<&str> = Vec::new();
    for contestant in group.standing() {
        let mut place = 0;
        for stage in &contestant.cost.stages {
            match names.iter().position(|name| *name == stage.name) {
                Some(known) => place = known + 1,
                None => {
                    names.insert(place, &stage.name);
                    place += 1;
                }
            }
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::super::super::{Contestant, StageCost, sample};
    use super::*;

    #[test]
    fn stages_stand_in_the_order_in_which_they_run() {
        let with_stages = |family: &str, stages: &[&str]| -> Contestant {
            let mut contestant = sample::contestant(family, family, family, 0.1, 1.0);
            let timing = contestant.cost.wall;
            contestant.cost.stages = stages.iter().map(|&name| StageCost { name: name.into(), timing }).collect();
            contestant
        };
        let mut group = sample::group(
            "square",
            1024,
            vec![
                with_stages("plain", &["shadow_map", "visibility"]),
                with_stages("smoothies", &["classify_faces", "shadow_map", "smoothie_buffer", "visibility"]),
                with_stages("variance", &["shadow_map", "blur", "visibility"]),
            ],
        );
        group.settle();
        assert_eq!(stages(&group), ["classify_faces", "shadow_map", "blur", "smoothie_buffer", "visibility"]);
    }

    #[test]
    fn whole_times_on_the_wall_clock_are_called_so() {
        let head_of = |has_device: bool| {
            let mut contestant = sample::contestant("plain", "plain", "shadow-map", 0.1, 1.0);
            contestant.cost.device = contestant.cost.device.filter(|_| has_device);
            let mut group = sample::group("square", 1024, vec![contestant]);
            group.settle();
            head(&group).into_string()
        };
        assert!(head_of(false).contains(">whole (wall-clock)<"));
        assert!(head_of(true).contains(">whole<"));
    }
}
