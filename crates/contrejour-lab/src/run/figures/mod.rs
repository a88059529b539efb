//! The tables and figures of the papers, redone.

mod alpha_remap;
mod beside_truth;
mod boundary;
mod boundary_precision;
mod chan_durand_times;
mod growing_light;
mod methods;
mod methods_by_resolution;
mod overlapping_smoothies;
mod own_shadow;
mod sight;
mod silhouette_map_scenes;
mod silhouette_map_times;
mod silhouettes;
mod smoothie_buffer_cost;
mod torn_by_bias;
mod turns;
mod weak_spots;

use super::error::RunError;
use super::event::Event;
use super::lab::Lab;
use crate::report::Figure;

/// A figure that a run makes at its end, once.
struct Maker {
    /// Its file's name without ending.
    name: &'static str,
    make: fn(&Lab) -> Result<Figure, RunError>,
}

/// In the order of the page.
const MAKERS: [Maker; 15] = [
    Maker { name: "chan-durand-times", make: chan_durand_times::make },
    Maker { name: "silhouette-time", make: silhouettes::time::make },
    Maker { name: "silhouette-size", make: silhouettes::size::make },
    Maker { name: "smoothie-buffer-cost", make: smoothie_buffer_cost::make },
    Maker { name: "methods-by-resolution", make: methods_by_resolution::make },
    Maker { name: "torn-by-bias", make: torn_by_bias::make },
    Maker { name: "growing-light", make: growing_light::make },
    Maker { name: "alpha-remap", make: alpha_remap::make },
    Maker { name: "overlapping-smoothies", make: overlapping_smoothies::make },
    Maker { name: "own-shadow", make: own_shadow::make },
    Maker { name: "silhouette-map-times", make: silhouette_map_times::make },
    Maker { name: "silhouette-map-scenes", make: silhouette_map_scenes::make },
    Maker { name: "boundary-precision", make: boundary_precision::precision },
    Maker { name: "boundary-pictures", make: boundary_precision::pictures },
    Maker { name: "silhouette-map-weak-spots", make: weak_spots::make },
];

/// What a run makes: the first shard all. A report of chosen techniques has no figures, for the papers compare techniques
/// of their own.
fn makers(lab: &Lab) -> &'static [Maker] {
    let has_figures = lab.options.techniques.is_empty() && lab.options.shard.number() == 1;
    if has_figures { &MAKERS } else { &[] }
}

/// How many figures are still to be made.
pub(super) fn pending(lab: &Lab) -> Result<usize, RunError> {
    makers(lab).iter().try_fold(0, |count, maker| Ok(count + usize::from(lab.folder.figure(maker.name)?.is_none())))
}

/// All figures: those of an earlier run as they are, the others made and kept.
pub(super) fn all(lab: &Lab) -> Result<Vec<Figure>, RunError> {
    let make = |maker: &Maker| {
        if let Some(figure) = lab.folder.figure(maker.name)? {
            return Ok(figure);
        }
        (lab.tell)(&Event::FigureBegins { name: maker.name });
        let figure = (maker.make)(lab)?;
        lab.folder.keep_figure(maker.name, &figure)?;
        Ok(figure)
    };
    makers(lab).iter().map(make).collect()
}
