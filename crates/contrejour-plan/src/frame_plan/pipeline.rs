//! The pipelines of a frame.

use super::{Pass, Stage};
use crate::{AlphaRemap, CastersInFront, Technique};

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
        /// Entry point of its fragments; `None` where only hardware depth is drawn.
        fragment: Option<&'static str>,
    },
}

impl PipelinePlan {
    /// One for bundles of one view first, and one for larger ones behind it, where a stage tells them apart and there may be
    /// some.
    pub(super) fn of_stage(stage: Stage, seats: u32) -> Vec<Self> {
        let entry_points = EntryPoints::Compute(stage);
        if stage != Stage::ClassifyFaces {
            return vec![Self { entry_points, constants: Vec::new() }];
        }
        let one_seat: &[f64] = if seats > 1 { &[1.0, 0.0] } else { &[1.0] };
        one_seat.iter().map(|one| Self { entry_points, constants: vec![("one_seat", *one)] }).collect()
    }

    /// One for each draw of the pass.
    pub(super) fn of_pass(pass: Pass, technique: &Technique, casters_in_front: CastersInFront) -> Vec<Self> {
        let is_pancaked = casters_in_front == CastersInFront::Pancaked;
        let (vertices, fragment): (&[_], _) = match pass {
            Pass::HardwareShadowMap if is_pancaked => {
                (&["vertex_shadow_map"], Some("fragment_pancaked_hardware_depth"))
            }
            Pass::HardwareShadowMap => (&["vertex_shadow_map"], None),
            Pass::ShadowMap if is_pancaked => (&["vertex_shadow_map"], Some("fragment_pancaked_shadow_map")),
            Pass::ShadowMap => (&["vertex_shadow_map"], Some("fragment_shadow_map")),
            Pass::MaskedHardwareShadowMap if is_pancaked => {
                (&["vertex_masked"], Some("fragment_masked_pancaked_hardware_depth"))
            }
            Pass::MaskedHardwareShadowMap => (&["vertex_masked"], Some("fragment_masked_hardware_depth")),
            Pass::MaskedShadowMap if is_pancaked => (&["vertex_masked"], Some("fragment_masked_pancaked_shadow_map")),
            Pass::MaskedShadowMap => (&["vertex_masked"], Some("fragment_masked_shadow_map")),
            Pass::Moments if technique.is_warped() => (&["vertex_full_screen"], Some("fragment_warped_moments")),
            Pass::Moments => (&["vertex_full_screen"], Some("fragment_moments")),
            Pass::BlurredMoments => (&["vertex_full_screen"], Some("fragment_blurred_moments")),
            Pass::SmoothieDepth if is_pancaked => {
                (&["vertex_quad", "vertex_corner"], Some("fragment_pancaked_smoothie_depth"))
            }
            Pass::SmoothieDepth => (&["vertex_quad", "vertex_corner"], Some("fragment_smoothie_depth")),
            Pass::SmoothieAlpha => (&["vertex_quad", "vertex_corner"], Some("fragment_smoothie_alpha")),
            Pass::SmoothieBuffer => (&["vertex_quad", "vertex_corner"], Some("fragment_smoothie_buffer")),
            Pass::SilhouetteMap => (&["vertex_silhouette_quad"], Some("fragment_silhouette_quad")),
            Pass::SilhouetteMapTam => (&["vertex_silhouette_face"], Some("fragment_silhouette_face")),
            Pass::SilhouetteMapStream | Pass::SilhouetteMapHalfStream => {
                (&["vertex_silhouette_stream"], Some("fragment_silhouette_face"))
            }
            Pass::BlendedSilhouetteMap => (&["vertex_silhouette_quad"], Some("fragment_blended_silhouette_quad")),
            Pass::BlendedSilhouetteMapTam => (&["vertex_silhouette_face"], Some("fragment_blended_silhouette_face")),
            Pass::BlendedSilhouetteMapStream | Pass::BlendedSilhouetteMapHalfStream => {
                (&["vertex_silhouette_stream"], Some("fragment_blended_silhouette_face"))
            }
            Pass::Visibility => (&["vertex_visibility"], Some("fragment_visibility")),
        };
        let constants = match technique {
            Technique::Smoothies(smoothies) if pass.draws_smoothies() => {
                vec![("remap_alpha", if smoothies.remap == AlphaRemap::Contact { 1.0 } else { 0.0 })]
            }
            _ => Vec::new(),
        };
        let pipeline = |vertex: &&'static str| Self {
            entry_points: EntryPoints::Raster { pass, vertex, fragment },
            constants: constants.clone(),
        };
        vertices.iter().map(pipeline).collect()
    }
}
