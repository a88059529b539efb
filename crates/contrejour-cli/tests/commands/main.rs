//! The command line as a user runs it.

mod bad_input;
#[cfg(unix)]
mod hostile_files;
mod program;
mod render;
mod report;
mod reports;
mod silhouette;
mod stability;
mod stress;
mod xml;

use std::env;
use std::process::ExitCode;

use contrejour_render::Gpu;
use libtest_mimic::{Arguments, Completion, Failed, Trial};

/// What a test returns: the first thing that is not as it should be.
type Outcome = Result<(), String>;

fn main() -> ExitCode {
    let trials = [
        silhouette::trials(),
        render::trials(),
        reports::trials(),
        report::trials(),
        stability::trials(),
        stress::trials(),
        bad_input::trials(),
        xml::trials(),
        #[cfg(unix)]
        hostile_files::trials(),
    ];
    libtest_mimic::run(&Arguments::from_args(), trials.into_iter().flatten().collect()).exit_code()
}

fn cpu_trial(name: impl Into<String>, test: impl FnOnce() -> Outcome + Send + 'static) -> Trial {
    Trial::test(name, move || test().map_err(Failed::from))
}

/// A test that is ignored where there is no device, or fails there with `CONTREJOUR_REQUIRE_GPU=1`.
fn gpu_trial(name: impl Into<String>, test: impl FnOnce() -> Outcome + Send + 'static) -> Trial {
    Trial::ignorable_test(name, move || match Gpu::open() {
        Ok(_) => test().map(|()| Completion::Completed).map_err(Failed::from),
        Err(error) if env::var("CONTREJOUR_REQUIRE_GPU").is_ok_and(|value| value == "1") => {
            Err(Failed::from(format!("a device is required: {error}")))
        }
        Err(error) => Ok(Completion::ignored_with(error.to_string())),
    })
}
