//! Each compute stage against its CPU twin, buffer by buffer, fed with inputs made on the CPU.

use std::process::ExitCode;

fn main() -> ExitCode {
    contrejour_tests::harness::run(Vec::new())
}
