//! Text on standard output or in a file.

use std::io::{self, Write};
use std::path::Path;

use contrejour_render::save_file;

use crate::failure::Failure;

/// Prints text and ends the line. A reader that has gone away, such as `head`, is no error.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match writeln!(stdout, "{}", text.trim_end_matches('\n')).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        Err(error) => Err(Box::new(error)),
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

/// Tells something that does not end the program.
pub fn warn(text: &str) {
    eprintln!("note: {}", text.split_whitespace().collect::<Vec<_>>().join(" "));
}
