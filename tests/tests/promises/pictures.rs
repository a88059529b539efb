//! The built-in scenes look as their goldens in `assets/goldens`, which `CONTREJOUR_BLESS=1` writes.

use contrejour_plan::{AlphaRemap, ShadowSettings, SmoothieSettings, SmoothieWidth, Technique};
use contrejour_render::Renderer;
use contrejour_scene::{BUILT_IN_SCENES, BuiltInScene};
use contrejour_tests::gpu::{Equipment, render_gpu};
use contrejour_tests::harness::{Outcome, cpu_trial, gpu_trial};
use contrejour_tests::image_compare::{ImageTolerance, check_golden, compare_images, goldens};
use image::RgbaImage;
use libtest_mimic::Trial;

/// Small, so that goldens are small files and software drivers draw them at once.
const SIZE: [u32; 2] = [320, 200];

const MAP_SIZE: u32 = 512;

/// What another driver may do to a picture. It may place the samples of a pixel elsewhere, which moves a pixel on an
/// edge by a sample or two of four; and it may round a texel of the shadow map to the other side of an edge, which
/// shows on the few pixels that this texel covers, by at most the contrast of shadow and light (about 100). So a single
/// pixel may be far off. All pixels together may not: edges of meshes and shadows are some 3 % of these pixels, and a
/// fault that one can see, such as a bias or a width that is a quarter off, moves the mean by more than this.
const TOLERANCE: ImageTolerance = ImageTolerance { mean: 0.25, max: 110 };

pub fn trials() -> Vec<Trial> {
    let trial = |scene: &'static BuiltInScene| {
        gpu_trial(format!("pictures::{}", scene.name), move |_| {
            let picture = picture(scene, |_| {})?;
            check_golden(scene.name, &picture, TOLERANCE)
        })
    };
    let mut trials: Vec<_> = BUILT_IN_SCENES.iter().map(trial).collect();
    trials.push(gpu_trial("pictures::comparer_finds_planted_faults", |_| comparer_finds_planted_faults()));
    trials.push(cpu_trial("pictures::every_golden_is_a_scene", every_golden_is_a_scene));
    trials
}

fn picture(scene: &BuiltInScene, change: impl Fn(&mut ShadowSettings)) -> Result<RgbaImage, String> {
    picture_on(Equipment::Baseline, scene, change)
}

fn picture_on(
    equipment: Equipment,
    scene: &BuiltInScene,
    change: impl Fn(&mut ShadowSettings),
) -> Result<RgbaImage, String> {
    let mut scene = scene.load().map_err(|error| error.to_string())?;
    scene.resize(SIZE);
    for light in &mut scene.lights {
        light.shadow.map_size = MAP_SIZE;
        change(&mut light.shadow);
    }
    let mut renderer = Renderer::new(render_gpu(equipment)?, &scene).map_err(|error| error.to_string())?;
    renderer.draw_complete().map_err(|error| error.to_string())?;
    renderer.picture().map_err(|error| error.to_string())
}

fn every_golden_is_a_scene() -> Outcome {
    let folder = goldens();
    let entries = std::fs::read_dir(&folder).map_err(|error| format!("{}: {error}", folder.display()))?;
    for entry in entries {
        let path = entry.map_err(|error| error.to_string())?.path();
        if !BUILT_IN_SCENES.iter().any(|scene| path.file_name() == Some(format!("{}.png", scene.name).as_ref())) {
            return Err(format!("{} belongs to no built-in scene; remove it", path.display()));
        }
    }
    Ok(())
}

/// Pictures that are wrong as a whole are refused; one that a device with more features draws is not.
fn comparer_finds_planted_faults() -> Outcome {
    let scene = BUILT_IN_SCENES.iter().find(|scene| scene.name == "cylinder").ok_or("there is such a scene")?;
    let with = |change: fn(&mut SmoothieSettings)| {
        picture(scene, |settings| {
            if let Technique::Smoothies(smoothies) = &mut settings.technique {
                change(smoothies);
            }
        })
    };
    let good = picture(scene, |_| {})?;
    compare_images("the same", &good, &picture(scene, |_| {})?, TOLERANCE)?;
    compare_images("the best equipment", &good, &picture_on(Equipment::Best, scene, |_| {})?, TOLERANCE)?;
    let faulty = [
        ("hard shadows", picture(scene, |settings| settings.technique = Technique::ShadowMap)?),
        ("no remap", with(|smoothies| smoothies.remap = AlphaRemap::Off)?),
        ("wide smoothies", with(|smoothies| smoothies.width = SmoothieWidth::Ndc(0.2))?),
        ("a coarse map", picture(scene, |settings| settings.map_size = MAP_SIZE / 8)?),
        ("a large bias", picture(scene, |settings| settings.bias.constant_texels = 60.0)?),
    ];
    let passing: Vec<_> = faulty
        .iter()
        .filter(|(name, faulty)| compare_images(name, &good, faulty, TOLERANCE).is_ok())
        .map(|(name, _)| name)
        .collect();
    if passing.is_empty() { Ok(()) } else { Err(format!("{passing:?} pass")) }
}
