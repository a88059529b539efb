//! `contrejour stability`: extreme cases, as a table and as a page.

use std::path::PathBuf;
use std::process::ExitCode;

use contrejour_lab::stability::{
    CSV_FILE, Event, Findings, JSON_FILE, Options, PAGE_FILE, Stability, families, run as try_all,
};
use contrejour_render::Gpu;
use serde::Serialize;

use crate::failure::Failure;
use crate::output::{print, warn};
use crate::report::command_line;
use crate::report_progress::{Progress, counted, seconds};
use crate::stability_args::StabilityArguments;

/// What `--json` prints.
#[derive(Serialize)]
struct Told {
    page: PathBuf,
    json: PathBuf,
    csv: PathBuf,
    #[serde(flatten)]
    findings: Findings,
}

/// Findings of a fault are no bad input.
const FAULT_FOUND: u8 = 1;

pub fn run(arguments: &StabilityArguments) -> Result<ExitCode, Failure> {
    // Before a device is opened.
    families(&arguments.families)?;
    let options = Options {
        families: arguments.families.clone(),
        effort: arguments.effort(),
        command: command_line(std::env::args().skip(1)),
        folder: arguments.output.clone(),
    };
    let progress = Progress::new();
    let found = try_all(&Gpu::open()?, &options, &|event| show(&progress, event));
    progress.done();
    let found = found?;
    let faults = found.faults();
    faults.iter().for_each(|fault| warn(fault));
    print(&told(arguments, &found)?)?;
    Ok(if faults.is_empty() { ExitCode::SUCCESS } else { ExitCode::from(FAULT_FOUND) })
}

fn show(progress: &Progress, event: &Event) {
    match *event {
        Event::FamilyBegins { family, cases } => progress.begin(family.to_owned(), cases),
        Event::CaseDone => progress.step(),
        Event::FamilyDone { family, rows, faulty, duration } => {
            let faults = if faulty > 0 { format!(", {faulty} with a fault") } else { String::new() };
            progress.tell(&format!("{family}: {}{faults}, {}", counted(rows, "case"), seconds(duration)));
        }
    }
}

/// Paths of what was written, that of the page last; or the sums.
fn told(arguments: &StabilityArguments, found: &Stability) -> Result<String, Failure> {
    let [page, json, csv] = [PAGE_FILE, JSON_FILE, CSV_FILE].map(|file| arguments.output.join(file));
    if arguments.json {
        return Ok(serde_json::to_string_pretty(&Told { page, json, csv, findings: found.findings() })?);
    }
    Ok([json, csv, page].map(|path| path.display().to_string()).join("\n"))
}
