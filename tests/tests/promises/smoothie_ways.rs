//! The two ways to fill the smoothie buffer, one pass with 32-bit blending and two passes with a depth test and 16-bit
//! blending, leave the same map but for rounding. For every texel:
//!
//! - **Coverage** is equal: both ways keep the same fragments.
//! - **Alpha** differs by at most one step of a 16-bit float, 2^-10 of it (rounding to the nearest costs half of that,
//!   but a device may round to either neighbour), and [`SMALLEST_HALF`] where 16-bit floats are subnormal. Rounding
//!   keeps the order, so the least of the rounded alphas is the rounded least one.
//! - **Linear depth**: two passes keep clip z, which is `q scale + offset`. Rounding of z, of its interpolation and of
//!   the offset, [`CLIP_Z_ROUNDING`] in all, is `CLIP_Z_ROUNDING * max(1, offset) * d(depth)/dz` in depth:
//!   - parallel light: `CLIP_Z_ROUNDING * (far - near)`,
//!   - perspective: `CLIP_Z_ROUNDING * far / (far - near) * depth^2 * (1 / near - 1 / far)`, which at the far end is
//!     `CLIP_Z_ROUNDING * far^2 / near`: a light should not stand farther from its near plane than it must;
//!
//!   and [`Q_ROUNDING`] of the depth for q itself.

use contrejour_gpu::ShadowOptions;
use contrejour_plan::{
    Light, Projection, ShadowSettings, SmoothieBlend, SmoothieSettings, SmoothieWidth, Technique, View, views,
};
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, cpu_trial, float_blending_trial};
use contrejour_tests::lights::{direction, point};
use contrejour_tests::meshes::{TestMesh, shapes};
use contrejour_tests::pipeline::Pipeline;
use contrejour_tests::texture::{read_depth, read_floats, read_half_floats};
use glam::DVec3;
use libtest_mimic::Trial;

/// Step of 16-bit floats, of their size.
const HALF_STEP: f32 = 1.0 / 1024.0;

/// The smallest 16-bit float above zero, 2^-24.
const SMALLEST_HALF: f32 = 1.0 / 16_777_216.0;

/// 32 roundings of numbers below 1, 2^-19: drivers interpolate in ways of their own, SwiftShader with some 18 of them.
const CLIP_Z_ROUNDING: f64 = 1.0 / 524_288.0;

/// 32 roundings of 32-bit floats, of their size.
const Q_ROUNDING: f64 = 1.0 / 262_144.0;

const MAP_SIZE: u32 = 256;

pub fn trials() -> Vec<Trial> {
    vec![
        float_blending_trial("smoothie_ways::one_pass_and_two_leave_the_same_map", one_pass_and_two_leave_the_same_map),
        cpu_trial("smoothie_ways::comparer_finds_planted_faults", comparer_finds_planted_faults),
    ]
}

/// A texel that a smoothie covers.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Covered {
    depth: f32,
    alpha: f32,
}

type Map = Vec<Option<Covered>>;

fn one_pass_and_two_leave_the_same_map(gpu: &Gpu) -> Outcome {
    let shape = |name: &str| shapes().into_iter().find(|mesh| mesh.name == name).ok_or("there is such a shape");
    for mesh in [shape("torus")?, boxes(), bow_tie()] {
        let (middle, radius) = mesh.middle_and_radius();
        let towards_light = DVec3::new(0.4, 1.0, 0.3);
        for light in [
            point(middle + 2.5 * radius * towards_light, middle, radius),
            point(middle + 1.2 * radius * towards_light, middle, radius),
            direction(towards_light, middle, radius),
        ] {
            check(gpu, &mesh, &light).map_err(|difference| format!("{}, {:?}: {difference}", mesh.name, light.kind))?;
        }
    }
    Ok(())
}

/// Two boxes, one above the other.
fn boxes() -> TestMesh {
    let faces = [[0, 2, 1], [1, 2, 3], [4, 5, 6], [5, 7, 6], [0, 1, 4], [1, 5, 4]];
    let others = [[2, 6, 3], [3, 6, 7], [0, 4, 2], [2, 4, 6], [1, 3, 5], [3, 7, 5]];
    let corner = |index: u32| [index & 1, index >> 1 & 1, index >> 2].map(|side| side as f32 - 0.5);
    let lower = (0..8).map(|index| corner(index).map(|side| 2.0 * side));
    let upper = (0..8).map(corner).map(|[x, y, z]| [x, y + 2.0, z]);
    let positions: Vec<_> = lower.chain(upper).collect();
    let of_box = |first: u32| faces.into_iter().chain(others).map(move |face| face.map(|vertex| first + vertex));
    TestMesh::generated("boxes", &positions, &of_box(0).chain(of_box(8)).collect::<Vec<_>>())
}

/// ```text
///    1   3
///    |\ /|
///    | 0 |    over a floor: four outline edges at one vertex
///    |/ \|
///    2   4
/// ```
fn bow_tie() -> TestMesh {
    let tie = [[0.0, 1.0, 0.0], [-1.0, 1.0, -0.6], [-1.0, 1.2, 0.6], [1.0, 1.0, -0.6], [1.0, 0.8, 0.6]];
    let floor = [[-3.0, 0.0, -3.0], [-3.0, 0.0, 3.0], [3.0, 0.0, 3.0], [3.0, 0.0, -3.0]];
    let positions: Vec<_> = tie.into_iter().chain(floor).collect();
    TestMesh::generated("bow-tie", &positions, &[[0, 1, 2], [0, 4, 3], [5, 6, 7], [5, 7, 8]])
}

fn check(gpu: &Gpu, mesh: &TestMesh, light: &Light) -> Outcome {
    let view = views(light).map_err(|error| error.to_string())?[0];
    let in_one = map(gpu, mesh, light, &view, SmoothieBlend::BestOfDevice)?;
    let in_two = map(gpu, mesh, light, &view, SmoothieBlend::TwoPasses)?;
    let covered = in_one.iter().flatten().count();
    if covered < 500 {
        return Err(format!("only {covered} texels are covered"));
    }
    compare(&view, &in_one, &in_two)
}

/// The smoothie buffer as the one way or the other fills it.
fn map(gpu: &Gpu, mesh: &TestMesh, light: &Light, view: &View, blend: SmoothieBlend) -> Result<Map, String> {
    let smoothies = SmoothieSettings { width: SmoothieWidth::Ndc(0.08), blend, ..Default::default() };
    let technique = Technique::Smoothies(smoothies);
    let settings = ShadowSettings { technique, map_size: MAP_SIZE, ..Default::default() };
    let mut pipeline = Pipeline::new(gpu, mesh, &ShadowOptions { settings, ..Default::default() })?;
    pipeline.complete_frame(light)?;
    let maps = pipeline.maps();
    match (blend, maps.smoothie_buffer, maps.smoothie_depth, maps.smoothie_alpha) {
        (SmoothieBlend::BestOfDevice, Some(buffer), None, None) => {
            let texels = read_floats(gpu, buffer);
            let texels = texels.chunks_exact(2).map(|texel| (texel[0], texel[1]));
            Ok(texels.map(|(depth, alpha)| covered(depth < view.far_depth as f32, depth, alpha)).collect())
        }
        (SmoothieBlend::TwoPasses, None, Some(depth), Some(alpha)) => {
            let texels = read_depth(gpu, depth).into_iter().zip(read_half_floats(gpu, alpha));
            Ok(texels.map(|(z, alpha)| covered(z < 1.0, depth_of_clip_z(view, z), alpha)).collect())
        }
        _ => Err(format!("{blend:?} leaves {maps:?}")),
    }
}

fn covered(is_covered: bool, depth: f32, alpha: f32) -> Option<Covered> {
    is_covered.then_some(Covered { depth, alpha })
}

fn depth_of_clip_z(view: &View, z: f32) -> f32 {
    let q = (f64::from(z) - view.ndc_offset()) / view.ndc_scale();
    (match view.projection {
        Projection::Perspective => -1.0 / q,
        Projection::Orthographic => q,
    }) as f32
}

fn allowed_depth_difference(view: &View, depth: f64) -> f64 {
    let depth_per_z = match view.projection {
        Projection::Perspective => depth * depth / view.ndc_scale(),
        Projection::Orthographic => 1.0 / view.ndc_scale(),
    };
    CLIP_Z_ROUNDING * view.ndc_offset().abs().max(1.0) * depth_per_z + Q_ROUNDING * depth
}

fn compare(view: &View, in_one: &Map, in_two: &Map) -> Outcome {
    if in_one.len() != in_two.len() {
        return Err(format!("{} texels in one pass, {} in two", in_one.len(), in_two.len()));
    }
    for (index, (one, two)) in in_one.iter().zip(in_two).enumerate() {
        let is_same = match (one, two) {
            (None, None) => true,
            (Some(one), Some(two)) => {
                let depth_difference = f64::from((one.depth - two.depth).abs());
                (one.alpha - two.alpha).abs() <= HALF_STEP * one.alpha + SMALLEST_HALF
                    && depth_difference <= allowed_depth_difference(view, f64::from(one.depth))
            }
            _ => false,
        };
        if !is_same {
            return Err(format!("texel {index}: {one:?} in one pass, {two:?} in two"));
        }
    }
    Ok(())
}

fn comparer_finds_planted_faults() -> Outcome {
    let view = views(&point(DVec3::Z * 4.0, DVec3::ZERO, 2.0)).map_err(|error| error.to_string())?[0];
    let texel = |index: u16| (index != 0 && index != 3).then(|| Covered { depth: 2.0 + f32::from(index), alpha: 0.25 });
    let good: Map = (0..4).map(texel).collect();
    compare(&view, &good, &good)?;
    let covered = Covered { depth: 3.0, alpha: 0.25 };
    let allowed = allowed_depth_difference(&view, 3.0) as f32;
    let planted = [
        (true, Some(Covered { alpha: 0.250_2, ..covered })),
        (true, Some(Covered { depth: 3.0 + 0.5 * allowed, ..covered })),
        (false, Some(Covered { alpha: 0.250_6, ..covered })),
        (false, Some(Covered { depth: 3.0 + 2.0 * allowed, ..covered })),
        (false, Some(Covered { depth: f32::NAN, ..covered })),
        (false, None),
    ];
    for (is_allowed, planted) in planted {
        let mut other = good.clone();
        other[1] = planted;
        if compare(&view, &good, &other).is_ok() != is_allowed {
            return Err(format!("{planted:?} for {covered:?}: allowed {}", !is_allowed));
        }
    }
    if compare(&view, &good, &good[1..].to_vec()).is_ok() {
        return Err("a missing texel was not found".into());
    }
    Ok(())
}
