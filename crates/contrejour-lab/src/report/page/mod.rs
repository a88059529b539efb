//! The report as one HTML page that needs no network, no script and no other file.

mod figures;
mod frame;
mod headline;
mod method;
mod pictures;
mod stages;
mod sweeps;
mod table;

use std::path::Path;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::embed::EmbedError;
use super::{PlotError, PlotUse, Report};
pub(crate) use table::{boxed, number};

const STYLE: &str = include_str!("style.css");

/// Why there is no page.
#[derive(Debug, thiserror::Error)]
pub enum PageError {
    /// A picture is missing or broken.
    #[error(transparent)]
    Picture(#[from] EmbedError),
    /// A plot can't be drawn.
    #[error("\"{title}\": {error}")]
    Plot {
        /// Title of the figure.
        title: String,
        /// What is wrong.
        error: PlotError,
    },
}

/// A part of a page that the list at its top leads to.
pub(crate) struct Section {
    pub id: &'static str,
    pub title: &'static str,
    pub body: Markup,
}

/// A page with its head, the sections that have something to say and its foot.
pub(crate) fn document(title: &str, head: &Markup, sections: &[Section], foot: &Markup) -> String {
    // Nothing is listed that was not measured.
    let sections: Vec<&Section> = sections.iter().filter(|section| !section.body.0.is_empty()).collect();
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { (title) }
                style { (PreEscaped(STYLE)) }
            }
            body {
                (head)
                nav aria-label="Parts of the report" {
                    ul { @for section in &sections { li { a href={ "#" (section.id) } { (section.title) } } } }
                }
                main {
                    @for section in &sections {
                        section id=(section.id) { h2 { (section.title) } (section.body) }
                    }
                }
                (foot)
            }
        }
    };
    page.into_string()
}

impl Report {
    /// The report as a page. Pictures are read from `folder` and stand in the page itself.
    ///
    /// # Errors
    ///
    /// A picture that can't be read, or a plot with values that have no place.
    pub fn to_page(&self, folder: &Path) -> Result<String, PageError> {
        let sections = [
            Section { id: "findings", title: "What came out", body: frame::findings(self) },
            Section { id: "glance", title: "At a glance", body: headline::tables(self) },
            Section { id: "time", title: "Error against time", body: error_plots(self)? },
            Section { id: "pictures", title: "Pictures", body: pictures::strips(self, folder)? },
            Section { id: "stages", title: "Where the time goes", body: stages::tables(self) },
            Section { id: "sweeps", title: "Every variant", body: sweeps::tables(self) },
            Section {
                id: "papers",
                title: "The papers' tables and figures, redone",
                body: figures::all(self, folder)?,
            },
            Section { id: "method", title: "How it was measured", body: method::text(self) },
        ];
        Ok(document(frame::TITLE, &frame::head(self), &sections, &frame::foot(self)))
    }
}

/// RMSE against time, a plot a scene.
fn error_plots(report: &Report) -> Result<Markup, PageError> {
    let mut plots = Vec::new();
    for scene in report.scenes() {
        if let Some(plot) = report.error_plot(scene) {
            let title = format!("Error against time: {scene}");
            let svg = plot.to_svg(&title, PlotUse::Inline).map_err(|error| PageError::Plot { title, error })?;
            plots.push((scene, svg));
        }
    }
    Ok(html! {
        @if !plots.is_empty() {
            p.lead {
                "Down and left is better. Each line is a family's most exact variant over the map sizes; rings mark "
                "the Pareto front: no other point of the plot is both faster and more exact."
            }
            div.plots {
                @for (scene, svg) in &plots { figure { figcaption { strong { (scene) } } (PreEscaped(svg)) } }
            }
        }
    })
}

#[cfg(test)]
mod tests {
    use super::super::sample::{contestant, group, report};
    use super::*;

    #[test]
    fn what_was_not_measured_has_no_section() {
        let mut plain = contestant("plain", "plain", "shadow-map", 0.11, 1.0);
        plain.errors.flip = None;
        let sections = |report: &Report| -> (Vec<&str>, bool) {
            let page = report.to_page(Path::new("nowhere")).expect("no picture is needed");
            let ids = ["findings", "glance", "time", "pictures", "stages", "sweeps", "papers", "method"];
            let here =
                |id: &&str| page.contains(&format!("href=\"#{id}\"")) && page.contains(&format!("section id=\"{id}\""));
            (ids.into_iter().filter(here).collect(), page.contains("<dt>FLIP"))
        };
        let without_pictures = report(vec![group("square", 1024, vec![plain.clone()])]);
        assert_eq!(
            sections(&without_pictures),
            (vec!["findings", "glance", "time", "stages", "sweeps", "method"], false)
        );
        plain.cost.stages.clear();
        plain.errors.flip = Some(0.1);
        let without_stages = report(vec![group("square", 1024, vec![plain])]);
        assert_eq!(sections(&without_stages), (vec!["findings", "glance", "time", "sweeps", "method"], true));
        assert_eq!(sections(&report(Vec::new())), (vec!["method"], false));
    }

    #[test]
    fn a_missing_picture_is_an_error() {
        let mut report = report(vec![group("square", 1024, Vec::new())]);
        report.groups[0].truth_picture = Some("none.png".into());
        assert!(matches!(report.to_page(Path::new("nowhere")), Err(PageError::Picture(_))));
    }
}
