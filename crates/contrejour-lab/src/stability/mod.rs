//! Extreme cases: families of them, each swept over many decades until it breaks by definition or the type ends.
//!
//! Each [`Case`] goes through the whole pipeline on the device and through the CPU twins of its stages, and is held
//! against exact arithmetic and against the definitions: a [`Row`] a case.

mod case;
mod checks;
mod device;
mod effort;
mod error;
mod event;
mod families;
mod family;
mod files;
mod findings;
mod lights;
mod measure;
mod meshes;
mod page;
mod plates;
mod row;
mod run;
mod seen_view;
mod sight;

pub use case::{Case, CaseMesh};
pub use effort::Effort;
pub use error::StabilityError;
pub use event::Event;
pub use families::FAMILIES;
pub use family::{Family, UnknownFamily, families};
pub use files::{CSV_FILE, JSON_FILE, PAGE_FILE, WriteError};
pub use findings::Findings;
pub use row::{COLUMNS, FacingTimes, Row};
pub use run::{FamilyRows, Header, Options, Stability, run};
