//! What smoothies add to a shadow map, from small maps to large ones.

use contrejour_scene::shapes::Shape;

use super::super::effort::Effort;
use super::super::error::RunError;
use super::super::lab::Lab;
use super::super::subject::{NamedScene, Subject};
use super::methods::{SHADOW_MAP, THIN};
use super::silhouettes::LoneMesh;
use super::turns::turns;
use crate::report::{Axis, Body, Extent, Figure, Plot, Scale, Series, Stroke};

/// 3 * 866 * 50 = 129 900 edges.
const KNOT: Shape = Shape::Knot { radius: 0.95, tube_radius: 0.23, segments: 866, sides: 50 };

/// Texels along the map's side.
const MAP_SIZES: [u32; 6] = [256, 512, 1024, 2048, 4096, 8192];

/// The largest maps take long, and the times are far apart.
const ROUNDS_MAX: usize = 5;

/// So few receivers that asking them takes no time beside the maps.
const PICTURE_SIZE: [u32; 2] = [16, 16];

pub(super) fn make(lab: &Lab) -> Result<Figure, RunError> {
    let named = NamedScene { name: "knot".to_owned(), scene: LoneMesh::new(&KNOT)?.scene };
    let subject = Subject::new(lab.gpu, &named, PICTURE_SIZE)?;
    let [faces, edges] = subject.faces_and_edges()?;
    let Effort { warm_up_rounds, timed_rounds, .. } = lab.options.effort;
    let effort = Effort {
        warm_up_rounds: warm_up_rounds.min(1),
        timed_rounds: timed_rounds.min(ROUNDS_MAX),
        ..lab.options.effort
    };
    let methods = [SHADOW_MAP, THIN];
    let mut series = methods.map(|_| Vec::new());
    for map_size in map_sizes(effort.extent, lab.gpu.facts().max_texture_dimension_2d) {
        let costs = turns(lab, &subject, &methods, map_size, &effort)?;
        for (points, cost) in series.iter_mut().zip(&costs) {
            points.push([f64::from(map_size), cost.whole().median_ms]);
        }
    }
    let clock = if lab.gpu.is_software() { "clock on the wall, around a submission" } else { "device timestamps" };
    let caption = format!(
        "A knot of {faces} faces and {edges} edges under a light that moves: the depth-only shadow map alone, and \
         with everything that smoothies (t = 0.02) need besides it: silhouette, geometry, linear depth and smoothie \
         buffers. Medians by {clock}. {}",
        told(&series),
    );
    let [alone, all] = series;
    let line = |label: &str, points| Series { label: label.to_owned(), points, stroke: Stroke::Line };
    let plot = Plot {
        x: Axis { label: "texels along the map's side".to_owned(), scale: Scale::Log },
        y: Axis { label: "time of a frame, ms".to_owned(), scale: Scale::Linear },
        series: vec![line("shadow map alone", alone), line("shadow map and smoothies", all)],
    };
    Ok(Figure { title: "What smoothies add to a shadow map".to_owned(), caption, body: Body::Plot(plot) })
}

/// The sizes of an extent that the device has textures for.
fn map_sizes(extent: Extent, largest: u32) -> impl Iterator<Item = u32> {
    let count = if extent == Extent::Quick { 4 } else { MAP_SIZES.len() };
    MAP_SIZES.into_iter().take(count).filter(move |&size| size <= largest)
}

/// How the two compare at the smallest and at the largest map.
fn told([alone, all]: &[Vec<[f64; 2]>; 2]) -> String {
    let parts = [alone.first().zip(all.first()), alone.last().zip(all.last())].map(|ends| match ends {
        Some((&[size, alone], &[_, all])) if alone > 0.0 => {
            format!("{:.2} times as long at {size} texels", all / alone)
        }
        _ => "a time too short for the clock".to_owned(),
    });
    format!("With smoothies a frame takes {} and {}.", parts[0], parts[1])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_follow_extent_and_device() {
        assert_eq!(map_sizes(Extent::Quick, 8192).last(), Some(2048));
        assert_eq!(map_sizes(Extent::Full, 8192).last(), Some(8192));
        assert_eq!(map_sizes(Extent::Full, 4096).last(), Some(4096));
    }

    #[test]
    fn what_is_told_follows_the_times() {
        let times = |last| [vec![[256.0, 2.0], [512.0, 4.0]], vec![[256.0, 3.0], [512.0, last]]];
        let expected =
            "With smoothies a frame takes 1.50 times as long at 256 texels and 2.00 times as long at 512 texels.";
        assert_eq!(told(&times(8.0)), expected);
        assert_ne!(told(&times(9.0)), expected);
    }
}
