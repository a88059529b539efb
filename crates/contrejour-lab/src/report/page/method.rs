//! What the figures mean.

use maud::{Markup, html};

use super::super::number::{grouped, significant};
use super::super::{Errors, Report};
use crate::metrics::{FLIP_PIXELS_PER_DEGREE, NOT_UMBRA_FROM, UMBRA_UP_TO};

pub(super) fn text(report: &Report) -> Markup {
    let header = &report.header;
    let measured = |has: fn(&Errors) -> bool| {
        report.groups.iter().flat_map(|group| &group.contestants).any(|contestant| has(&contestant.errors))
    };
    html! {
        dl.method {
            dt { "Truth" }
            dd {
                "The share of the area light that a receiver point sees, ray-traced from the points that the "
                "rasteriser shades, with at most " (grouped(header.truth_samples_max)) " light samples a pixel"
                @if header.truth_target_error > 0.0 {
                    ", fewer where the standard error has fallen to " (significant(header.truth_target_error, 2))
                }
                "."
            }
            dt { "Receivers" }
            dd {
                "Compared are pixels of surfaces that receive shadow, lie in the light's maps and have the whole light "
                "above their plane. On the others truth and techniques mean different things: a technique sees one point "
                "of the light and calls a side that is averted from it dark, and what is outside of its maps lit."
            }
            dt { "RMSE, mean, 99 %" }
            dd {
                "Root mean square, mean and 99th percentile of the absolute difference of visibility (0 dark, 1 lit) "
                "between technique and truth, over all receiver pixels and over those in the penumbra. The penumbra is "
                "where the truth alone is more than 0 and less than 1 by more than its own standard error."
            }
            dt { "Umbra" }
            dd {
                "Too large: visibility is at most " (UMBRA_UP_TO) " in the technique and at least " (NOT_UMBRA_FROM)
                " in truth; too small: the reverse. As a share of the receiver pixels."
            }
            @if measured(|errors| errors.flip.is_some()) {
                dt { "FLIP" }
                dd {
                    "Mean FLIP (Andersson et al. 2020) of the shaded picture against the one shaded with the true "
                    "visibility, at " (significant(FLIP_PIXELS_PER_DEGREE.into(), 2)) " pixels a degree."
                }
            }
            @if measured(|errors| errors.motion.is_some()) {
                dt { "Motion" }
                dd {
                    "While the light moves slowly: how much a pixel's visibility changes from frame to frame beyond "
                    "what the truth does, " code { "max(0, |ΔV| − |ΔT|)" } "; mean, 99th percentile and largest over "
                    "pixels and steps."
                }
            }
            dt { "Time" }
            dd {
                "Median over frames after warm-up with 5th and 95th percentile. Contestants of one scene and map size "
                "take turns frame by frame, so that drift hits all alike. Device: timestamps around the whole shadow "
                "work. Wall-clock: from submission to completion. Record: CPU time to prepare and record. Where a "
                "device has no timestamps that cover all of its work, wall-clock stands in."
            }
            dt { "×" }
            dd {
                "Multiple of the plain shadow map in the same table. Its spread divides low by high and high by low: "
                "two runs on a machine that does nothing else agree within it."
            }
        }
    }
}
