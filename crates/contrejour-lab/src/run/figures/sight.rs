//! A scene of a figure with its truth, at the points that a picture of modest size shows.

use contrejour_plan::{LightKind, ShadowSettings};
use contrejour_scene::Scene;
use image::RgbaImage;

use super::super::effort::Effort;
use super::super::error::RunError;
use super::super::lab::Lab;
use super::super::subject::{NamedScene, Subject};
use super::super::truth::SceneTruth;
use super::super::truth_file::TruthKey;
use crate::metrics::error_figures;
use crate::report::{difference_picture, visibility_picture};

/// A scene and its truth.
pub(super) struct Sight {
    name: String,
    pub subject: Subject,
    pub truth: SceneTruth,
}

/// Pictures of figures stand side by side, so more pixels than this across can't be seen.
const WIDTH_MAX: u32 = 320;

/// The scene of that name that comes with contrejour.
pub(super) fn built_in(name: &'static str) -> Result<Scene, RunError> {
    Ok(Scene::built_in(Some(name)).ok_or(RunError::NoScene { name })??)
}

/// A scene whose spots have other radii.
pub(super) fn with_radii(mut scene: Scene, change: impl Fn(f64) -> f64) -> Scene {
    for light in &mut scene.lights {
        if let LightKind::Spot { radius, .. } = &mut light.light.kind {
            *radius = change(*radius);
        }
    }
    scene
}

impl Sight {
    /// Takes the truth from the run's folder, or traces it and keeps it there. The light does not move.
    pub fn new(lab: &Lab, name: &str, scene: Scene) -> Result<Self, RunError> {
        let named = NamedScene { name: format!("figure-{name}"), scene };
        let picture_size = picture_size(lab.options.effort.picture_size);
        let effort = Effort { picture_size, motion_steps: 0, motion_samples: 1, ..lab.options.effort };
        let subject = Subject::new(lab.gpu, &named, picture_size)?;
        let seed = lab.options.seed;
        let key = TruthKey::new(named.fingerprint(), subject.receivers_fingerprint(), seed, &effort);
        let path = lab.folder.truth_file(&named.name);
        let truth = match SceneTruth::load(&key, &path) {
            Some(truth) => truth,
            None => {
                let truth = SceneTruth::trace(&subject, &effort, seed, name, lab.tell)?;
                truth.save(&key, &path)?;
                truth
            }
        };
        Ok(Self { name: named.name, subject, truth })
    }

    /// The scene's own shadow settings.
    pub fn shadow(&self) -> &ShadowSettings {
        &self.subject.shadow
    }

    /// The visibility that shadows with these settings give.
    pub fn visibility(&self, settings: &ShadowSettings) -> Result<Vec<f32>, RunError> {
        let mut contestant = self.subject.judge.contestant(settings)?;
        contestant.draw(&self.subject.light)?;
        Ok(contestant.visibility()?)
    }

    /// Root of the mean squared difference from the truth.
    pub fn rmse(&self, visibility: &[f32]) -> Result<f64, RunError> {
        let errors = error_figures(&self.truth.visibility, visibility, &self.truth.compared)?;
        Ok(errors.ok_or_else(|| RunError::NothingToCompare { scene: self.name.clone() })?.rmse)
    }

    /// The shaded picture.
    pub fn shaded(&self, visibility: &[f32]) -> Result<RgbaImage, RunError> {
        Ok(self.subject.judge.compose(&self.subject.light, visibility)?)
    }

    /// Visibility as grey, where it is compared.
    pub fn grey(&self, visibility: &[f32]) -> Result<RgbaImage, RunError> {
        Ok(visibility_picture(self.subject.scene.size, visibility, &self.truth.compared)?)
    }

    /// The difference from the truth in false colours.
    pub fn difference(&self, visibility: &[f32]) -> Result<RgbaImage, RunError> {
        let Self { subject, truth, .. } = self;
        Ok(difference_picture(subject.scene.size, &truth.visibility, visibility, &truth.compared)?)
    }
}

/// The run's size, divided evenly until it is narrow enough.
fn picture_size(size: [u32; 2]) -> [u32; 2] {
    let divisor = size[0].div_ceil(WIDTH_MAX).max(1);
    size.map(|side| (side / divisor).max(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_keep_their_shape_and_are_not_too_wide() {
        let sizes = [[64, 48], [320, 240], [640, 480], [641, 480]].map(picture_size);
        assert_eq!(sizes, [[64, 48], [320, 240], [320, 240], [213, 160]]);
    }

    #[test]
    fn every_scene_of_a_figure_is_there() {
        for name in ["cylinder", "fence", "boxes", "knot", "elephant"] {
            assert!(built_in(name).is_ok());
        }
        assert!(matches!(built_in("nowhere"), Err(RunError::NoScene { name: "nowhere" })));
    }
}
