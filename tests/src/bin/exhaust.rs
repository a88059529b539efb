//! Holds the silhouettes that the device finds against exact arithmetic, for every mesh of a folder and thousands of
//! lights, and counts the face tests. Exits with 1 on any difference.

use std::path::PathBuf;
use std::process::ExitCode;
use std::time::Instant;

use clap::Parser;
use contrejour_tests::exhaust::{Exhaust, Tally};
use contrejour_tests::gpu::{Gpu, gpu};
use contrejour_tests::many_lights::{adversarial_lights, random_lights};
use contrejour_tests::meshes::{TestMesh, of_folder, shared_folder};
use contrejour_tests::random::Random;

/// Holds the silhouettes of the device against exact arithmetic, mesh by mesh.
#[derive(Parser)]
struct Arguments {
    /// Folder of meshes [default: CONTREJOUR_MESHES, or ../shared/meshes beside the checkout].
    folder: Option<PathBuf>,
    /// Random lights for each mesh.
    #[arg(long, default_value_t = 1000)]
    random: usize,
    /// Lights on faces' planes, edges' lines, vertices and axes for each mesh, half of them a few ulps beside.
    #[arg(long, default_value_t = 1000)]
    adversarial: usize,
    /// Only files whose path has this text.
    #[arg(long)]
    only: Option<String>,
    /// Other lights for another number.
    #[arg(long, default_value_t = 1)]
    seed: u64,
}

fn main() -> ExitCode {
    match run(&Arguments::parse()) {
        Ok(tally) if tally.differences() == 0 => ExitCode::SUCCESS,
        Ok(_) => ExitCode::FAILURE,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

fn run(arguments: &Arguments) -> Result<Tally, String> {
    let folder = arguments.folder.clone().or_else(shared_folder).ok_or("there is no folder of meshes: name one")?;
    let gpu = gpu()?;
    println!("{}", gpu.adapter);
    println!(
        "{:44} {:>8} {:>7} {:>14} {:>12} {:>11} {:>10} {:>11} {:>8}",
        "mesh", "faces", "lights", "face tests", "silhouettes", "differences", "undecided", "bare float", "time"
    );
    let is_wanted = |path: &str| arguments.only.as_deref().is_none_or(|only| path.contains(only));
    let (mut total, mut files, begin) = (Tally::default(), 0, Instant::now());
    for mesh in of_folder(&folder, is_wanted) {
        match mesh {
            Ok(mesh) => {
                total.add(exhaust(gpu, &mesh, arguments).map_err(|error| format!("{}: {error}", mesh.name))?);
                files += 1;
            }
            Err(error) => println!("left out: {error}"),
        }
    }
    print_row(&format!("{files} files"), 0, &total, begin);
    Ok(total)
}

fn exhaust(gpu: &Gpu, mesh: &TestMesh, arguments: &Arguments) -> Result<Tally, String> {
    let begin = Instant::now();
    let mut exhaust = Exhaust::new(gpu, mesh)?;
    let faces = exhaust.faces();
    let mut random = Random::new(arguments.seed);
    let mut lights = random_lights(&faces, arguments.random, &mut random);
    lights.extend(adversarial_lights(&faces, arguments.adversarial, &mut random));
    let tally = exhaust.run(&lights)?;
    print_row(&mesh.name, faces.len(), &tally, begin);
    if let Some(difference) = &tally.first_difference {
        println!("  the first difference: {difference}");
    }
    Ok(tally)
}

fn print_row(name: &str, faces: usize, tally: &Tally, begin: Instant) {
    let faces = if faces == 0 { String::new() } else { faces.to_string() };
    let undecided = 100.0 * tally.undecided as f64 / tally.face_tests.max(1) as f64;
    println!(
        "{name:44} {faces:>8} {:>7} {:>14} {:>12} {:>11} {undecided:>9.4}% {:>11} {:>6.1} s",
        tally.lights,
        tally.face_tests,
        tally.silhouette_edges,
        tally.differences(),
        tally.wrong_by_floats,
        begin.elapsed().as_secs_f64(),
    );
}
