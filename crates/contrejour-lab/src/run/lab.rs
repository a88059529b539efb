//! What figures are made with.

use contrejour_render::{Gpu, save_png};
use image::RgbaImage;

use super::error::RunError;
use super::event::Tell;
use super::folder::RunFolder;
use super::options::RunOptions;
use crate::report::Picture;

/// The device, the arguments and the folder of a run.
pub(crate) struct Lab<'a> {
    /// The device.
    pub gpu: &'a Gpu,
    /// What is asked of the run: its effort, seed and folder.
    pub options: &'a RunOptions,
    pub(super) folder: &'a RunFolder,
    pub(super) tell: Tell<'a>,
}

impl Lab<'_> {
    /// Keeps a picture of a figure in the folder.
    pub fn keep_picture(&self, figure: &str, name: &str, alt: &str, picture: &RgbaImage) -> Result<Picture, RunError> {
        let path = self.folder.picture(figure, name);
        save_png(picture, &self.folder.path(&path))?;
        Ok(Picture { path, alt: alt.to_owned() })
    }
}
