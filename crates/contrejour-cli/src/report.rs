//! `contrejour report`: error against run time, as data and as a page.

use std::path::Path;

use contrejour_lab::report::{CSV_FILE, JSON_FILE, PAGE_FILE, Report};
use contrejour_lab::run::{NamedScene, RunOptions, Shard, default_sizes, merge, run as measure};
use contrejour_render::Gpu;
use serde_json::json;

use crate::failure::Failure;
use crate::output::{print, warn};
use crate::report_args::ReportArguments;
use crate::report_progress::Progress;
use crate::scenes;

pub fn run(arguments: &ReportArguments) -> Result<(), Failure> {
    let command = command_line(std::env::args().skip(1));
    let report = if arguments.merge.is_empty() {
        measured(arguments, command)?
    } else {
        merge(&arguments.merge, &command, &arguments.output)?
    };
    print(&told(arguments, &report)?)
}

fn measured(arguments: &ReportArguments, command: String) -> Result<Report, Failure> {
    let scenes = arguments.scene_names().iter().map(|name| named_scene(name)).collect::<Result<_, Failure>>()?;
    let effort = arguments.effort();
    let sizes =
        if arguments.sizes.is_empty() { default_sizes(effort.extent).to_vec() } else { arguments.sizes.clone() };
    let options = RunOptions {
        scenes,
        sizes,
        techniques: arguments.techniques.clone(),
        effort,
        seed: arguments.seed,
        shard: arguments.shard.unwrap_or(Shard::WHOLE),
        restart: arguments.restart,
        command,
        folder: arguments.output.clone(),
    };
    let progress = Progress::new();
    let report = measure(&Gpu::open()?, &options, &|event| progress.show(event));
    progress.done();
    Ok(report?)
}

/// A scene, called as it was asked for; a file by its name without ending.
fn named_scene(name: &str) -> Result<NamedScene, Failure> {
    let scene = scenes::open(Some(name))?;
    scene.warnings.iter().for_each(|warning| warn(warning));
    let stem = Path::new(name).file_stem().map_or(name.into(), |stem| stem.to_string_lossy());
    Ok(NamedScene { name: stem.into_owned(), scene })
}

/// The command as a shell takes it.
pub fn command_line(arguments: impl Iterator<Item = String>) -> String {
    let is_plain = |char: char| char.is_ascii_alphanumeric() || "-_./,=+:@%".contains(char);
    let quoted = arguments.map(|argument| {
        let needs_no_quotes = !argument.is_empty() && argument.chars().all(is_plain);
        if needs_no_quotes { argument } else { format!("'{}'", argument.replace('\'', r"'\''")) }
    });
    ["contrejour".to_owned()].into_iter().chain(quoted).collect::<Vec<_>>().join(" ")
}

/// Paths of what was written, that of the page last.
fn told(arguments: &ReportArguments, report: &Report) -> Result<String, Failure> {
    let [page, json, csv] = [PAGE_FILE, JSON_FILE, CSV_FILE].map(|file| arguments.output.join(file));
    if arguments.json {
        let (groups, figures) = (report.groups.len(), report.figures.len());
        let told = json!({ "page": page, "json": json, "csv": csv, "groups": groups, "figures": figures });
        return Ok(serde_json::to_string_pretty(&told)?);
    }
    Ok([json, csv, page].map(|path| path.display().to_string()).join("\n"))
}

#[cfg(test)]
mod tests {
    use clap::Parser;
    use contrejour_lab::report::Extent;
    use contrejour_lab::run::entrants;
    use contrejour_plan::ShadowSettings;

    use super::*;
    use crate::args::{Arguments, Command};

    #[test]
    fn every_contestant_can_be_drawn_by_its_arguments() {
        let scene = ShadowSettings::default();
        for entrant in entrants(Extent::Full, &[]).expect("nothing is asked for by name") {
            let line = format!("contrejour render {} --map-size 512", entrant.arguments());
            let arguments = Arguments::try_parse_from(line.split_whitespace()).expect("the line is good");
            let Command::Render(render) = arguments.command else { panic!("{line} is a render command") };
            let settings = render.shadow.applied_to(scene).expect("the settings are good");
            assert_eq!(settings, entrant.settings(&scene, 512), "{line}");
        }
    }

    #[test]
    fn a_command_can_be_given_to_a_shell_again() {
        let arguments = ["report", "--scenes", "my scene.toml,boxes", "-o", "it's"].map(str::to_owned);
        let line = command_line(arguments.into_iter());
        assert_eq!(line, r"contrejour report --scenes 'my scene.toml,boxes' -o 'it'\''s'");
    }
}
