//! On the built-in scenes too the silhouette maps of all sources are as defined, under eight lights each: the scene's own
//! on their way around it, all views of those of points.

use contrejour_scene::{BUILT_IN_SCENES, BuiltInScene, orbit};
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::meshes::TestMesh;
use libtest_mimic::Trial;

use crate::silhouette_maps::compare_sources;

const MAP_SIZE: u32 = 256;

const LIGHTS: u32 = 8;

pub fn trials() -> Vec<Trial> {
    let trial = |scene: &'static BuiltInScene| {
        gpu_trial(format!("silhouette_scenes::as_defined_from_all_sources::{}", scene.name), move |gpu| {
            as_defined_from_all_sources(gpu, scene)
        })
    };
    BUILT_IN_SCENES.iter().map(trial).collect()
}

fn as_defined_from_all_sources(gpu: &Gpu, built_in: &BuiltInScene) -> Outcome {
    let scene = built_in.load().map_err(|error| error.to_string())?;
    let shining = scene.lights.iter().cycle().zip(0..LIGHTS);
    let lights = shining.map(|(light, frame)| orbit(&light.light, frame, LIGHTS));
    let counts = compare_sources(gpu, &TestMesh::of_scene(built_in.name, &scene), lights, MAP_SIZE)?;
    if counts.iter().all(|counts| counts.has_certain() && !counts.explains_too_much()) {
        return Ok(());
    }
    Err(format!("too many texels are explained, or all are open: {counts:?}"))
}
