//! Every variant of every family, with every figure.

use maud::{Markup, html};

use super::super::number::{bytes, grouped, percent, significant};
use super::super::{Contestant, Group, Report};
use super::table::{boxed, number, ratio, timing};

/// How many columns belong together, after that of the names.
const GROUPS: [usize; 8] = [3, 3, 2, 1, 3, 4, 2, 2];

pub(super) fn tables(report: &Report) -> Markup {
    html! {
        @if !report.groups.is_empty() {
            p.lead {
                "All that were measured, with their parameters. " span.mark { "●" } " stands for its family, "
                span.mark { "◯" } " is on the Pareto front of its scene and size. "
                "Spreads are the 5th and the 95th percentile."
            }
        }
        @for scene in report.scenes() {
            @for group in report.groups_of(scene) {
                details {
                    summary {
                        strong { (scene) } " at " (group.map_size) " texels "
                        small { (group.contestants.len()) " variants, " (grouped(group.faces)) " faces" }
                    }
                    (boxed(&format!("Every variant: {scene}, {} texels", group.map_size), &GROUPS, head(), body(group)))
                    (truth(group))
                }
            }
        }
    }
}

fn head() -> Markup {
    html! {
        tr {
            th rowspan="2" scope="col" { "Variant" }
            th.group colspan="3" scope="colgroup" { "Receivers" }
            th.group colspan="3" scope="colgroup" { "Penumbra" }
            th.group colspan="2" scope="colgroup" { "Umbra" }
            th.group rowspan="2" scope="col" { "FLIP" }
            th.group colspan="3" scope="colgroup" { "Motion" }
            th.group colspan="4" scope="colgroup" { "Time in ms, and over the plain shadow map's" }
            th.group colspan="2" scope="colgroup" { "CPU record in ms" }
            th.group colspan="2" scope="colgroup" { "Memory" }
        }
        tr {
            @for _ in 0..2 { @for name in ["RMSE", "mean", "99 %"] { th scope="col" { (name) } } }
            @for name in [
                "too large", "too small", "mean", "99 %", "largest", "device", "×", "wall-clock", "×", "median", "×",
                "maps", "buffers",
            ] {
                th scope="col" { (name) }
            }
        }
    }
}

fn body(group: &Group) -> Markup {
    html! { @for contestant in &group.contestants { (row(contestant)) } }
}

fn row(contestant: &Contestant) -> Markup {
    let errors = &contestant.errors;
    let cost = &contestant.cost;
    let over = contestant.ratio.as_ref();
    let figures = |figures: Option<&crate::metrics::ErrorFigures>| {
        let three = |value: f64| significant(value, 3);
        let cell = |value: fn(&crate::metrics::ErrorFigures) -> f64| number(figures.map(value).map(three), false);
        html! { (cell(|f| f.rmse)) (cell(|f| f.mean_absolute)) (cell(|f| f.percentile_99)) }
    };
    html! {
        tr.stands[contestant.stands] {
            th scope="row" {
                (contestant.label)
                @if contestant.stands { " " span.mark title="stands for its family" { "●" } }
                @if contestant.on_front { " " span.mark title="on the Pareto front" { "◯" } }
                @if !contestant.parameters.is_empty() { br; small { (parameters(contestant)) } }
            }
            (figures(Some(&errors.receivers)))
            (figures(errors.penumbra.as_ref()))
            (number(Some(percent(errors.umbra.too_large())), false))
            (number(Some(percent(errors.umbra.too_small())), false))
            (number(errors.flip.map(|flip| significant(flip, 3)), false))
            (number(errors.motion.map(|motion| significant(motion.mean, 2)), false))
            (number(errors.motion.map(|motion| significant(motion.percentile_99, 2)), false))
            (number(errors.motion.map(|motion| significant(motion.largest, 3)), false))
            td { @if let Some(device) = &cost.device { (timing(device)) } @else { "–" } }
            td { (ratio(over.and_then(|over| over.device))) }
            td { (timing(&cost.wall)) }
            td { (ratio(over.and_then(|over| over.wall))) }
            td { (timing(&cost.record)) }
            td { (ratio(over.and_then(|over| over.record))) }
            td { (bytes(cost.map_bytes)) (multiple(over.and_then(|over| over.maps))) }
            td { (bytes(cost.buffer_bytes)) (multiple(over.and_then(|over| over.buffers))) }
        }
    }
}

fn multiple(of: Option<f64>) -> Markup {
    html! { @if let Some(of) = of { " " span.spread { (significant(of, 2)) "×" } } }
}

fn parameters(contestant: &Contestant) -> String {
    let all = contestant.parameters.iter().map(|parameter| format!("{} {}", parameter.name, parameter.value));
    all.collect::<Vec<_>>().join(", ")
}

fn truth(group: &Group) -> Markup {
    let truth = &group.truth;
    html! {
        p.note {
            (grouped(group.edges)) " edges; light of size " (significant(group.light_size, 3)) ". Truth: "
            (significant(truth.samples_mean, 3)) " light samples a pixel on average, standard error "
            (significant(truth.standard_error_rms, 2)) " (root mean square), at most "
            (significant(truth.standard_error_max, 2)) ". " (group.machine.device) "."
        }
    }
}
