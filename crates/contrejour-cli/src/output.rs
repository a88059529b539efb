//! Text on standard output or in a file.

use std::io::{self, Write};
use std::path::Path;

use contrejour_render::save_file;

use crate::failure::Failure;

/// Makes a file that grows beyond what the user may write (`ulimit -f`) an error of the write. Otherwise the system would
/// end the program, and leave unfinished files behind.
pub fn report_large_files() -> Result<(), Failure> {
    #[cfg(unix)]
    signal_hook::flag::register(signal_hook::consts::SIGXFSZ, Default::default())?;
    Ok(())
}

/// Standard output takes no more.
#[derive(Debug, thiserror::Error)]
#[error("cannot print: {0}; check that what standard output leads to has room")]
struct PrintError(#[source] io::Error);

/// Prints text and ends the line. A reader that has gone away, such as `head`, is no error.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match writeln!(stdout, "{}", text.trim_end_matches('\n')).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        Err(error) => Err(Box::new(PrintError(error))),
        Ok(()) => Ok(()),
    }
}

/// Writes text to a file where one is named, else prints it.
pub fn write_or_print(text: &str, path: Option<&Path>) -> Result<(), Failure> {
    match path {
        Some(path) => Ok(save_file(text.as_bytes(), path)?),
        None => print(text),
    }
}

/// Prints a line on standard error. Nothing can be done where that is closed or full, and nothing is lost but the line.
pub fn tell(line: &str) {
    let _ = writeln!(io::stderr(), "{line}");
}

/// Tells something that does not end the program.
pub fn warn(text: &str) {
    tell(&format!("note: {}", text.split_whitespace().collect::<Vec<_>>().join(" ")));
}
