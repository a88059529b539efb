//! What it saves to read a face or an edge once for several lights: the library's stages for all lights of a scene together,
//! against the same for each light alone.
//!
//! `cargo bench -p contrejour-lab --bench shared_reads [-- ROUNDS]`
//!
//! A mesh, and beside it a small mirrored one, cast for all lights, so nothing is culled for one and not for another: the
//! best case of a shared read. Both ways find the same silhouettes, or the bench ends; that this check sees a fault is tried
//! first. Times are from submission to completion, less that of an empty submission, stage by stage; both ways take turns,
//! and the least of each are compared. Software devices compute on this process's threads: there it is the time that these
//! ran, on all cores together. The time to record a frame is that of the clock.

mod scene;
mod split;

use std::collections::BTreeMap;

use contrejour_gpu::ShadowOptions;
use contrejour_lab::torus;
use contrejour_layout::SilhouetteEdge;
use contrejour_plan::{ShadowSettings, Stage};
use contrejour_render::Gpu;

use scene::{Scene, lights};

/// How many lights are tried.
const LIGHT_COUNTS: [usize; 4] = [1, 2, 4, 8];

/// Segments of the meshes that are tried.
const MESHES: [(u32, u32); 4] = [(25, 20), (100, 100), (400, 250), (1000, 500)];

/// What is timed beside the stages and the passes.
const RECORDING: &str = "recording";

/// Seconds by what took them.
type Times = BTreeMap<&'static str, f64>;

fn main() {
    // cargo passes `--bench` as well.
    let rounds = std::env::args().skip(1).find_map(|argument| argument.parse().ok()).unwrap_or(9);
    let gpu = Gpu::open().expect("a device can be opened");
    println!("{}, {rounds} rounds", gpu.description());
    find_planted_fault(&gpu);
    println!(
        "{:>9} {:>7} {:>8}  {:<18} {:>11} {:>17}",
        "faces", "lights", "at once", "", "apart, ms", "together / apart"
    );
    for mesh in MESHES {
        for light_count in LIGHT_COUNTS {
            measure(&gpu, mesh, light_count, rounds);
        }
    }
    gpu.check().expect("the device reports no error");
}

fn measure(gpu: &Gpu, (around, across): (u32, u32), light_count: usize, rounds: usize) {
    let mesh = torus(around, across);
    let lights = &lights(&mesh)[..light_count];
    let settings = ShadowSettings { map_size: 256, ..ShadowSettings::default() };
    let options = ShadowOptions { settings, ..ShadowOptions::default() };
    let mut together = [Scene::new(gpu, &mesh, lights, &options)];
    let mut apart: Vec<_> = lights.iter().map(|light| Scene::new(gpu, &mesh, &[*light], &options)).collect();
    assert!(
        silhouettes(gpu, &mut together) == silhouettes(gpu, &mut apart),
        "{light_count} lights find something else"
    );

    let at_once = together[0].seats();
    let mut least = [Times::new(), Times::new()];
    for _ in 0..rounds {
        for (scenes, least) in [&mut together[..], &mut apart[..]].into_iter().zip(&mut least) {
            for (what, seconds) in times(gpu, scenes) {
                least.entry(what).and_modify(|known| *known = known.min(seconds)).or_insert(seconds);
            }
        }
    }
    let named = [Stage::ClassifyFaces, Stage::DetectSilhouette].map(Stage::name);
    let tests: Vec<_> = Stage::UP_TO_SILHOUETTES.iter().map(|stage| stage.name()).collect();
    let frame: Vec<_> = least[1].keys().copied().filter(|what| *what != RECORDING).collect();
    let rows = [
        (named[0], vec![named[0]]),
        (named[1], vec![named[1]]),
        ("all tests", tests),
        ("a frame", frame),
        ("recording it", vec![RECORDING]),
    ];
    for (row, parts) in rows {
        let [together, apart] =
            least.each_ref().map(|least| parts.iter().filter_map(|part| least.get(part)).sum::<f64>());
        println!(
            "{:>9} {light_count:>7} {:>8}  {row:<18} {:>11.3} {:>17.2}",
            mesh.triangles.len(),
            at_once.min(light_count),
            1e3 * apart,
            together / apart,
        );
    }
}

/// What all scenes together take, part by part.
fn times(gpu: &Gpu, scenes: &mut [Scene]) -> Times {
    let mut times = Times::new();
    for (what, seconds) in scenes.iter_mut().flat_map(|scene| scene.times(gpu)) {
        *times.entry(what).or_default() += seconds;
    }
    times
}

/// Those of all views, sorted.
fn silhouettes(gpu: &Gpu, scenes: &mut [Scene]) -> Vec<Vec<SilhouetteEdge>> {
    scenes.iter_mut().flat_map(|scene| scene.silhouettes(gpu)).collect()
}

/// The check must fail where a light finds what another one does.
fn find_planted_fault(gpu: &Gpu) {
    let mesh = torus(40, 30);
    let mut lights = lights(&mesh);
    let options = ShadowOptions::default();
    let found = |lights: &[_]| silhouettes(gpu, &mut [Scene::new(gpu, &mesh, lights, &options)]);
    let sound = found(&lights);
    assert!(sound.iter().all(|silhouette| !silhouette.is_empty()), "there is something to compare");
    lights.swap(5, 6);
    assert!(found(&lights) != sound, "exchanged lights are not seen");
}
