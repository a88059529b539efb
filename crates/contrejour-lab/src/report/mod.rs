//! The report: what was measured, as data, files and a page.

mod cost;
mod figure;
mod model;

pub use cost::{Cost, CostRatio, StageCost, StageRatio};
pub use figure::{Axis, Body, Figure, GridRow, Picture, PictureGrid, Plot, Scale, Series, Stroke, Table};
pub use model::{Contestant, Errors, Extent, Group, Header, Machine, Parameter, Report, Truth};
