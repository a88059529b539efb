//! What a frame is held against. Each check is seen to find a planted fault.

mod finite;
mod lit_faces;
mod open_boundary;
mod quads;
mod silhouette;
mod width;

pub(super) use finite::non_finite;
pub(super) use lit_faces::{FaceSigns, bare_lit, wrong_signs};
pub(super) use open_boundary::open_boundary;
pub(super) use quads::missing_quads;
pub(super) use silhouette::wrong_edges;
pub(super) use width::WidthDefinition;
