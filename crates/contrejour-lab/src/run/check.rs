//! Whether all that is asked of a run can be measured, before the first of it is.

use contrejour_render::Gpu;
use contrejour_trace::TraceOptions;

use super::error::RunError;
use super::options::RunOptions;
use super::subject::Subject;
use super::truth::is_fair;

/// Enough to know which receivers face the light.
const FEWEST_RAYS: TraceOptions =
    TraceOptions { seed: 0, replicates: 2, first_samples: 1, most_samples: 1, target_error: 0.0 };

/// Refuses what would end the run on its way, after hours maybe: a map that is larger than the device's textures, a
/// scene that does not fit on it or shows nothing to compare.
pub(super) fn check(gpu: &Gpu, options: &RunOptions) -> Result<(), RunError> {
    let limit = gpu.facts().max_texture_dimension_2d;
    if let Some(&map_size) = options.sizes.iter().find(|size| **size > limit) {
        return Err(RunError::MapTooLarge { map_size, limit });
    }
    for named in &options.scenes {
        let subject = Subject::new(gpu, named, options.effort.picture_size)?;
        let light = &subject.light;
        // Cascades want more than a few texels.
        options.sizes.iter().try_for_each(|map_size| subject.check_views(*map_size))?;
        let answers = subject.trace(light, &FEWEST_RAYS, 1, &|_| ())?;
        let in_maps = subject.in_maps(light)?;
        if !answers.iter().zip(in_maps).any(|(answer, in_maps)| in_maps && is_fair(answer)) {
            return Err(RunError::NothingToCompare { scene: named.name.clone() });
        }
    }
    Ok(())
}
