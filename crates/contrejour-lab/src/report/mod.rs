//! The report: what was measured, as data, files and a page.

mod agree;
mod colours;
mod cost;
mod csv;
mod embed;
mod error_plot;
mod figure;
mod files;
mod findings;
mod json;
mod model;
mod number;
mod overview;
mod page;
mod plot;
#[cfg(test)]
pub(crate) mod sample;
mod settle;

pub use agree::Disagreement;
pub use colours::{difference_colour, difference_picture, visibility_picture};
pub use cost::{Cost, CostRatio, StageCost, StageRatio};
pub use embed::EmbedError;
pub use figure::{Axis, Body, Figure, GridRow, Picture, PictureGrid, Plot, Scale, Series, Stroke, Table};
pub(crate) use files::MAX_FILE_BYTES;
pub use files::{CSV_FILE, JSON_FILE, PAGE_FILE, PLOTS_FOLDER, ReadError, WriteError};
pub use findings::{Findings, SceneFindings};
pub use json::{FromJsonError, ToJsonError};
pub use model::{Contestant, Errors, Extent, Group, Header, Machine, Parameter, Report, Truth};
pub(crate) use number::{grouped, significant};
pub use page::PageError;
pub(crate) use page::{Section, boxed, document, number};
pub use plot::{PlotError, PlotUse};
pub use settle::BASELINE_TECHNIQUE;
