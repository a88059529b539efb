//! Tables and figures of papers, redone.

use std::path::Path;

use maud::{Markup, PreEscaped, html};

use super::super::{Body, Figure, PictureGrid, PlotUse, Report, Table};
use super::table::boxed;
use super::{PageError, pictures};

pub(super) fn all(report: &Report, folder: &Path) -> Result<Markup, PageError> {
    let figures: Vec<Markup> =
        report.figures.iter().map(|figure| block(figure, folder)).collect::<Result<_, PageError>>()?;
    Ok(html! { @for figure in &figures { (figure) } })
}

fn block(figure: &Figure, folder: &Path) -> Result<Markup, PageError> {
    let body = match &figure.body {
        Body::Table(table) => self::table(table, &figure.title),
        Body::Pictures(grid) => picture_grid(grid, &figure.title, folder)?,
        Body::Plot(plot) => {
            let svg = plot
                .to_svg(&figure.title, PlotUse::Inline)
                .map_err(|error| PageError::Plot { title: figure.title.clone(), error })?;
            html! { div.one-plot { (PreEscaped(svg)) } }
        }
    };
    Ok(html! { figure.redone { h3 { (figure.title) } (body) figcaption { (figure.caption) } } })
}

fn table(table: &Table, title: &str) -> Markup {
    let head = html! { tr { @for column in &table.columns { th scope="col" { (column) } } } };
    let body = html! {
        @for row in &table.rows {
            tr {
                @for (number, cell) in row.iter().enumerate() {
                    @if number == 0 { th scope="row" { (cell) } } @else { td { (cell) } }
                }
            }
        }
    };
    boxed(title, &[], head, body)
}

fn picture_grid(grid: &PictureGrid, title: &str, folder: &Path) -> Result<Markup, PageError> {
    let head = html! { tr { td {} @for column in &grid.columns { th scope="col" { (column) } } } };
    let mut rows = Vec::new();
    for row in &grid.rows {
        let mut cells = Vec::new();
        for cell in &row.cells {
            cells.push(match cell {
                Some(picture) => Some(pictures::image(folder, &picture.path, &picture.alt)?),
                None => None,
            });
        }
        rows.push(html! {
            tr {
                th scope="row" { (row.label) }
                @for cell in cells { td { @if let Some(cell) = cell { (cell) } } }
            }
        });
    }
    let columns = format!("--columns: {}", grid.columns.len());
    Ok(html! { div.grid style=(columns) { (boxed(title, &[], head, html! { @for row in &rows { (row) } })) } })
}
