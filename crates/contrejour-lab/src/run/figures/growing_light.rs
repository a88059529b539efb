//! The umbra under a light that grows: the true one shrinks, that of smoothies does not.

use super::super::error::RunError;
use super::super::lab::Lab;
use super::methods::{BY_LIGHT_SIZE, SHADOW_MAP};
use super::sight::{Sight, built_in, with_radii};
use crate::metrics::UMBRA_UP_TO;
use crate::report::{Axis, Body, Extent, Figure, Plot, Scale, Series, Stroke};

const MAP_SIZE: u32 = 512;

/// Radii of the light. Unit: metres. Every second one makes a quick figure.
const RADII: [f64; 9] = [0.05, 0.15, 0.3, 0.45, 0.6, 0.75, 0.9, 1.05, 1.2];

/// Whose umbra it is, in the order of the legend.
const LABELS: [&str; 3] = ["truth", "smoothies, light's size", "shadow map"];

/// What is seen under the light of one radius.
struct Under {
    radius: f64,
    visibilities: [Vec<f32>; 3],
    compared: Vec<bool>,
}

pub(super) fn make(lab: &Lab) -> Result<Figure, RunError> {
    let step = if lab.options.effort.extent == Extent::Quick { 2 } else { 1 };
    let under = RADII.into_iter().step_by(step).map(|radius| under(lab, radius)).collect::<Result<Vec<_>, _>>()?;
    let series = umbras(&under);
    let caption = format!(
        "Share of the receivers' pixels in the umbra (visibility of at most {UMBRA_UP_TO}) on the cylinder's plane, \
         while the radius of the light's disk grows, at {MAP_SIZE} texels. Smoothies lie outside the hard shadow \
         (Chan and Durand 2003), so they can't make the umbra smaller. {}",
        told(&series),
    );
    let series = LABELS.iter().zip(series).map(|(&label, points)| Series {
        label: label.to_owned(),
        points,
        stroke: Stroke::Line,
    });
    let axis = |label: &str| Axis { label: label.to_owned(), scale: Scale::Linear };
    let plot = Plot { x: axis("radius of the light, m"), y: axis("umbra, % of the pixels"), series: series.collect() };
    Ok(Figure { title: "The umbra under a growing light".to_owned(), caption, body: Body::Plot(plot) })
}

fn under(lab: &Lab, radius: f64) -> Result<Under, RunError> {
    let sight = Sight::new(lab, &format!("light-{radius}"), with_radii(built_in("cylinder")?, |_| radius))?;
    let [smoothies, hard] = [BY_LIGHT_SIZE, SHADOW_MAP].map(|method| method.settings(sight.shadow(), MAP_SIZE));
    let visibilities = [sight.visibility(&smoothies)?, sight.visibility(&hard)?];
    let [smoothies, hard] = visibilities;
    let compared = sight.truth.compared;
    Ok(Under { radius, visibilities: [sight.truth.visibility, smoothies, hard], compared })
}

/// Radius and share of umbra for the truth and the methods, over the pixels that are compared at every radius.
fn umbras(under: &[Under]) -> [Vec<[f64; 2]>; 3] {
    let is_compared = |pixel: usize| under.iter().all(|one| one.compared[pixel]);
    let pixels: Vec<usize> =
        (0..under.first().map_or(0, |one| one.compared.len())).filter(|&pixel| is_compared(pixel)).collect();
    [0, 1, 2].map(|who| under.iter().map(|one| [one.radius, umbra_percent(&one.visibilities[who], &pixels)]).collect())
}

/// Share of some pixels that are in the umbra.
fn umbra_percent(visibility: &[f32], pixels: &[usize]) -> f64 {
    let dark = pixels.iter().filter(|&&pixel| visibility[pixel] <= UMBRA_UP_TO).count();
    100.0 * dark as f64 / pixels.len().max(1) as f64
}

/// How much of each umbra is left at the largest radius.
fn told(series: &[Vec<[f64; 2]>; 3]) -> String {
    let left = |points: &[[f64; 2]]| match (points.first(), points.last()) {
        (Some([_, first]), Some([_, last])) if *first > 0.0 => format!("{:.0} %", 100.0 * last / first),
        _ => "nothing to compare".to_owned(),
    };
    let [truth, smoothies, _] = series.each_ref().map(|points| left(points));
    let [from, to] = [series[0].first(), series[0].last()].map(|end| end.map_or(0.0, |[radius, _]| *radius));
    format!(
        "From a radius of {from} m to {to} m there remains of the true umbra {truth}, of that of smoothies {smoothies}."
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn under(radius: f64, truth: [f32; 4], compared: [bool; 4]) -> Under {
        let smoothies = [0.0, 0.0, 0.5, 1.0];
        Under {
            radius,
            visibilities: [truth.to_vec(), smoothies.to_vec(), smoothies.to_vec()],
            compared: compared.to_vec(),
        }
    }

    #[test]
    fn only_pixels_that_always_count_are_counted() {
        let [truth, smoothies, _] = umbras(&[
            under(0.1, [0.0, 0.01, 0.0, 1.0], [true; 4]),
            under(0.2, [0.0, 0.02, 0.0, 1.0], [true, true, false, true]),
        ]);
        let third = 100.0 / 3.0;
        assert_eq!(truth, [[0.1, 2.0 * third], [0.2, third]]);
        assert_eq!(smoothies, [[0.1, 2.0 * third], [0.2, 2.0 * third]]);
        let expected =
            "From a radius of 0.1 m to 0.2 m there remains of the true umbra 50 %, of that of smoothies 100 %.";
        assert_eq!(told(&[truth.clone(), smoothies.clone(), Vec::new()]), expected);
        assert_ne!(told(&[smoothies.clone(), smoothies, Vec::new()]), expected);
    }

    #[test]
    fn nothing_seen_is_no_umbra() {
        assert_eq!(umbra_percent(&[0.0; 3], &[]), 0.0);
        assert!(told(&[Vec::new(), Vec::new(), Vec::new()]).contains("nothing to compare"));
    }
}
