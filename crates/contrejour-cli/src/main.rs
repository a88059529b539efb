//! The binary `contrejour`: render, silhouette, inspect and plan from a shell.

mod args;
mod failure;
mod frame_names;
mod inspect;
mod output;
mod plan;
mod render;
mod render_json;
mod scenes;
mod silhouette;
mod values;

use std::process::ExitCode;

use clap::Parser;

use args::{Arguments, Command};
use failure::one_line;

fn main() -> ExitCode {
    let result = match Arguments::parse().command {
        Command::Render(arguments) => render::run(&arguments),
        Command::Silhouette(arguments) => silhouette::run(&arguments),
        Command::Inspect(arguments) => inspect::run(&arguments),
        Command::Plan(arguments) => plan::run(&arguments),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("contrejour: {}", one_line(error.as_ref()));
            ExitCode::from(2)
        }
    }
}
