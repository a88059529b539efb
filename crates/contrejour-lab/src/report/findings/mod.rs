//! The text of the report. Every sentence is made from the figures and stands only where they say so.

mod compare;
mod scene;
mod summary;
#[cfg(test)]
mod tests;

use super::{Group, Report};

/// Name of the technique that the report is about.
pub(super) const OURS: &str = "smoothies";

/// What the figures say.
#[derive(Clone, Debug, PartialEq)]
pub struct Findings {
    /// About all scenes together.
    pub summary: Vec<String>,
    /// About each scene at the map size that stands for it.
    pub scenes: Vec<SceneFindings>,
}

/// What the figures say about a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct SceneFindings {
    /// Name of the scene.
    pub scene: String,
    /// The map size that stands for it.
    pub map_size: u32,
    /// What was found.
    pub sentences: Vec<String>,
}

impl Report {
    /// Says in words what the figures say, good and bad.
    pub fn findings(&self) -> Findings {
        let headlines: Vec<&Group> = self.scenes().into_iter().filter_map(|scene| self.headline_of(scene)).collect();
        Findings {
            summary: summary::sentences(&headlines),
            scenes: headlines
                .into_iter()
                .map(|group| SceneFindings {
                    scene: group.scene.clone(),
                    map_size: group.map_size,
                    sentences: scene::sentences(group),
                })
                .collect(),
        }
    }
}
