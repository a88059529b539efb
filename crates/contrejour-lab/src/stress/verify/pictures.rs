//! Pictures against those of a renderer that knows nothing of the frames before.

use contrejour_render::Gpu;

use super::Verifier;
use crate::stress::error::StressError;
use crate::stress::pictures::{PictureMoment, Pictures};
use crate::stress::world::World;

/// Pixels of a picture: as wide over high as what the eye sees.
pub(super) const SIZE: [u32; 2] = [128, 72];

impl Verifier<'_> {
    /// Holds the picture of a frame against one drawn from scratch. The renderer of the run walks along: it has drawn the
    /// frame before, and all frames that were verified.
    pub(super) fn check_picture(&mut self, gpu: &Gpu, frame: u64) -> Result<(), StressError> {
        let world = self.world;
        let before = frame.saturating_sub(1);
        let walked = match &mut self.walked {
            Some(walked) => walked,
            none => none.insert(Pictures::new(gpu.clone(), world, before, SIZE)?),
        };
        walked.follow(&PictureMoment::new(world, before))?;
        walked.renderer.draw()?;
        walked.follow(&PictureMoment::new(world, frame))?;
        let differing = differing_texels(gpu, world, walked, frame)?;
        let all: u64 = SIZE.map(u64::from).iter().product();
        self.texels += all;
        if differing > 0 {
            self.differ(&format!("frame {frame}: {differing} of {all} texels are not those of a picture from scratch"));
            self.differences += differing - 1;
        }
        Ok(())
    }
}

/// How many texels of a picture differ from those of a renderer that is made for the frame.
pub(super) fn differing_texels(
    gpu: &Gpu,
    world: &World,
    walked: &mut Pictures,
    frame: u64,
) -> Result<u64, StressError> {
    let mut anew = Pictures::new(gpu.clone(), world, frame, SIZE)?;
    let mut pictures = Vec::new();
    for drawn in [walked, &mut anew] {
        drawn.renderer.draw_complete()?;
        pictures.push(drawn.renderer.picture()?);
    }
    let texels = pictures[0].pixels().zip(pictures[1].pixels());
    Ok(texels.filter(|(walked, anew)| walked != anew).count() as u64)
}
