//! The tables and figures of the papers, redone.

use super::error::RunError;
use super::event::Event;
use super::lab::Lab;
use crate::report::Figure;

/// A figure that a run makes at its end, once.
struct Maker {
    /// Its file's name without ending.
    name: &'static str,
    make: fn(&Lab) -> Result<Figure, RunError>,
}

/// In the order of the page.
const MAKERS: [Maker; 0] = [];

/// All figures: those of an earlier run as they are, the others made and kept.
pub(super) fn all(lab: &Lab) -> Result<Vec<Figure>, RunError> {
    let make = |maker: &Maker| {
        if let Some(figure) = lab.folder.figure(maker.name)? {
            return Ok(figure);
        }
        (lab.tell)(&Event::FigureBegins { name: maker.name });
        let figure = (maker.make)(lab)?;
        lab.folder.keep_figure(maker.name, &figure)?;
        Ok(figure)
    };
    MAKERS.iter().map(make).collect()
}
