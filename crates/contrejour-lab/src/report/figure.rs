//! Generic blocks of the page: a table, a plot or a grid of pictures, with title and caption.

use serde::{Deserialize, Serialize};

/// A block of the page.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figure {
    /// What it shows, in a few words.
    pub title: String,
    /// How to read it, whom it redoes, and what came out.
    pub caption: String,
    /// What is shown.
    pub body: Body,
}

/// What a figure shows.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Body {
    /// Rows and columns of text.
    Table(Table),
    /// Series of points over two axes.
    Plot(Plot),
    /// Rows and columns of pictures.
    Pictures(PictureGrid),
}

/// Rows and columns of text. The first column names its row.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Table {
    /// Heads of the columns.
    pub columns: Vec<String>,
    /// Cells of each row. A short row leaves its last columns empty.
    pub rows: Vec<Vec<String>>,
}

/// Series of points over two axes.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Plot {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// What is drawn, in the order of the legend.
    pub series: Vec<Series>,
}

/// An axis of a plot.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Axis {
    /// What it measures, with its unit.
    pub label: String,
    /// How values are spread along it.
    pub scale: Scale,
}

/// How values are spread along an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Scale {
    /// Evenly, from 0.
    Linear,
    /// By their logarithm; all values are more than 0.
    Log,
}

/// Points that belong together.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Its name in the legend.
    pub label: String,
    /// x and y of each point.
    pub points: Vec<[f64; 2]>,
    /// How the points are joined.
    pub stroke: Stroke,
}

/// How the points of a series are drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Stroke {
    /// Marks joined by a line: what was measured.
    Line,
    /// Marks alone: what was measured, in no order.
    Marks,
    /// A dashed line without marks in the colour of the series before it: its model or fit.
    Dashed,
    /// Large rings joined by a dashed line: points of other series that stand out, as a Pareto front.
    Ringed,
}

/// Rows and columns of pictures.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct PictureGrid {
    /// Heads of the columns.
    pub columns: Vec<String>,
    /// The rows.
    pub rows: Vec<GridRow>,
}

/// A row of pictures.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct GridRow {
    /// Names the row.
    pub label: String,
    /// A picture a column; none leaves the place empty.
    pub cells: Vec<Option<Picture>>,
}

/// A picture file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Picture {
    /// Path from the report's folder to a PNG file, with `/`.
    pub path: String,
    /// What it shows, for readers who can't see it.
    pub alt: String,
}
