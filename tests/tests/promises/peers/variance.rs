//! Variance shadow maps, held against percentage-closer filtering with their own blur.

use contrejour_plan::{Light, LightKind, ShadowSettings, View, views};
use contrejour_render::read_texture;
use contrejour_tests::harness::Outcome;
use glam::{DVec2, DVec3};

use super::judged_scene::{Care, JudgedScene, falls_to, plates, rmse, settings, text_of};

const MAP_SIZE: u32 = 512;
const BLUR_TEXELS: f64 = 6.0;

/// Where plates overlap, plain moments let light bleed; the stronger the warp, the nearer to percentage-closer filtering.
pub fn strong_warps_are_pcf() -> Outcome {
    let mut scene = plates(&[("[1.2, 1.2]", "[-0.2, 0.8, 0]"), ("[1.0, 1.0]", "[0.3, 2.2, 0.2]")])?;
    scene.keep_floor();
    let exponents = [1.0, 2.0, 5.0, 10.0];
    falls_to(0.003, &warp_errors(&scene, exponents)?)?;
    let mut planted = exponents;
    planted.reverse();
    if falls_to(0.003, &warp_errors(&scene, planted)?).is_err() { Ok(()) } else { Err("weaker warps pass".into()) }
}

/// Chebyshev's bound is exact for two depths, so under one plate plain moments are percentage-closer filtering.
pub fn two_depths_need_no_warp() -> Outcome {
    let mut scene = plates(&[("[1.4, 1.2]", "[0.1, 1.6, 0]")])?;
    scene.keep_floor();
    let error = |blur: f64| {
        let plain =
            settings("vsm", &[("blur_texels", BLUR_TEXELS), ("bleed_cut", 0.0), ("min_variance", 0.0)], MAP_SIZE);
        error_to_pcf(&scene, &plain, blur)
    };
    falls_to(0.01, &[error(BLUR_TEXELS)?])?;
    // Held against a kernel twice as wide, it is wrong.
    if falls_to(0.01, &[error(2.0 * BLUR_TEXELS)?]).is_err() { Ok(()) } else { Err("any kernel passes".into()) }
}

/// Under one plate the blockers have one depth, so moments blurred as wide as its penumbra come near the truth, as far as
/// a blur of triangles is a disk.
pub fn soft_shadows_are_near_the_truth() -> Outcome {
    let mut scene = plates(&[("[1.4, 1.2]", "[0.1, 1.6, 0]")])?;
    scene.keep_floor();
    let truth = scene.truth(scene.light(), Care::Fine)?;
    let of_other_light = |factor: f64| scene.truth(&with_radius(scene.light(), factor)?, Care::Fine);
    let of_other_lights = [of_other_light(0.5)?, of_other_light(2.0)?];
    for technique in ["vsm-pcss", "evsm-pcss"] {
        let found = scene.visibility(&settings(technique, &[("bleed_cut", 0.0), ("min_variance", 0.0)], MAP_SIZE))?;
        falls_to(0.013, &[rmse(&found, &truth)]).map_err(|error| format!("{technique}: {error}"))?;
        for other in &of_other_lights {
            if falls_to(0.013, &[rmse(&found, other)]).is_ok() {
                return Err(format!("{technique}: another light's truth passes"));
            }
        }
    }
    Ok(())
}

fn with_radius(light: &Light, factor: f64) -> Result<Light, String> {
    let mut other = *light;
    let LightKind::Spot { radius, .. } = &mut other.kind else { return Err("the light is a spot".into()) };
    *radius *= factor;
    Ok(other)
}

fn warp_errors(scene: &JudgedScene, exponents: [f64; 4]) -> Result<Vec<f64>, String> {
    let error = |exponent: f64| {
        let parameters =
            [("blur_texels", BLUR_TEXELS), ("bleed_cut", 0.0), ("min_variance", 0.0), ("warp_exponent", exponent)];
        error_to_pcf(scene, &settings("evsm", &parameters, MAP_SIZE), BLUR_TEXELS)
    };
    exponents.into_iter().map(error).collect()
}

/// How far a technique is from percentage-closer filtering with the kernel of the blur.
fn error_to_pcf(scene: &JudgedScene, variance: &ShadowSettings, blur_texels: f64) -> Result<f64, String> {
    let (found, contestant) = scene.drawn(variance)?;
    let map = contestant.maps().shadow_depth.ok_or("moments are made from linear depth")?;
    let depths: Vec<f32> = bytemuck::pod_collect_to_vec(&read_texture(scene.gpu(), map, 4).map_err(text_of)?);

    // The floor is the farthest depth of all: a texel that is clearly nearer blocks all of it.
    let empty = depths.iter().copied().fold(0.0, f32::max);
    let floor = depths.iter().copied().filter(|depth| *depth < empty).fold(0.0, f32::max);
    let seen: Vec<f64> = depths.iter().map(|depth| if *depth < 0.98 * floor { 0.0 } else { 1.0 }).collect();
    let pyramid = Pyramid::new(seen, MAP_SIZE as usize);
    let view = views(scene.light()).map_err(text_of)?[0];
    let level = (blur_texels / LEVEL_RADIUS).log2().max(0.0);
    let wanted: Vec<f64> =
        scene.receivers().map(|receiver| pyramid.sample(texel(&view, receiver.position), level)).collect();
    Ok(rmse(&found, &wanted))
}

/// Radius of the disk that level 0 spreads like, as `shaders/shared/moments.wgsl` derives it.
const LEVEL_RADIUS: f64 = 1.29;

/// Where a point of the world falls on the map, 0 to 1, from the top left.
fn texel(view: &View, position_world: DVec3) -> DVec2 {
    let ndc = view.light_clip_from_world.project_point3(position_world);
    DVec2::new(0.5 + 0.5 * ndc.x, 0.5 - 0.5 * ndc.y)
}

/// Levels of a picture, each blurred with weights 1 3 3 1 and halved.
struct Pyramid {
    levels: Vec<(Vec<f64>, usize)>,
}

impl Pyramid {
    fn new(values: Vec<f64>, size: usize) -> Self {
        let mut levels = vec![(values, size)];
        while let Some((finer, finer_size)) = levels.last().filter(|(_, size)| *size > 1) {
            let size = finer_size / 2;
            let at = |x: i64, y: i64| {
                let inside = |place: i64| place.clamp(0, *finer_size as i64 - 1) as usize;
                finer[inside(y) * finer_size + inside(x)]
            };
            let mut coarser = Vec::with_capacity(size * size);
            for (y, x) in (0..size as i64).flat_map(|y| (0..size as i64).map(move |x| (y, x))) {
                let weights = [1.0, 3.0, 3.0, 1.0];
                let terms = (0..4).flat_map(|row| (0..4).map(move |column| (row, column))).map(|(row, column)| {
                    weights[row] * weights[column] * at(2 * x - 1 + column as i64, 2 * y - 1 + row as i64)
                });
                coarser.push(terms.sum::<f64>() / 64.0);
            }
            levels.push((coarser, size));
        }
        Self { levels }
    }

    /// Between texels and between levels.
    fn sample(&self, uv: DVec2, level: f64) -> f64 {
        let lower = (level as usize).min(self.levels.len() - 1);
        let upper = (lower + 1).min(self.levels.len() - 1);
        let share = level.fract();
        (1.0 - share) * self.bilinear(uv, lower) + share * self.bilinear(uv, upper)
    }

    fn bilinear(&self, uv: DVec2, level: usize) -> f64 {
        let (values, size) = &self.levels[level];
        let texel = uv * *size as f64 - 0.5;
        let corner = texel.floor();
        let at = |x: f64, y: f64| {
            let inside = |place: f64| place.clamp(0.0, *size as f64 - 1.0) as usize;
            values[inside(corner.y + y) * size + inside(corner.x + x)]
        };
        let weight = texel - corner;
        let row = |y: f64| (1.0 - weight.x) * at(0.0, y) + weight.x * at(1.0, y);
        (1.0 - weight.y) * row(0.0) + weight.y * row(1.0)
    }
}
