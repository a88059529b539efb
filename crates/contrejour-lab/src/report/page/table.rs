//! Cells that several tables share.

use maud::{Markup, html};

use super::super::number::significant;
use crate::metrics::{Ratio, Timing};

/// A table in a box of its own, in which it scrolls where it is wider than the window. `groups` are the numbers of
/// columns that lines part from those before; columns beyond them are one more group.
pub(crate) fn boxed(caption: &str, groups: &[usize], head: Markup, body: Markup) -> Markup {
    html! {
        // Focusable, so that the box scrolls by keyboard too.
        div.scroll tabindex="0" role="region" aria-label=(caption) {
            table {
                caption { (caption) }
                @if !groups.is_empty() { col; }
                @for span in groups { colgroup span=(span) {} }
                thead { (head) }
                tbody { (body) }
            }
        }
    }
}

/// A cell with a number, marked where it is the best of its column.
pub(crate) fn number(text: Option<String>, is_best: bool) -> Markup {
    html! {
        @match (text, is_best) {
            (Some(text), true) => td.best { (text) },
            (Some(text), false) => td { (text) },
            (None, _) => td.none { "–" },
        }
    }
}

/// A time with its spread, in milliseconds.
pub(super) fn timing(timing: &Timing) -> Markup {
    html! {
        (significant(timing.median_ms, 3))
        " " span.spread { (significant(timing.low_ms, 3)) "–" (significant(timing.high_ms, 3)) }
    }
}

/// A ratio with its spread.
pub(super) fn ratio(ratio: Option<Ratio>) -> Markup {
    html! {
        @if let Some(ratio) = ratio {
            (significant(ratio.median, 3)) "×"
            " " span.spread { (significant(ratio.low, 3)) "–" (significant(ratio.high, 3)) }
        } @else {
            "–"
        }
    }
}

/// The least of some values as it is printed, so that equal prints are marked alike.
pub(super) fn least(values: impl Iterator<Item = f64>, print: impl Fn(f64) -> String) -> Option<String> {
    values.min_by(f64::total_cmp).map(print)
}
