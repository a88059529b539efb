//! Plots as SVG on a transparent ground: text, axes and grid in the colour of the text around, series in middle tones
//! that can be read on white and on black.

mod axis;
mod draw;
mod mark;

use super::figure::{Axis, Plot, Scale};
use axis::Ticks;

/// Why a plot can't be drawn.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlotError {
    /// No series has a point.
    #[error("the plot of {y} over {x} has no point; leave it out")]
    Empty {
        /// The label of the horizontal axis.
        x: String,
        /// The label of the vertical axis.
        y: String,
    },
    /// A value that has no place on its axis.
    #[error("{value} of series \"{series}\" has no place on the axis \"{axis}\"; {remedy}")]
    OffScale {
        /// The label of the series.
        series: String,
        /// The label of the axis.
        axis: String,
        /// The value.
        value: f64,
        /// What the axis takes.
        remedy: &'static str,
    },
    /// The drawing library refuses.
    #[error("the plot can't be drawn: {0}")]
    Draw(String),
}

/// A way to put a plot somewhere.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PlotUse {
    /// In a page: as wide as its box, on its ground and in its text colour.
    Inline,
    /// A file of its own: of a fixed size, on a ground that is light or dark as the reader's system wants.
    File,
}

impl Plot {
    /// The plot as SVG. `title` names it for readers who can't see it.
    ///
    /// # Errors
    ///
    /// No point at all, a value that is no number, or one that is not more than 0 on a logarithmic axis (less than 0 on
    /// a linear one).
    pub fn to_svg(&self, title: &str, plot_use: PlotUse) -> Result<String, PlotError> {
        let [x, y] = [self.ticks(&self.x, 0)?, self.ticks(&self.y, 1)?];
        draw::draw(self, x, y, title, plot_use)
    }

    /// Where an axis starts and ends, and its ticks. `coordinate` is 0 for x and 1 for y.
    fn ticks(&self, axis: &Axis, coordinate: usize) -> Result<Ticks, PlotError> {
        for series in &self.series {
            for value in series.points.iter().map(|point| point[coordinate]) {
                let remedy = match axis.scale {
                    Scale::Log if !(value.is_finite() && value > 0.0) => "a logarithmic axis takes what is more than 0",
                    Scale::Linear if !(value.is_finite() && value >= 0.0) => "a linear axis starts from 0",
                    _ => continue,
                };
                return Err(PlotError::OffScale {
                    series: series.label.clone(),
                    axis: axis.label.clone(),
                    value,
                    remedy,
                });
            }
        }
        let values = self.series.iter().flat_map(|series| &series.points).map(|point| point[coordinate]);
        Ticks::around(values, axis.scale)
            .ok_or_else(|| PlotError::Empty { x: self.x.label.clone(), y: self.y.label.clone() })
    }
}

#[cfg(test)]
mod tests {
    use super::super::figure::{Series, Stroke};
    use super::*;

    fn plot(scale: Scale, points: Vec<[f64; 2]>) -> Plot {
        let axis = |label: &str| Axis { label: label.into(), scale };
        let series = Series { label: "a < b & c".into(), points, stroke: Stroke::Line };
        Plot { x: axis("time in ms"), y: axis("RMSE"), series: vec![series] }
    }

    #[test]
    fn a_plot_shows_labels_legend_and_points() {
        let points = vec![[1.0, 0.2], [2.0, 0.1], [4.0, 0.05]];
        let svg = plot(Scale::Log, points.clone()).to_svg("Error & time", PlotUse::Inline).expect("it can be drawn");
        for part in ["time in ms", "RMSE", "a &lt; b &amp; c", "<title>Error &amp; time</title>", "currentColor"] {
            assert!(svg.contains(part), "{part} is missing in {svg}");
        }
        // One mark a point and one in the legend.
        assert_eq!(svg.matches("<circle").count(), 4);
        let fewer = plot(Scale::Log, points[1..].to_vec()).to_svg("", PlotUse::Inline).expect("it can be drawn");
        assert_eq!(fewer.matches("<circle").count(), 3);
        assert!(!svg.contains("#000000") && !svg.contains("<style"));
    }

    #[test]
    fn a_file_has_its_own_colours_and_size() {
        let svg = plot(Scale::Linear, vec![[0.0, 1.0]]).to_svg("", PlotUse::File).expect("it can be drawn");
        assert!(svg.contains("prefers-color-scheme") && svg.contains("width=\"440\""));
    }

    #[test]
    fn what_has_no_place_is_refused() {
        let refused = |scale, points| plot(scale, points).to_svg("", PlotUse::Inline).expect_err("it has no place");
        assert!(matches!(refused(Scale::Log, vec![[1.0, 0.0]]), PlotError::OffScale { value: 0.0, .. }));
        assert!(matches!(refused(Scale::Linear, vec![[-1.0, 0.0]]), PlotError::OffScale { value: -1.0, .. }));
        assert!(matches!(refused(Scale::Linear, vec![[1.0, f64::NAN]]), PlotError::OffScale { .. }));
        assert!(matches!(refused(Scale::Linear, Vec::new()), PlotError::Empty { .. }));
    }
}
