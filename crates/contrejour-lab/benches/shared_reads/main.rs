//! Whether to read a face or an edge once for several lights: against a dispatch a light, as the stages do.
//!
//! `cargo bench -p contrejour-lab --bench shared_reads [-- ROUNDS]`
//!
//! A mesh, and beside it a small mirrored one, cast for all lights, so nothing is culled for one and not for another: the
//! best case of a shared read. It makes the same facing and finds the same silhouettes as the stages, or the bench ends;
//! that this check sees a fault is tried first. Times are from submission to completion, less that of an empty submission;
//! all take turns, and the least of each are compared. Software devices compute on this process's threads: there it is the
//! time that these ran, on all cores together.

mod kernel;
mod run;
mod scene;
mod shared_wgsl;

use std::time::Duration;

use contrejour_gpu::stages::{ALL, ComputeStage};
use contrejour_lab::torus;
use contrejour_plan::Stage;
use contrejour_render::Gpu;

use kernel::Kernel;
use run::{Reads, Run};
use scene::Scene;
use shared_wgsl::{classify_faces, detect_silhouette};

/// Most lights of a shared read: a bit of a byte for each.
const MAX_LIGHTS: usize = 8;

/// How many lights are tried.
const LIGHT_COUNTS: [usize; 4] = [1, 2, 4, MAX_LIGHTS];

fn main() {
    // cargo passes `--bench` as well.
    let rounds = std::env::args().skip(1).find_map(|argument| argument.parse().ok()).unwrap_or(15);
    let gpu = Gpu::open().expect("a device can be opened");
    println!("{}, {rounds} rounds", gpu.description());
    find_planted_faults(&gpu);
    println!("{:>9} {:>7}  {:<18} {:>18} {:>16}", "faces", "lights", "", "ns a light, apart", "shared / apart");
    for (around, across) in [(100, 100), (400, 250), (1000, 500)] {
        let mesh = torus(around, across);
        let [apart, shared] = measure(&gpu, &Scene::new(&gpu, &mesh), rounds);
        for map_size in [256, 1024] {
            let frame = scene::frame_time(&gpu, &mesh, map_size).as_secs_f64();
            println!(
                "{:>27}a frame of {MAX_LIGHTS} lights with maps of {map_size}: {:.0} ms, both stages {:.1} %, would save {:.1} %",
                "",
                1e3 * frame,
                100.0 * apart / frame,
                100.0 * (apart - shared) / frame,
            );
        }
    }
    gpu.check().expect("the device reports no error");
}

/// A stage, and what does its work for several lights at once.
struct Contest {
    stage: ComputeStage,
    apart: Kernel,
    /// One for each of [`LIGHT_COUNTS`].
    shared: Vec<Kernel>,
}

impl Contest {
    fn new(gpu: &Gpu, stage: Stage, shared: fn(&str, usize) -> String) -> Self {
        let stage = *ALL.iter().find(|known| known.stage == stage).expect("it is a stage");
        let of_lights = |lights: &usize| Kernel::new(gpu, &stage, &shared(stage.wgsl, *lights));
        let shared = LIGHT_COUNTS.iter().map(of_lights).collect();
        Self { stage, apart: Kernel::new(gpu, &stage, stage.wgsl), shared }
    }

    /// Both ways for each number of lights.
    fn runs<'a>(&'a self, gpu: &Gpu, scene: &'a Scene) -> Vec<[Run<'a>; 2]> {
        let of_lights = |(lights, shared): (usize, &'a Kernel)| {
            [
                Run::new(gpu, scene, &self.stage, &self.apart, (lights, Reads::Apart)),
                Run::new(gpu, scene, &self.stage, shared, (lights, Reads::Shared)),
            ]
        };
        LIGHT_COUNTS.into_iter().zip(&self.shared).map(of_lights).collect()
    }
}

fn contests(gpu: &Gpu) -> [Contest; 2] {
    [
        Contest::new(gpu, Stage::ClassifyFaces, classify_faces),
        Contest::new(gpu, Stage::DetectSilhouette, detect_silhouette),
    ]
}

/// Times of both stages together for the most lights, apart and shared. Unit: seconds.
fn measure(gpu: &Gpu, scene: &Scene, rounds: usize) -> [f64; 2] {
    let mut of_most = [0.0; 2];
    for contest in contests(gpu) {
        let name = contest.stage.stage.name();
        let runs = contest.runs(gpu, scene);
        for ([apart, shared], lights) in runs.iter().zip(LIGHT_COUNTS) {
            assert!(apart.found(gpu) == shared.found(gpu), "{name} of {lights} lights finds something else");
        }
        let mut times = vec![[const { Vec::new() }; 3]; runs.len()];
        for _ in 0..rounds {
            for ([apart, shared], times) in runs.iter().zip(&mut times) {
                times[0].push(apart.time(gpu));
                times[1].push(shared.time(gpu));
                times[2].push(kernel::time(gpu, |_| ()));
            }
        }
        for (times, lights) in times.into_iter().zip(LIGHT_COUNTS) {
            let [apart, shared, empty] = times.map(least);
            let [apart, shared] = [apart - empty, shared - empty];
            if lights == MAX_LIGHTS {
                of_most = [of_most[0] + apart, of_most[1] + shared];
            }
            println!(
                "{:>9} {lights:>7}  {name:<18} {:>18.1} {:>16.2}",
                scene.face_count,
                1e9 * apart / (lights * scene.face_count) as f64,
                shared / apart,
            );
        }
    }
    of_most
}

fn least(times: Vec<Duration>) -> f64 {
    times.into_iter().min().unwrap_or_default().as_secs_f64()
}

/// The check of the shared reads must fail where they are wrong.
fn find_planted_faults(gpu: &Gpu) {
    let scene = Scene::new(gpu, &torus(40, 30));
    for contest in contests(gpu) {
        let (write, piece, fault) = match contest.stage.stage {
            Stage::ClassifyFaces => (classify_faces as fn(&str, usize) -> String, "plane, light_5", "plane, light_4"),
            _ => (detect_silhouette as fn(&str, usize) -> String, "& ~right", "& right"),
        };
        let wgsl = write(contest.stage.wgsl, MAX_LIGHTS);
        assert!(wgsl.contains(piece), "there is no {piece} to be wrong");
        let faulty = Kernel::new(gpu, &contest.stage, &wgsl.replace(piece, fault));
        let found = |kernel, reads| Run::new(gpu, &scene, &contest.stage, kernel, (MAX_LIGHTS, reads)).found(gpu);
        let [expected, wrong] = [found(&contest.apart, Reads::Apart), found(&faulty, Reads::Shared)];
        assert!(wrong != expected, "a fault in {} is not seen", contest.stage.stage.name());
        assert!(expected.iter().all(|light| !light.words.is_empty()), "there is something to compare");
        assert!(expected.iter().any(|light| !light.listed.is_empty()), "something is listed");
    }
}
