//! What a run tells while it works.

use std::time::Duration;

/// Something that happened. Whoever runs decides how it is shown.
#[derive(Clone, Copy, Debug)]
pub enum Event {
    /// A family is begun.
    FamilyBegins {
        /// Its name.
        family: &'static str,
        /// How many cases it has.
        cases: u64,
    },
    /// A case is done.
    CaseDone,
    /// A family is done.
    FamilyDone {
        /// Its name.
        family: &'static str,
        /// How many rows it has.
        rows: usize,
        /// How many of them have a fault.
        faulty: usize,
        /// How long it took.
        duration: Duration,
    },
}
