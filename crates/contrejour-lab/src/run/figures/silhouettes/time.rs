//! Time to find a silhouette and to build its smoothies, against the number of edges.

use std::hint::black_box;
use std::time::Instant;

use contrejour_plan::views;

use super::super::super::error::RunError;
use super::super::super::lab::Lab;
use super::LoneMesh;
use super::device_stages::{DeviceStages, has_clock};
use super::ordered_map::ordered_map_silhouette;
use crate::metrics::{PowerLaw, Timing, power_law};
use crate::report::{Axis, Body, Extent, Figure, Plot, Scale, Series, Stroke};

/// Faces of the tori.
const FACES: [u32; 7] = [1000, 3000, 10_000, 30_000, 100_000, 300_000, 1_000_000];

/// How many times the least time a point has to take to be fitted: below, a fixed cost bends the curve.
const FITTED_FROM: f64 = 3.0;

/// What is timed, in the order of the legend.
const LABELS: [&str; 3] = ["device", "twin on the CPU", "ordered map"];

pub(in super::super) fn make(lab: &Lab) -> Result<Figure, RunError> {
    let (meshes, rounds) = if lab.options.effort.extent == Extent::Quick { (5, 5) } else { (FACES.len(), 9) };
    let mut points = [Vec::new(), Vec::new(), Vec::new()];
    for faces in FACES.into_iter().take(meshes) {
        let torus = LoneMesh::torus(faces)?;
        for (points, timing) in points.iter_mut().zip(timings(lab, &torus, rounds)?) {
            points.push([torus.edges(), timing.median_ms]);
        }
    }
    let clock = if has_clock(lab.gpu) {
        "the sum of its stages' timestamps"
    } else {
        "the clock on the wall around a submission of all stages, which has a price of its own"
    };
    let caption = format!(
        "Tori of {} to {} edges under a light that moves. The device runs all compute stages: silhouette, quads and \
         corners, ready to draw; its time is {clock}. The twin does the same on one core of the CPU. The ordered map \
         finds the silhouette alone: each frame puts every face's edges into a map keyed by their two vertices, as \
         programs do that keep no topology. Medians of {rounds} frames, taken in turns. {}",
        ends(&points[0])[0],
        ends(&points[0])[1],
        told(&points),
    );
    let series = LABELS.iter().zip(points).flat_map(|(label, points)| with_fit(label, points)).collect();
    let plot = Plot {
        x: Axis { label: "edges".to_owned(), scale: Scale::Log },
        y: Axis { label: "time of a frame, ms".to_owned(), scale: Scale::Log },
        series,
    };
    Ok(Figure { title: "Time to find silhouettes and build smoothies".to_owned(), caption, body: Body::Plot(plot) })
}

/// Times of all ways, which take turns.
fn timings(lab: &Lab, torus: &LoneMesh, rounds: usize) -> Result<[Timing; 3], RunError> {
    let light = torus.light;
    let light_object = views(&light)?[0].light_world;
    let mut device = DeviceStages::new(lab.gpu, torus)?;
    let mirror = torus.mirror_frame(&light)?;
    let mut samples = [Vec::new(), Vec::new(), Vec::new()];
    // The first frame compiles, grows lists and fills caches.
    for round in 0..=rounds {
        let times = [
            device.time_ms()?,
            time_ms(|| mirror.run()),
            time_ms(|| ordered_map_silhouette(&torus.topology.positions, &torus.topology.faces, light_object)),
        ];
        if round > 0 {
            samples.iter_mut().zip(times).for_each(|(samples, time)| samples.push(time));
        }
    }
    let [device, mirror, map] = samples.map(|samples| Timing::from_samples(&samples));
    Ok([device?, mirror?, map?])
}

/// Time of one run. The result is dropped after the clock has stopped.
fn time_ms<Result>(run: impl FnOnce() -> Result) -> f64 {
    let clock = Instant::now();
    let result = black_box(run());
    let time = clock.elapsed();
    drop(result);
    1000.0 * time.as_secs_f64()
}

/// The points that grow with the mesh, not those that a fixed cost rules.
fn fitted(points: &[[f64; 2]]) -> Vec<[f64; 2]> {
    let least = points.iter().map(|[_, ms]| *ms).fold(f64::INFINITY, f64::min);
    points.iter().copied().filter(|[_, ms]| *ms >= FITTED_FROM * least).collect()
}

/// What was measured, and the power law through the points that are fitted.
fn with_fit(label: &str, points: Vec<[f64; 2]>) -> Vec<Series> {
    let fitted = fitted(&points);
    let fit = power_law(&fitted).map(|law| Series {
        label: format!("~ edges^{:.2}", law.exponent),
        points: fitted.iter().map(|&[edges, _]| [edges, law.at(edges)]).collect(),
        stroke: Stroke::Dashed,
    });
    let measured = Series { label: label.to_owned(), points, stroke: Stroke::Marks };
    [Some(measured), fit].into_iter().flatten().collect()
}

/// x of the first and of the last point.
fn ends(points: &[[f64; 2]]) -> [f64; 2] {
    [points.first(), points.last()].map(|point| point.map_or(0.0, |[x, _]| *x))
}

/// How fast each grows, and who is how much faster at the end.
fn told(points: &[Vec<[f64; 2]>; 3]) -> String {
    let exponents = LABELS.iter().zip(points).filter_map(|(label, points)| {
        let PowerLaw { exponent, .. } = power_law(&fitted(points))?;
        Some(format!("{label} {exponent:.2}"))
    });
    let exponents = exponents.collect::<Vec<_>>().join(", ");
    let exponents = if exponents.is_empty() { "none, too few grow so much" } else { &exponents };
    let last = points.each_ref().map(|points| points.last().map_or(0.0, |[_, ms]| *ms));
    format!(
        "Exponents of the number of edges, fitted to the points of each way that take at least {FITTED_FROM} times its \
         least time, since a fixed cost bends what is below: {exponents}. On the largest torus the ordered map takes {:.1} \
         times as long as the device and {:.1} times as long as the twin.",
        last[2] / last[0],
        last[2] / last[1],
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_told_follows_the_times() {
        let points = |exponents: [f64; 3]| {
            exponents.map(|exponent| [1.0, 1e3, 1e4].map(|x: f64| [x, x.powf(exponent)]).to_vec())
        };
        assert_eq!(
            told(&points([0.5, 1.0, 1.5])),
            "Exponents of the number of edges, fitted to the points of each way that take at least 3 times its least \
             time, since a fixed cost bends what is below: device 0.50, twin on the CPU 1.00, ordered map 1.50. On \
             the largest torus the ordered map takes 10000.0 times as long as the device and 100.0 times as long as \
             the twin."
        );
        assert!(told(&points([0.5, 1.0, 1.2])).contains("ordered map 1.20"));
    }

    #[test]
    fn a_fit_goes_with_its_points() {
        let series = with_fit("device", vec![[1.0, 1.0], [10.0, 1.5], [100.0, 10.0], [1000.0, 100.0]]);
        assert_eq!(series.iter().map(|series| series.label.as_str()).collect::<Vec<_>>(), ["device", "~ edges^1.00"]);
        assert_eq!(series[1].points.len(), 2, "a fixed cost rules the others");
        assert_eq!(with_fit("one", vec![[10.0, 1.0]]).len(), 1);
    }
}
