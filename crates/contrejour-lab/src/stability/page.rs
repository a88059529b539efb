//! The results as one HTML page that needs no network, no script and no other file.

use maud::{Markup, PreEscaped, html};

use super::findings::Findings;
use super::row::{COLUMNS, Row};
use super::run::{FamilyRows, Stability};
use crate::report::{
    Axis, Extent, PageError, Plot, PlotUse, Scale, Section, Series, Stroke, boxed, document, grouped, number,
    significant,
};

const TITLE: &str = "Extreme cases of silhouettes and smoothies";

impl Stability {
    /// The results as a page.
    ///
    /// # Errors
    ///
    /// A plot with values that have no place.
    pub fn to_page(&self) -> Result<String, PageError> {
        let sections = [
            Section { id: "findings", title: "What came out", body: findings(self) },
            Section { id: "time", title: "Error against run time", body: error_against_time(self)? },
            Section { id: "families", title: "The families", body: families(self)? },
            Section { id: "columns", title: "What the columns say", body: columns() },
        ];
        Ok(document(TITLE, &head(self), &sections, &foot(self)))
    }
}

fn head(found: &Stability) -> Markup {
    let header = &found.header;
    let extent = match header.extent {
        Extent::Quick => "quick: ends and middle of each sweep",
        Extent::Full => "full",
    };
    html! {
        header {
            p.kicker { "contrejour " (header.version) }
            h1 { (TITLE) }
            p.lead {
                "Each case goes through the whole pipeline on the device and through the CPU twins of its stages, and is "
                "held against exact arithmetic and against the definitions, until it breaks by definition or the type "
                "ends."
            }
            dl.facts {
                div { dt { "Command" } dd { code { (header.command) } } }
                div {
                    dt { "Device" }
                    dd {
                        (header.device)
                        @if header.is_software { " " strong.warning { "software device: its times are not a GPU's" } }
                    }
                }
                div { dt { "Extent" } dd { (extent) ", seed " (header.seed) } }
            }
        }
    }
}

fn findings(found: &Stability) -> Markup {
    let sums = found.findings();
    let Findings { families, rows, faces_tested, sign_errors_f32, degraded, .. } = sums;
    let faults = found.faults();
    html! {
        p.summary {
            (rows) " cases of " (families) " families, " (grouped(faces_tested)) " signs of faces: "
            (sums.sign_errors) " sign errors, " (sums.open_cycles) " open cycles, " (sums.gaps) " gaps, "
            (sums.non_finite) " numbers that are not finite, " (sums.surprises) " errors or refusals without a reason. A bare test in 32-bit floats has "
            (grouped(sign_errors_f32)) " signs wrong in the same cases."
        }
        @if !faults.is_empty() {
            p { strong.warning { (faults.len()) " cases have a fault:" } }
            ul { @for fault in &faults { li { (fault) } } }
        }
        @if degraded > 0 {
            p {
                "In " (degraded) " cases the definition itself does not hold or the library refuses, in words: the number "
                "in the last column of the tables is that of the reason in the list above it."
            }
        }
    }
}

/// Share of wrong signs over the time to find the lit faces, for both tests.
fn error_against_time(found: &Stability) -> Result<Markup, PageError> {
    let share =
        |row: &Row, wrong: Option<u64>| Some(wrong? as f64 / row.faces_tested.filter(|faces| *faces > 0)? as f64);
    let bare = found.rows().filter_map(|row| Some([row.facing?.bare_ns, share(row, row.sign_errors_f32)?]));
    let exact = found.rows().filter_map(|row| Some([row.facing?.exact_ns, share(row, row.sign_errors)?]));
    let plot = Plot {
        x: axis("time to find the lit faces, ns a face", Scale::Log),
        y: axis("share of faces with a wrong sign", Scale::Linear),
        series: vec![marks("bare float test", bare.collect()), marks("exact test", exact.collect())],
    };
    let drawn = drawn(&plot, "Error against run time")?;
    Ok(html! {
        @if let Some(svg) = drawn {
            p.lead {
                "A mark a case and test. Both tests find the lit faces of the same case on one core, taking turns: the "
                "bare test as one determinant in 32-bit floats, the exact one as the twins of its four tiers, which "
                "costs more the more faces floats leave undecided. Small meshes have a fixed cost a frame on top."
            }
            div.one-plot { (PreEscaped(svg)) }
        }
    })
}

fn families(found: &Stability) -> Result<Markup, PageError> {
    let blocks = found.families.iter().map(family).collect::<Result<Vec<_>, _>>()?;
    Ok(html! { @for block in &blocks { (block) } })
}

fn family(family: &FamilyRows) -> Result<Markup, PageError> {
    let mut plots = Vec::new();
    for (title, plot) in family_plots(family) {
        if let Some(svg) = drawn(&plot, &format!("{}: {title}", family.name))? {
            plots.push((title, svg));
        }
    }
    // The family is the table's.
    let head = html! { tr { @for column in &COLUMNS[1..] { th scope="col" { code { (column.replace('_', "_\u{200b}")) } } } } };
    let reasons = Reasons::of(family);
    let body = html! { @for row in &family.rows { (table_row(row, &reasons)) } };
    Ok(html! {
        figure.redone {
            h3 { (family.name) }
            p { (family.stresses) " Varied: " (family.varies) "." }
            @if !plots.is_empty() {
                div.plots {
                    @for (title, svg) in &plots { figure { figcaption { strong { (title) } } (PreEscaped(svg)) } }
                }
            }
            (reasons.told())
            (pictures(family, &reasons))
            (boxed(family.name, &[], head, body))
        }
    })
}

/// The distinct reasons of a family's rows: told once, in a list whose numbers stand in pictures' captions and the table.
struct Reasons<'a>(Vec<&'a str>);

impl<'a> Reasons<'a> {
    fn of(family: &'a FamilyRows) -> Self {
        let mut reasons = Vec::new();
        for row in &family.rows {
            if !row.degrades.is_empty() && !reasons.contains(&row.degrades.as_str()) {
                reasons.push(row.degrades.as_str());
            }
        }
        Self(reasons)
    }

    /// The number of a row's reason in the list; empty where it has none.
    fn mark(&self, row: &Row) -> String {
        let index = self.0.iter().position(|reason| *reason == row.degrades);
        index.map_or_else(String::new, |index| format!("({})", index + 1))
    }

    fn told(&self) -> Markup {
        html! {
            @if !self.0.is_empty() {
                p.lead { "Where the definition does not hold, or the library refuses:" }
                ol { @for reason in &self.0 { li { (reason) } } }
            }
        }
    }
}

/// What is seen of each case that is looked at.
fn pictures(family: &FamilyRows, reasons: &Reasons) -> Markup {
    let seen: Vec<_> = family.rows.iter().filter_map(|row| Some((row, row.pictures.as_ref()?))).collect();
    html! {
        @if !seen.is_empty() {
            p.lead { "How visible the light is: above in truth, below by the technique." }
            div.strip {
                @for (row, pictures) in seen {
                    figure {
                        @for (address, whose) in pictures.iter().zip(["in truth", "by the technique"]) {
                            img src=(address) alt={ "Visibility " (whose) ", " (family.name) " at " (row.parameter) } loading="lazy";
                        }
                        figcaption { strong { (row.parameter) } " " (reasons.mark(row)) }
                    }
                }
            }
        }
    }
}

fn family_plots(family: &FamilyRows) -> [(&'static str, Plot); 3] {
    let points = |value: &dyn Fn(&Row) -> Option<f64>| -> Vec<[f64; 2]> {
        let rows = family.rows.iter().filter(|row| family.scale == Scale::Linear || row.at > 0.0);
        rows.filter_map(|row| Some([row.at, value(row)?])).collect()
    };
    let share =
        |row: &Row, wrong: Option<u64>| Some(wrong? as f64 / row.faces_tested.filter(|faces| *faces > 0)? as f64);
    let plot =
        |label: &str, scale, series| Plot { x: axis(family.varies, family.scale), y: axis(label, scale), series };
    let signs = vec![
        marks("bare float test", points(&|row| share(row, row.sign_errors_f32))),
        marks("ours", points(&|row| share(row, row.sign_errors))),
    ];
    // What is exact has no place on a logarithmic axis.
    let widths = marks("width", points(&|row| row.width_error.filter(|error| *error > 0.0 && error.is_finite())));
    let visibilities = marks("visibility, RMSE", points(&|row| row.visibility_error.filter(|error| *error > 0.0)));
    let errors = [widths, visibilities].into_iter().filter(|series| !series.points.is_empty()).collect();
    [
        ("Wrong signs", plot("share of faces", Scale::Linear, signs)),
        ("Errors of what is drawn", plot("error", Scale::Log, errors)),
        ("Time", plot("time of a frame, ms", Scale::Linear, vec![marks("frame", points(&|row| row.time_ms))])),
    ]
}

fn table_row(row: &Row, reasons: &Reasons) -> Markup {
    let count = |count: Option<u64>| number(count.map(grouped), false);
    let fault = |count: Option<u64>| {
        html! {
            @match count {
                Some(faults) if faults > 0 => td { strong.warning { (grouped(faults)) } },
                _ => (number(count.map(grouped), false)),
            }
        }
    };
    let small = |value: Option<f64>| number(value.map(exponent), false);
    html! {
        tr {
            th scope="row" { (row.parameter) }
            (count(row.faces_tested))
            (count(row.sign_errors_f32))
            (fault(row.sign_errors))
            (fault(row.open_cycles))
            (fault(row.gaps))
            (fault(row.non_finite))
            (small(row.width_error))
            (small(row.visibility_error))
            (number(row.time_ms.map(|time| significant(time, 3)), false))
            td { (reasons.mark(row)) }
        }
    }
}

/// Two digits; with an exponent where many zeros would come first.
fn exponent(value: f64) -> String {
    if value == 0.0 || (1e-3..1e3).contains(&value.abs()) { significant(value, 2) } else { format!("{value:.1e}") }
}

fn columns() -> Markup {
    let told = [
        ("faces_tested", "faces whose sign was compared with exact arithmetic"),
        ("sign_errors_f32", "signs that a bare determinant in 32-bit floats has wrong"),
        (
            "sign_errors",
            "signs that the device or its twin has wrong, and silhouette edges that either lost, invented or gave other \
             faces (compared up to 50 000 faces a mesh)",
        ),
        ("open_cycles", "vertices at which the silhouette of the device or of its twin is no cycle"),
        (
            "gaps",
            "outline edges in view without a quad, and points of the image plane beside outline vertices that neither a \
             blocker nor a smoothie covers; of the device or of its twin, whichever has more. Points are not looked for \
             where a definition leaves some, around plates in a stack, and around ten million faces",
        ),
        (
            "non_finite",
            "infinities and NaNs in all floats of quads, corners, planes, light records and every texel of every map, in the \
             twin's quads and corners, and in visibility and shaded picture of what is looked at",
        ),
        ("width_error", "largest difference of a smoothie's width at an end or corner from t(b), as a share of t(b)"),
        (
            "visibility_error",
            "root of the mean squared difference from the ray-traced visibility, over the points of the picture that lie in \
             the light's maps and have the whole light above their plane",
        ),
        ("time_ms", "from submission of a whole frame to its completion, median of three, in milliseconds"),
        ("degrades", "why the definition does not hold here, or what the library refuses"),
    ];
    html! {
        p.lead { "A dash: the family has no such figure, or the frame left nothing to look at." }
        dl.method { @for (column, meaning) in told { dt { code { (column) } } dd { (meaning) "." } } }
    }
}

fn foot(found: &Stability) -> Markup {
    html! {
        footer {
            p {
                "The table of this page stands in " code { "stability.csv" } " and " code { "stability.json" }
                " beside it. Make it again with " code { (found.header.command) } "."
            }
        }
    }
}

/// The plot; none where it has no point.
fn drawn(plot: &Plot, title: &str) -> Result<Option<String>, PageError> {
    if plot.series.iter().all(|series| series.points.is_empty()) {
        return Ok(None);
    }
    let svg = plot.to_svg(title, PlotUse::Inline);
    svg.map(Some).map_err(|error| PageError::Plot { title: title.to_owned(), error })
}

fn axis(label: &str, scale: Scale) -> Axis {
    Axis { label: label.to_owned(), scale }
}

fn marks(label: &str, points: Vec<[f64; 2]>) -> Series {
    Series { label: label.to_owned(), points, stroke: Stroke::Marks }
}
