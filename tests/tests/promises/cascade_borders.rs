//! Where cascades meet, shadows are as near the truth as elsewhere, and nothing jumps.
//!
//! Asked are points of a floor and a wall that the borders cross, all over them, by the visibility function on the device.
//! Faults are planted in its text.

use contrejour_gpu::ShadowOptions;
use contrejour_plan::{CascadeSettings, Cascades, Eye, ShadowSettings, Technique, cascade_views};
use contrejour_tests::ask::{Point, visibility_at};
use contrejour_tests::avenue::{EYE, PERIOD, Seen, Surface, avenue, seen_at, sun, truth};
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::pipeline::Pipeline;
use contrejour_tests::planted::Replaced;
use contrejour_tests::random::Random;
use glam::DVec3;
use libtest_mimic::Trial;

/// From so many places along the avenue, so that on average the same shadows are at all depths.
const EYES: u32 = 8;

/// Wide borders have many points.
const CASCADES: CascadeSettings =
    CascadeSettings { count: 4, border_share: 0.25, caster_margin: 0.0, ..CascadeSettings::DEFAULT };

const ANGULAR_RADIUS: f64 = 0.004;

/// In a band, or in the rest of a slice, for an eye.
const POINTS: usize = 1500;

/// Errors of so many points that are alike may differ by so much.
const BY_CHANCE: f64 = 1.03;

/// So far on both sides of a border points are compared, world units.
const STEP: f64 = 1e-3;

/// Of pairs across a border.
const PAIRS: usize = 4000;

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("cascade_borders::bands_are_as_near_the_truth_as_the_rest", bands_are_as_near_the_truth_as_the_rest),
        gpu_trial("cascade_borders::nothing_jumps", nothing_jumps),
    ]
}

/// In the bands, where a receiver asks two cascades.
const WRONG_BANDS: [Replaced; 2] = [
    // The next cascade is shifted.
    (
        "contrejour_visibility_in_view(view + 1u, position_world, normal_world)",
        "contrejour_visibility_in_view(view + 1u, position_world + vec3f(0.1, 0.0, 0.1), normal_world)",
    ),
    // It ends where the next one begins, and lets light in.
    ("if view < last {\n        next", "if false {\n        next"),
];

/// On the way from one cascade to the next.
const JUMPS: [Replaced; 2] = [
    ("if next_share == 0.0 {", "if true {"),
    ("normal_world), next, next_share);", "normal_world), next, 1.0 - next_share);"),
];

/// The avenue's shadows for an eye, and what they are asked by.
struct Avenue<'a> {
    gpu: &'a Gpu,
    pipeline: Pipeline<'a>,
    cascades: Cascades,
}

impl<'a> Avenue<'a> {
    fn new(gpu: &'a Gpu, settings: &ShadowSettings, eye: &Eye) -> Result<Self, String> {
        let light = sun(ANGULAR_RADIUS, CASCADES);
        let options = ShadowOptions { settings: *settings, ..Default::default() };
        let mut pipeline = Pipeline::new(gpu, &avenue(), &options)?;
        pipeline.follow_eye(eye);
        pipeline.complete_frame(&light)?;
        let cascades = cascade_views(&light, eye, settings).map_err(|error| error.to_string())?;
        Ok(Self { gpu, pipeline, cascades })
    }

    fn visibility(&self, points: &[Point], fault: Option<Replaced>) -> Vec<f64> {
        let Self { gpu, pipeline, .. } = self;
        let found = visibility_at(gpu, &pipeline.shadows, pipeline.light(), points, fault);
        found.into_iter().map(f64::from).collect()
    }
}

/// Part of a surface that shadows fall on, and the first slice in which all of that is in view.
const SURFACES: [(Surface, [f64; 2], usize); 2] = [(Surface::Floor, [0.2, 0.55], 0), (Surface::Wall, [0.1, 0.5], 1)];

/// Points of a part of a surface between two depths, and the truth there.
struct Place {
    name: &'static str,
    slice: usize,
    is_band: bool,
    points: Vec<Seen>,
    truth: Vec<f64>,
}

/// The bands of all slices but the last, and the rest of each, as an eye sees them.
fn places(eye: &Eye, cascades: &Cascades) -> Result<Vec<Place>, String> {
    let mut places = Vec::new();
    for (surface, [low, high], first) in SURFACES {
        for (slice, cascade) in cascades.cascades.iter().enumerate().skip(first) {
            let is_last = slice + 1 == cascades.cascades.len();
            let rest = (false, [cascade.begin_depth, cascade.blend_depth]);
            let band = (true, [cascade.blend_depth, cascade.end_depth]);
            for (is_band, [near, far]) in [rest, band].into_iter().filter(|(is_band, _)| !(*is_band && is_last)) {
                let spread = |index: usize| {
                    let [across, along] = evenly(index);
                    seen_at(eye, surface, low + (high - low) * across, near + (far - near) * along)
                };
                let points: Vec<_> = (0..POINTS).filter_map(spread).collect();
                let truth = truth(&avenue(), &sun(ANGULAR_RADIUS, CASCADES), &points)?;
                let name = if surface == Surface::Floor { "floor" } else { "wall" };
                places.push(Place { name, slice, is_band, points, truth });
            }
        }
    }
    Ok(places)
}

/// Points that fill the unit square evenly, however many (Roberts 2018, the R2 sequence).
fn evenly(index: usize) -> [f64; 2] {
    const STEP: [f64; 2] = [0.754_877_666_246_692_8, 0.569_840_290_998_053_3];
    STEP.map(|step| (0.5 + step * index as f64).fract())
}

/// Techniques whose edges are as soft as the light asks, and one whose are hard.
fn settings() -> [ShadowSettings; 3] {
    ["smoothies", "pcss", "pcf"].map(|technique| ShadowSettings {
        technique: technique.parse::<Technique>().expect("it is listed"),
        map_size: 512,
        ..Default::default()
    })
}

/// Mean errors of the places, which are alike for all eyes.
fn errors(avenues: &[Avenue<'_>], of_eyes: &[Vec<Place>], fault: Option<Replaced>) -> Vec<f64> {
    let mut sums = vec![(0.0, 0); of_eyes[0].len()];
    for (avenue, places) in avenues.iter().zip(of_eyes) {
        let asked: Vec<_> = places.iter().flat_map(|place| &place.points).map(|seen| seen.point).collect();
        let mut found = avenue.visibility(&asked, fault).into_iter();
        for (place, sum) in places.iter().zip(&mut sums) {
            sum.0 += place.truth.iter().zip(&mut found).map(|(truth, found)| (found - truth).abs()).sum::<f64>();
            sum.1 += place.points.len();
        }
    }
    sums.into_iter().map(|(sum, count)| sum / f64::from(count as u32)).collect()
}

/// Each band is no farther from the truth than the worse of the two slices that meet there. The last one, in which all
/// shadows end, is none of these.
fn check_bands(places: &[Place], errors: &[f64]) -> Outcome {
    let mut checked = 0;
    for ((place, error), index) in places.iter().zip(errors).zip(0..).filter(|((place, _), _)| place.is_band) {
        let (before, after) = (errors[index - 1], errors[index + 1]);
        let name = format!("{}, border {}", place.name, place.slice);
        eprintln!("{name}: {error:.4} in the band, {before:.4} before, {after:.4} after");
        checked += 1;
        // Positive, so that NaN is no success.
        let is_near = *error <= BY_CHANCE * before.max(after);
        if !is_near {
            return Err(format!("{name}: {error} in the band, {before} and {after} beside it"));
        }
    }
    if checked == 5 { Ok(()) } else { Err(format!("{checked} bands")) }
}

fn bands_are_as_near_the_truth_as_the_rest(gpu: &Gpu) -> Outcome {
    let eye = |index| {
        let along = PERIOD * f64::from(index) / f64::from(EYES);
        Eye { position: EYE.position - along * DVec3::Z, ..EYE }
    };
    let eyes: Vec<_> = (0..EYES).map(eye).collect();
    // Slices are the same whatever the technique.
    let slices = Avenue::new(gpu, &settings()[0], &EYE)?.cascades;
    let of_eyes = eyes.iter().map(|eye| places(eye, &slices)).collect::<Result<Vec<_>, _>>()?;
    for settings in settings() {
        let avenues = eyes.iter().map(|eye| Avenue::new(gpu, &settings, eye)).collect::<Result<Vec<_>, _>>()?;
        let check = |fault| check_bands(&of_eyes[0], &errors(&avenues, &of_eyes, fault));
        check(None).map_err(|error| format!("{}: {error}", settings.technique))?;
        for fault in WRONG_BANDS {
            if check(Some(fault)).is_ok() {
                return Err(format!("{}: not found: {fault:?}", settings.technique));
            }
        }
    }
    Ok(())
}

fn nothing_jumps(gpu: &Gpu) -> Outcome {
    let avenue = Avenue::new(gpu, &settings()[0], &EYE)?;
    let mut random = Random::new(2);
    let mut pairs = |depths: &[f64]| {
        let mut pairs = Vec::new();
        while pairs.len() < 2 * PAIRS {
            let depth = depths[random.below(depths.len())];
            let surface = if random.below(3) == 0 { Surface::Wall } else { Surface::Floor };
            let before = seen_at(&EYE, surface, 0.5 + 0.5 * random.signed(), depth - STEP);
            let axis = EYE.axis_world();
            pairs.extend(before.into_iter().flat_map(|seen| {
                let Point { position, normal } = seen.point;
                let along = (axis - axis.dot(normal) * normal).normalize();
                let position = position + 2.0 * STEP / axis.dot(along) * along;
                [seen.point, Point { position, normal }]
            }));
        }
        pairs
    };
    let slices = &avenue.cascades.cascades;
    let borders: Vec<_> =
        (slices[..slices.len() - 1].iter()).flat_map(|slice| [slice.blend_depth, slice.end_depth]).collect();
    let middles: Vec<_> = slices.iter().map(|slice| 0.5 * (slice.begin_depth + slice.blend_depth)).collect();
    let jump = |pairs: &[Point], fault| {
        let found = avenue.visibility(pairs, fault);
        found.chunks(2).map(|pair| (pair[1] - pair[0]).abs()).sum::<f64>() / (found.len() / 2) as f64
    };
    let usual = jump(&pairs(&middles), None);
    let across = pairs(&borders);
    let check = |fault| {
        let found = jump(&across, fault);
        eprintln!("a mean step of {found:.5} at the borders, {usual:.5} elsewhere");
        if found <= 2.0 * usual {
            Ok(())
        } else {
            Err(format!("a mean step of {found} at the borders, {usual} elsewhere"))
        }
    };
    check(None)?;
    for fault in JUMPS {
        if check(Some(fault)).is_ok() {
            return Err(format!("not found: {fault:?}"));
        }
    }
    Ok(())
}
