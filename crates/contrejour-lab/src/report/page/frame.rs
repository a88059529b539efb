//! Head, findings and foot of the page.

use maud::{Markup, html};

use super::super::{Extent, Machine, Report};

pub(super) const TITLE: &str = "Error against run time of shadows";

pub(super) fn head(report: &Report) -> Markup {
    let header = &report.header;
    let [width, height] = header.picture_size;
    let extent = match header.extent {
        Extent::Quick => "quick: a few scenes and sizes, small pictures",
        Extent::Full => "full",
    };
    html! {
        header {
            p.kicker { "contrejour " (header.version) }
            h1 { (TITLE) }
            p.lead {
                "Shadow techniques on the same scenes, maps, lights and final pass: how far each one's visibility is "
                "from a ray-traced area light at the very same surface points, and what it costs. All times of a "
                "table were taken by turns, frame by frame, in one run."
            }
            dl.facts {
                div { dt { "Command" } dd { code { (header.command) } } }
                @if let Some(part) = part(report) { div { dt { "Part" } dd { strong.warning { (part) } } } }
                @for machine in machines(report) {
                    div {
                        dt { "Device" }
                        dd {
                            (machine.device) ", " (machine.cores) " CPU threads"
                            @if machine.is_software {
                                " " strong.warning { "software device: its times are not a GPU's" }
                            }
                        }
                    }
                }
                div { dt { "Extent" } dd { (extent) } }
                div { dt { "Pictures" } dd { (width) " × " (height) " pixels, seed " (header.seed) } }
            }
        }
    }
}

pub(super) fn findings(report: &Report) -> Markup {
    let findings = report.findings();
    html! {
        @for sentence in &findings.summary { p.summary { (sentence) } }
        @if !findings.scenes.is_empty() {
            div.cards {
                @for scene in &findings.scenes {
                    article {
                        h3 { (scene.scene) " " small { (scene.map_size) " texels" } }
                        ul { @for sentence in &scene.sentences { li { (sentence) } } }
                    }
                }
            }
        }
    }
}

pub(super) fn foot(report: &Report) -> Markup {
    html! {
        footer {
            p {
                "All figures of this page, and more digits of them, stand in " code { "report.csv" } " and "
                code { "report.json" } " beside it. Text and tables are made from them; nothing is written by hand. "
                "Make it again with " code { (report.header.command) } "."
            }
        }
    }
}

/// Which part of what was asked for the report is; none where it is all.
fn part(report: &Report) -> Option<String> {
    let (measured, asked) = (report.groups.len(), report.header.groups_asked);
    let shard = report.header.shard.as_ref().map_or_else(String::new, |shard| format!("shard {shard}: "));
    (measured < asked).then(|| format!("{shard}{measured} of {asked} groups measured"))
}

/// Every machine once, in the order of the groups.
fn machines(report: &Report) -> Vec<&Machine> {
    let mut machines: Vec<&Machine> = Vec::new();
    for group in &report.groups {
        if !machines.contains(&&group.machine) {
            machines.push(&group.machine);
        }
    }
    machines
}

#[cfg(test)]
mod tests {
    use super::super::super::sample::{group, report};
    use super::*;

    #[test]
    fn a_part_of_a_report_says_so() {
        let mut report = report(vec![group("square", 256, Vec::new())]);
        assert_eq!(part(&report), None);
        assert!(!head(&report).into_string().contains("<dt>Part"));
        report.header.groups_asked = 3;
        assert!(head(&report).into_string().contains("1 of 3 groups measured"));
        report.header.shard = Some("2/3".into());
        assert_eq!(part(&report).as_deref(), Some("shard 2/3: 1 of 3 groups measured"));
    }
}
