//! One thing to try.

use contrejour_oracle::GapSearch;
use contrejour_plan::{Light, ShadowSettings, SmoothieSettings, Technique};
use contrejour_scene::Camera;
use glam::DMat4;

use super::row::add_reason;

/// Meshes, a light and settings that go through the pipeline together.
#[derive(Clone, Debug)]
pub struct Case {
    /// What is varied, as the table has it.
    pub parameter: String,
    /// Where the case is along the axis of its family's plots.
    pub at: f64,
    /// What casts.
    pub meshes: Vec<CaseMesh>,
    /// The light.
    pub light: Light,
    /// How its shadow is made.
    pub settings: ShadowSettings,
    /// How gaps are looked for around vertices; none where the definition leaves some, which `degrades` then explains, and
    /// where they would be those of a smaller case.
    pub gap_search: Option<GapSearch>,
    /// From where its visibility is looked at; none where that is not compared with the truth.
    pub seen_from: Option<Camera>,
    /// Why the definition does not hold here, in a sentence; empty where it does.
    pub degrades: String,
    /// The largest error of visibility that is no fault: more where a reason says so.
    pub visibility_error_max: f64,
    /// Whether the library must refuse the case. Everywhere else it must not.
    pub refusal_is_due: bool,
}

/// A mesh in its place.
#[derive(Clone, Debug)]
pub struct CaseMesh {
    /// Position of each vertex, object space.
    pub positions: Vec<[f32; 3]>,
    /// Three vertices a triangle, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
    /// World space from object space.
    pub world_from_object: DMat4,
}

impl Case {
    /// A case with the settings that all families share, and an eye for gaps.
    pub fn new(parameter: String, at: f64, mesh: CaseMesh, light: Light) -> Self {
        Self {
            parameter,
            at,
            meshes: vec![mesh],
            light,
            // As wide as the light asks, up to the map's side.
            settings: ShadowSettings {
                map_size: MAP_SIZE,
                technique: Technique::Smoothies(SmoothieSettings::DEFAULT),
                ..ShadowSettings::default()
            },
            gap_search: Some(GapSearch { directions: 180, max_vertices: 300, ..GapSearch::default() }),
            seen_from: None,
            degrades: String::new(),
            visibility_error_max: VISIBILITY_ERROR_MAX,
            refusal_is_due: false,
        }
    }

    /// The same case where gaps are part of the definition.
    pub fn without_gap_search(mut self, reason: &str) -> Self {
        self.gap_search = None;
        self.explain(reason);
        self
    }

    /// Adds a reason for an error of visibility, which may be so large.
    pub fn explain_error(&mut self, visibility_error_max: f64, reason: &str) {
        self.visibility_error_max = self.visibility_error_max.max(visibility_error_max);
        self.explain(reason);
    }

    /// Adds a reason why the definition does not hold.
    pub fn explain(&mut self, reason: &str) {
        add_reason(&mut self.degrades, reason);
    }
}

/// What a few texels and the shape of the penumbra make.
const VISIBILITY_ERROR_MAX: f64 = 0.06;

/// Texels along the map's side, where a family does not vary them.
const MAP_SIZE: u32 = 512;

impl CaseMesh {
    /// A mesh whose object space is the world.
    pub fn new(positions: Vec<[f32; 3]>, triangles: Vec<[u32; 3]>) -> Self {
        Self { positions, triangles, world_from_object: DMat4::IDENTITY }
    }
}
