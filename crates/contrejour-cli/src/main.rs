//! The binary `contrejour`: render, silhouette, inspect, plan and report from a shell.

mod animation;
mod args;
mod failure;
mod frame_names;
mod inspect;
mod output;
mod plan;
mod render;
mod render_json;
mod report;
mod report_args;
mod report_progress;
mod scenes;
mod shadow_args;
mod silhouette;
mod stability;
mod stability_args;
mod stress;
mod stress_args;
#[cfg(feature = "window")]
mod stress_window;
mod values;

use std::process::ExitCode;

use clap::Parser;

use args::{Arguments, Command};
use failure::{Failure, one_line};

fn main() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return told_by_clap(&error),
    };
    let result = output::report_large_files().and_then(|()| run(arguments.command));
    result.unwrap_or_else(|error| {
        output::tell(&format!("contrejour: {}", one_line(error.as_ref())));
        ExitCode::from(2)
    })
}

fn run(command: Command) -> Result<ExitCode, Failure> {
    match command {
        Command::Render(arguments) => done(render::run(&arguments)),
        Command::Silhouette(arguments) => done(silhouette::run(&arguments)),
        Command::Inspect(arguments) => done(inspect::run(&arguments)),
        Command::Plan(arguments) => done(plan::run(&arguments)),
        Command::Report(arguments) => done(report::run(&arguments)),
        Command::Stability(arguments) => stability::run(&arguments),
        Command::Stress(arguments) => stress::run(&arguments),
    }
}

/// Most commands either do what they are told or fail.
fn done(result: Result<(), Failure>) -> Result<ExitCode, Failure> {
    result.map(|()| ExitCode::SUCCESS)
}

/// Help and version go to standard output; what cannot be understood is one line on standard error.
fn told_by_clap(error: &clap::Error) -> ExitCode {
    let shows_help = error.kind() == clap::error::ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand;
    if shows_help || !error.use_stderr() {
        // Nothing can be done about a closed output.
        let _ = error.print();
        return if shows_help { ExitCode::from(2) } else { ExitCode::SUCCESS };
    }
    output::tell(&format!("contrejour: {}", usage_line(&error.to_string())));
    ExitCode::from(2)
}

/// The first paragraph of clap's text in one line, without its heading.
fn usage_line(text: &str) -> String {
    let paragraph = text.lines().map(str::trim).take_while(|line| !line.is_empty()).collect::<Vec<_>>().join(" ");
    format!("{}; see --help", paragraph.trim_start_matches("error: "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_cannot_be_understood_is_one_line() {
        let text = "error: unexpected argument '--magic' found\n\nUsage: contrejour render [OPTIONS]\n";
        assert_eq!(usage_line(text), "unexpected argument '--magic' found; see --help");
        let error = Arguments::try_parse_from(["contrejour", "silhouette", "a.obj"]).expect_err("it has no light");
        assert!(!usage_line(&error.to_string()).contains('\n'));
    }
}
