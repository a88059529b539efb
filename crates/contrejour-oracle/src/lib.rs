//! What must be found, by definition: in exact arithmetic, by brute force and without any cleverness.
//!
//! Shares no code with the stages, their twins or the building of topology; tests, measurements and fuzz targets hold
//! those against it.

mod closed;
mod facing;
mod many_lights;
mod outline_gap;
mod silhouette;

pub use closed::open_vertices;
pub use facing::lit;
pub use many_lights::ManyLights;
pub use outline_gap::{GapSearch, OutlineGap, blocker_image, outline_gaps};
pub use silhouette::{OracleEdge, OracleTopology, silhouette};
