//! Silhouette maps where their edges are hard to find and to draw.

use contrejour_plan::{SilhouetteMapSettings, Technique};

use super::super::case::Case;
use super::super::effort::Effort;
use super::super::family::Family;
use super::{contact, counts, projections, shapes};
use crate::report::Scale;

pub(super) const SILHOUETTE_MAPS: Family = Family {
    name: "silhouette-maps",
    stresses: "Slivers, edges that project to a point, faces seen edge-on, faces of a texel and a plate that sinks onto a \
               floor, in silhouette maps of all sources: each place where a blocker ends, before nothing or before \
               another, must know its silhouette.",
    parameter: "the case's number",
    scale: Scale::Linear,
    cases,
};

/// Whose cases are tried.
const FAMILIES: [Family; 5] =
    [shapes::SLIVERS, projections::POINT_EDGES, counts::EDGE_ON, counts::TEXEL_FACES, contact::CONTACT];

fn cases(effort: &Effort) -> Vec<Case> {
    let sources = [
        ("stages", SilhouetteMapSettings::DEFAULT),
        ("vertex stage", SilhouetteMapSettings::TAM),
        ("stream", SilhouetteMapSettings::STREAM),
    ];
    let of_source = |(source, settings): (&str, SilhouetteMapSettings)| -> Vec<Case> {
        let of_family = |family: &Family| {
            let name = family.name;
            (family.cases)(effort).into_iter().map(move |mut case| {
                case.parameter = format!("{name} {}, {source}", case.parameter);
                case.settings.technique = Technique::SilhouetteMap(settings);
                case.gap_search = None;
                case
            })
        };
        FAMILIES.iter().flat_map(of_family).collect()
    };
    let mut cases: Vec<Case> = sources.into_iter().flat_map(of_source).collect();
    cases.iter_mut().enumerate().for_each(|(number, case)| case.at = number as f64);
    cases
}
