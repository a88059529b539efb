//! The tables at a glance: families down, scenes across.

use maud::{Markup, html};

use super::super::number::significant;
use super::super::{Contestant, Group, Report};
use super::table::{boxed, least, number};

/// A figure of a contestant that the tables give.
struct Column {
    head: &'static str,
    value: fn(&Contestant) -> Option<f64>,
    print: fn(f64) -> String,
}

const COLUMNS: [Column; 3] = [
    Column {
        head: "RMSE",
        value: |contestant| Some(contestant.errors.receivers.rmse),
        print: |value| significant(value, 3),
    },
    Column {
        head: "in penumbra",
        value: |contestant| contestant.errors.penumbra.map(|penumbra| penumbra.rmse),
        print: |value| significant(value, 3),
    },
    Column {
        head: "time",
        value: |contestant| Some(contestant.ratio.as_ref()?.whole()?.median),
        print: |value| format!("{}×", significant(value, 3)),
    },
];

pub(super) fn tables(report: &Report) -> Markup {
    let groups: Vec<&Group> = report.scenes().into_iter().filter_map(|scene| report.headline_of(scene)).collect();
    let families: Vec<&str> = report
        .families()
        .into_iter()
        .filter(|family| groups.iter().any(|group| group.standing_for(family).is_some()))
        .collect();
    html! {
        @if !families.is_empty() {
            p.lead {
                "RMSE of visibility over all receivers and inside the true penumbra (0 is the truth, 1 is all wrong), "
                "and time of the whole shadow work as a multiple of the plain shadow map's. The most exact variant "
                "stands for each family; the best of each column is " span.best { "marked" } "."
            }
            @let spans = vec![COLUMNS.len(); groups.len()];
            (boxed("Error and time by family and scene", &spans, head(&groups), body(&groups, &families)))
        }
    }
}

fn head(groups: &[&Group]) -> Markup {
    html! {
        tr {
            th rowspan="2" scope="col" { "Family" }
            @for group in groups {
                th.group colspan=(COLUMNS.len()) scope="colgroup" { (group.scene) " " small { (group.map_size) } }
            }
        }
        tr { @for _ in groups { @for column in &COLUMNS { th scope="col" { (column.head) } } } }
    }
}

fn body(groups: &[&Group], families: &[&str]) -> Markup {
    let best_of = |group: &Group, column: &Column| least(group.standing().filter_map(column.value), column.print);
    html! {
        @for family in families {
            tr {
                th scope="row" { (family) }
                @for group in groups {
                    @for column in &COLUMNS {
                        @let value = group.standing_for(family).and_then(column.value).map(column.print);
                        (number(value.clone(), value.is_some() && value == best_of(group, column)))
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::super::sample::{contestant, group, report};
    use super::*;

    /// Texts of the cells that are marked.
    fn marked(report: &Report) -> Vec<String> {
        let table = tables(report).into_string();
        let cells = table.split("<td class=\"best\">").skip(1);
        cells.filter_map(|cell| cell.split_once('<')).map(|(text, _)| text.to_owned()).collect()
    }

    #[test]
    fn the_best_of_each_column_is_marked() {
        let report = |smoothies_rmse| {
            report(vec![group(
                "square",
                1024,
                vec![
                    contestant("plain", "plain", "shadow-map", 0.11, 1.0),
                    contestant("smoothies", "smoothies", "smoothies", smoothies_rmse, 1.3),
                ],
            )])
        };
        // RMSE, that in the penumbra (the sample has twice as much) and time, by row.
        assert_eq!(marked(&report(0.14)), ["0.110", "0.220", "1.00×"]);
        assert_eq!(marked(&report(0.05)), ["1.00×", "0.0500", "0.100"]);
        // What is printed alike is marked alike.
        assert_eq!(marked(&report(0.110_01)), ["0.110", "0.220", "1.00×", "0.110", "0.220"]);
    }
}
