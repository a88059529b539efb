//! Drawing of one plot.

use plotters::coord::Shift;
use plotters::element::DashedPathElement;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::super::figure::{Plot, Series, Stroke};
use super::axis::Ticks;
use super::mark::Mark;
use super::{PlotError, PlotUse};

/// Units of the drawing for a pixel. plotters draws on whole units; smaller ones keep slopes smooth.
const UNIT: i32 = 8;
/// Width of the drawing in pixels: about that of a phone, so that text stays legible there.
const WIDTH: i32 = 440;
/// Height of the chart without legend in pixels.
const CHART_HEIGHT: i32 = 300;
/// Height of a line of the legend in pixels.
const LEGEND_LINE: i32 = 19;
/// Room in the legend for a sample and the gap after a label in pixels.
const LEGEND_SAMPLE: i32 = 46;
/// Size of all text in pixels.
const TEXT: i32 = 13;

/// plotters' sizes are 1.24 times those that it writes.
const TEXT_FOR_PLOTTERS: i32 = TEXT * UNIT * 124 / 100;

type Root<'a> = DrawingArea<SVGBackend<'a>, Shift>;

pub(super) fn draw(plot: &Plot, x: Ticks, y: Ticks, title: &str, plot_use: PlotUse) -> Result<String, PlotError> {
    let legend = Legend::of(&plot.series);
    let height = CHART_HEIGHT + (legend.lines + 1) * LEGEND_LINE;
    let mut svg = String::new();
    let root = SVGBackend::with_string(&mut svg, ((WIDTH * UNIT) as u32, (height * UNIT) as u32)).into_drawing_area();
    draw_all(&root, plot, x, y, &legend).map_err(|error| PlotError::Draw(error.to_string()))?;
    drop(root);
    Ok(finish(&svg, title, height, plot_use))
}

fn draw_all(root: &Root, plot: &Plot, x: Ticks, y: Ticks, legend: &Legend) -> Result<(), DrawingError> {
    let (chart_area, legend_area) = root.split_vertically(CHART_HEIGHT * UNIT);
    let text = TextStyle::from(("sans-serif", TEXT_FOR_PLOTTERS)).color(&BLACK);
    let mut chart = ChartBuilder::on(&chart_area)
        .margin_right(16 * UNIT)
        // The name of the vertical axis stands above it, where it need not be turned.
        .margin_top(26 * UNIT)
        .x_label_area_size(44 * UNIT)
        .y_label_area_size(48 * UNIT)
        .build_cartesian_2d(x, y)?;
    chart
        .configure_mesh()
        .light_line_style(TRANSPARENT)
        .bold_line_style(BLACK.mix(0.14).stroke_width(UNIT as u32))
        .axis_style(BLACK.mix(0.5).stroke_width(UNIT as u32))
        .set_all_tick_mark_size(4 * UNIT)
        .label_style(text.clone())
        .axis_desc_style(text.clone())
        .x_desc(plot.x.label.as_str())
        .draw()?;
    let named = text.clone().pos(Pos::new(HPos::Left, VPos::Center));
    chart_area.draw(&Text::new(plot.y.label.clone(), (4 * UNIT, 11 * UNIT), named.clone()))?;

    let marks = marks(&plot.series);
    for (series, mark) in plot.series.iter().zip(&marks) {
        let points: Vec<_> = series.points.iter().map(|&[x, y]| chart.backend_coord(&(x, y))).collect();
        draw_series(&chart_area, &points, series.stroke, mark)?;
    }
    for (number, (series, mark)) in plot.series.iter().zip(&marks).enumerate() {
        let (x, y) = legend.place(number);
        let ends = [(x - 9 * UNIT, y), (x + 9 * UNIT, y)];
        let points: &[_] = if matches!(series.stroke, Stroke::Dashed | Stroke::Line) { &ends } else { &[(x, y)] };
        match series.stroke {
            // One mark in the middle of the sample's line.
            Stroke::Line => {
                legend_area.draw(&PathElement::new(points, line(mark.colour.into())))?;
                legend_area.draw(&mark.at((x, y), 4 * UNIT))?;
            }
            stroke => draw_series(&legend_area, points, stroke, mark)?,
        }
        legend_area.draw(&Text::new(series.label.clone(), (x + 15 * UNIT, y), named.clone()))?;
    }
    root.present()
}

/// A mark for each series. A fit takes that of the series before it.
fn marks(series: &[Series]) -> Vec<Mark> {
    let mut own = 0;
    let number = |series: &Series| {
        own += usize::from(series.stroke != Stroke::Dashed);
        usize::saturating_sub(own, 1)
    };
    series.iter().map(number).map(Mark::of).collect()
}

fn draw_series(area: &Root, points: &[(i32, i32)], stroke: Stroke, mark: &Mark) -> Result<(), DrawingError> {
    match stroke {
        Stroke::Line => {
            area.draw(&PathElement::new(points, line(mark.colour.into())))?;
            points.iter().try_for_each(|&point| area.draw(&mark.at(point, 4 * UNIT)))
        }
        Stroke::Marks => points.iter().try_for_each(|&point| area.draw(&mark.at(point, 4 * UNIT))),
        Stroke::Dashed => dashes(area, points, mark.colour.into()),
        Stroke::Ringed => {
            let ink = BLACK.mix(0.75);
            dashes(area, points, ink)?;
            points.iter().try_for_each(|&point| area.draw(&Circle::new(point, 8 * UNIT, line(ink))))
        }
    }
}

fn dashes(area: &Root, points: &[(i32, i32)], colour: RGBAColor) -> Result<(), DrawingError> {
    area.draw(&DashedPathElement::new(points.iter().copied(), 6 * UNIT, 4 * UNIT, line(colour)))
}

fn line(colour: RGBAColor) -> ShapeStyle {
    colour.stroke_width((UNIT * 3 / 2) as u32)
}

type DrawingError = DrawingAreaErrorKind<<SVGBackend<'static> as DrawingBackend>::ErrorType>;

/// Where the legend's entries stand: one after the other, in as many lines as that takes.
struct Legend {
    /// Left end of each entry in pixels, and its line.
    places: Vec<(i32, i32)>,
    lines: i32,
}

impl Legend {
    fn of(series: &[Series]) -> Self {
        let (mut x, mut line) = (0, 0);
        let places = series.iter().map(|series| {
            // Letters are about 0.58 times as wide as the text is high; SVG does not tell.
            let width = LEGEND_SAMPLE + series.label.chars().count() as i32 * TEXT * 58 / 100;
            if x > 0 && x + width > WIDTH {
                (x, line) = (0, line + 1);
            }
            let place = (x, line);
            x += width;
            place
        });
        let places = places.collect();
        Self { places, lines: line + 1 }
    }

    /// Middle of an entry's sample.
    fn place(&self, number: usize) -> (i32, i32) {
        let (x, line) = self.places[number];
        ((x + 14) * UNIT, (line * LEGEND_LINE + LEGEND_LINE) * UNIT)
    }
}

/// Gives plotters' drawing a title, a size that suits its use, and the colour of the text around for black.
fn finish(drawing: &str, title: &str, height: i32, plot_use: PlotUse) -> String {
    let inner = drawing.split_once('>').map_or("", |(_, inner)| inner).replace("\"#000000\"", "\"currentColor\"");
    let [units_across, units_down] = [WIDTH * UNIT, height * UNIT];
    let title = title.replace('&', "&amp;").replace('<', "&lt;");
    let (size, style) = match plot_use {
        PlotUse::Inline => (String::new(), ""),
        PlotUse::File => (
            format!(r#"width="{WIDTH}" height="{height}" "#),
            // With a ground of its own: what is behind a lone file need not be as dark as its reader's system.
            "<style>\n\
             svg { color: #1b1d21; background: #fbfaf7 }\n\
             @media (prefers-color-scheme: dark) { svg { color: #e6e4df; background: #15161a } }\n\
             </style>\n",
        ),
    };
    let inner = inner.trim_start();
    format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" class="plot" role="img"
{size}viewBox="0 0 {units_across} {units_down}">
<title>{title}</title>
{style}{inner}"#
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fit_has_the_colour_of_its_series() {
        let series = [Stroke::Marks, Stroke::Dashed, Stroke::Line, Stroke::Dashed, Stroke::Line].map(|stroke| Series {
            label: String::new(),
            points: Vec::new(),
            stroke,
        });
        assert_eq!(marks(&series), [0, 0, 1, 1, 2].map(Mark::of));
        // A model without a series before it has the first.
        assert_eq!(marks(&series[1..2]), [Mark::of(0)]);
    }
}
