//! The report: what was measured, as data, files and a page.

mod cost;
mod csv;
mod figure;
mod json;
mod model;
#[cfg(test)]
mod sample;
mod settle;

pub use cost::{Cost, CostRatio, StageCost, StageRatio};
pub use figure::{Axis, Body, Figure, GridRow, Picture, PictureGrid, Plot, Scale, Series, Stroke, Table};
pub use json::{FromJsonError, ToJsonError};
pub use model::{Contestant, Errors, Extent, Group, Header, Machine, Parameter, Report, Truth};
pub use settle::BASELINE_TECHNIQUE;
