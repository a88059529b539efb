//! The promises, one file each, on the whole pipeline.

use std::process::ExitCode;

fn main() -> ExitCode {
    contrejour_tests::harness::run(Vec::new())
}
