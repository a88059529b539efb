//! The pipelines of a frame.

use super::{Pass, Stage};

/// A pipeline that the frame needs.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct PipelinePlan {
    /// What runs it, and where its shaders start.
    pub entry_points: EntryPoints,
    /// Override constants, by name.
    pub constants: Vec<(&'static str, f64)>,
}

/// What runs a pipeline, and where its shaders start.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[cfg_attr(feature = "serde", serde(rename_all = "snake_case"))]
pub enum EntryPoints {
    /// A compute stage; its name is the entry point.
    Compute(Stage),
    /// A draw of a raster pass.
    Raster {
        /// The pass.
        pass: Pass,
        /// Entry point of its vertices.
        vertex: &'static str,
        /// Entry point of its fragments.
        fragment: &'static str,
    },
}

impl PipelinePlan {
    pub(super) fn of_stage(stage: Stage) -> Self {
        Self { entry_points: EntryPoints::Compute(stage), constants: Vec::new() }
    }

    /// One for each draw of the pass. `remap_alpha` is the override constant of the smoothies' fragments.
    pub(super) fn of_pass(pass: Pass, remap_alpha: f64) -> Vec<Self> {
        let (vertices, fragment): (&[_], _) = match pass {
            Pass::ShadowMap => (&["vertex_shadow_map"], "fragment_shadow_map"),
            Pass::SmoothieDepth => (&["vertex_quad", "vertex_corner"], "fragment_smoothie_depth"),
            Pass::SmoothieAlpha => (&["vertex_quad", "vertex_corner"], "fragment_smoothie_alpha"),
            Pass::SmoothieBuffer => (&["vertex_quad", "vertex_corner"], "fragment_smoothie_buffer"),
            Pass::Visibility => (&["vertex_visibility"], "fragment_visibility"),
        };
        let constants = if pass.draws_smoothies() { vec![("remap_alpha", remap_alpha)] } else { Vec::new() };
        let pipeline = |vertex: &&'static str| Self {
            entry_points: EntryPoints::Raster { pass, vertex, fragment },
            constants: constants.clone(),
        };
        vertices.iter().map(pipeline).collect()
    }
}
