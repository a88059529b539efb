//! All families, one after the other.

use std::path::PathBuf;
use std::time::Instant;

use contrejour_render::{Gpu, check_folder};
use serde::Serialize;

use super::effort::Effort;
use super::error::StabilityError;
use super::event::Event;
use super::family::{Family, families};
use super::files::WriteError;
use super::measure::measure;
use super::row::Row;
use crate::report::Extent;

/// What is asked of a run.
#[derive(Clone, Debug)]
pub struct Options {
    /// Names of families; all where it is empty.
    pub families: Vec<String>,
    /// How much is tried.
    pub effort: Effort,
    /// The command that makes the results again.
    pub command: String,
    /// Where everything goes; made where it is missing.
    pub folder: PathBuf,
}

/// Everything that one run found.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Stability {
    /// How it was made.
    pub header: Header,
    /// The families, in the order of the page.
    pub families: Vec<FamilyRows>,
}

/// How results were made.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Header {
    /// The command that makes them again.
    pub command: String,
    /// Version of contrejour.
    pub version: String,
    /// Device, driver and backend, as they call themselves.
    pub device: String,
    /// Whether the device is the CPU: its times then say little about a GPU's.
    pub is_software: bool,
    /// How much was tried.
    pub extent: Extent,
    /// Seed of everything random.
    pub seed: u64,
}

/// A family and what its cases came to.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct FamilyRows {
    /// Its name.
    pub name: &'static str,
    /// What it stresses, in a sentence.
    pub stresses: &'static str,
    /// What is varied, with its unit.
    pub varies: &'static str,
    /// How that is spread along the axis of plots.
    #[serde(skip)]
    pub scale: crate::report::Scale,
    /// A row a case.
    pub rows: Vec<Row>,
}

/// Tries all cases of the families that are asked for and writes what they came to.
///
/// # Errors
///
/// A name that no family has, a device that fails, a folder that can't be written to.
pub fn run(gpu: &Gpu, options: &Options, tell: &dyn Fn(&Event)) -> Result<Stability, StabilityError> {
    let asked = families(&options.families)?;
    check_folder(&options.folder).map_err(WriteError::from)?;
    let effort = Effort { largest_map: gpu.facts().max_texture_dimension_2d, ..options.effort };
    let mut found = Stability { header: header(gpu, options), families: Vec::new() };
    for family in &asked {
        found.families.push(try_family(gpu, family, &effort, tell)?);
    }
    found.write(&options.folder)?;
    Ok(found)
}

fn header(gpu: &Gpu, options: &Options) -> Header {
    Header {
        command: options.command.clone(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        device: gpu.description(),
        is_software: gpu.is_software(),
        extent: options.effort.extent,
        seed: options.effort.seed,
    }
}

fn try_family(
    gpu: &Gpu,
    family: &Family,
    effort: &Effort,
    tell: &dyn Fn(&Event),
) -> Result<FamilyRows, StabilityError> {
    let clock = Instant::now();
    let cases = (family.cases)(effort);
    tell(&Event::FamilyBegins { family: family.name, cases: cases.len() as u64 });
    let mut rows = Vec::with_capacity(cases.len());
    for case in cases {
        let failed = |source| StabilityError::Device { family: family.name, parameter: case.parameter.clone(), source };
        rows.push(measure(gpu, family, &case).map_err(failed)?);
        tell(&Event::CaseDone);
    }
    let faulty = rows.iter().filter(|row| row.faults() > 0).count();
    tell(&Event::FamilyDone { family: family.name, rows: rows.len(), faulty, duration: clock.elapsed() });
    let Family { name, stresses, parameter, scale, .. } = *family;
    Ok(FamilyRows { name, stresses, varies: parameter, scale, rows })
}
