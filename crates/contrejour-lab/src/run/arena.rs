//! A scene with its truth: what all its groups share.

use contrejour_render::{Contestant, Gpu, save_png};
use contrejour_scene::Scene;
use image::RgbaImage;

use super::error::RunError;
use super::event::{Event, Tell};
use super::folder::RunFolder;
use super::options::RunOptions;
use super::subject::{NamedScene, Subject};
use super::truth::{SceneTruth, moved};
use super::truth_file::TruthKey;
use crate::metrics::{error_figures, mean_flip, motion_excess, umbra_area};
use crate::report::{Errors, Truth, difference_picture, visibility_picture};

/// A scene and its truth.
pub(crate) struct Arena {
    pub name: String,
    pub subject: Subject,
    pub truth: SceneTruth,
    /// How exact the truth is.
    pub exactness: Truth,
    /// Picture of the truth: path from the report's folder.
    pub truth_picture: String,
    penumbra: Vec<bool>,
    /// Shaded with the true visibility.
    shaded: Option<RgbaImage>,
}

impl Arena {
    /// Takes the truth from the folder, or traces it and keeps it there.
    pub fn new(
        gpu: &Gpu,
        named: &NamedScene,
        options: &RunOptions,
        folder: &RunFolder,
        tell: Tell,
    ) -> Result<Self, RunError> {
        let subject = Subject::new(gpu, named, options.effort.picture_size)?;
        if subject.without_area > 0 {
            tell(&Event::WithoutArea { scene: &named.name, receivers: subject.without_area });
        }
        let key = truth_key(named, &subject, options);
        let path = folder.truth_file(&named.name);
        let truth = match SceneTruth::load(&key, &path) {
            Some(truth) => truth,
            None => {
                let truth = SceneTruth::trace(&subject, &options.effort, options.seed, &named.name, tell)?;
                truth.save(&key, &path)?;
                truth
            }
        };
        let nothing = || RunError::NothingToCompare { scene: named.name.clone() };
        let exactness = truth.exactness().ok_or_else(nothing)?;
        let truth_picture = folder.picture(&named.name, "truth");
        save_png(
            &visibility_picture(subject.scene.size, &truth.visibility, &truth.compared)?,
            &folder.path(&truth_picture),
        )?;
        let shaded = has_flip().then(|| subject.judge.compose(&subject.light, &truth.visibility)).transpose()?;
        let penumbra = truth.penumbra()?;
        Ok(Self { name: named.name.clone(), subject, truth, exactness, truth_picture, penumbra, shaded })
    }

    /// Draws a contestant under the still and under the moving light and compares it with the truth. Also returns its
    /// visibility under the still light.
    pub fn judge(&self, contestant: &mut Contestant, tell: Tell) -> Result<(Errors, Vec<f32>), RunError> {
        let Self { subject, truth, .. } = self;
        let light = &subject.light;
        let mut frames = Vec::new();
        for step in 0..truth.motion.len() as u32 {
            contestant.draw(&moved(light, step))?;
            frames.push(contestant.visibility()?);
            tell(&Event::FrameDone);
        }
        let still = frames[0].clone();
        let nothing = || RunError::NothingToCompare { scene: self.name.clone() };
        let flip = match &self.shaded {
            Some(shaded) => mean_flip(shaded, &subject.judge.compose(light, &still)?)?,
            None => None,
        };
        let errors = Errors {
            receivers: error_figures(&truth.visibility, &still, &truth.compared)?.ok_or_else(nothing)?,
            penumbra: error_figures(&truth.visibility, &still, &self.penumbra)?,
            umbra: umbra_area(&truth.visibility, &still, &truth.compared)?.ok_or_else(nothing)?,
            flip,
            motion: motion_excess(&truth.motion, &frames, &truth.motion_compared)?,
        };
        Ok((errors, still))
    }

    /// Writes a contestant's visibility and its difference from the truth; returns their paths from the folder.
    pub fn save_pictures(&self, name: &str, visibility: &[f32], folder: &RunFolder) -> Result<[String; 2], RunError> {
        let Self { subject: Subject { scene: Scene { size, .. }, .. }, truth, .. } = self;
        let paths = [folder.picture(&self.name, name), folder.picture(&self.name, &format!("{name}-difference"))];
        let pictures = [
            visibility_picture(*size, visibility, &truth.compared)?,
            difference_picture(*size, &truth.visibility, visibility, &truth.compared)?,
        ];
        for (path, picture) in paths.iter().zip(&pictures) {
            save_png(picture, &folder.path(path))?;
        }
        Ok(paths)
    }
}

/// What the truth of a scene depends on.
pub(super) fn truth_key(named: &NamedScene, subject: &Subject, options: &RunOptions) -> TruthKey {
    TruthKey::new(named.fingerprint(), subject.receivers_fingerprint(), options.seed, &options.effort)
}

/// Whether the build compares pictures by FLIP.
pub(super) fn has_flip() -> bool {
    cfg!(feature = "flip")
}
