//! `contrejour stress`: what it tells, what it writes, and what it refuses.

use libtest_mimic::Trial;

use crate::program::Folder;
use crate::{Outcome, cpu_trial, gpu_trial};

pub fn trials() -> Vec<Trial> {
    vec![
        cpu_trial("stress::what_makes_no_sense_is_refused", nonsense_is_refused),
        gpu_trial("stress::verifies_lights_and_casters_of_all_kinds", verifies_all_kinds),
        gpu_trial("stress::where_nothing_moves_nothing_is_drawn", stillness_costs_nothing),
        gpu_trial("stress::a_sweep_writes_a_table_and_a_plot", a_sweep_is_written),
    ]
}

const SMALL: &str = "--casters 5 --triangles-per-caster 150 --map-size 64 --seconds 0.1";

/// The keys that scripts rely on.
const KEYS: [&str; 18] = [
    "frames",
    "cpu_ms_per_frame",
    "cpu_record_ms",
    "cpu_upload_ms",
    "cpu_submit_ms",
    "upload_bytes_per_frame",
    "draws_recorded",
    "dispatches_recorded",
    "stages",
    "faces_tested",
    "edges_tested",
    "silhouette_edges",
    "lights_redone",
    "lights_kept",
    "memory_bytes",
    "overflow_frames",
    "verified_light_frames",
    "differences",
];

fn nonsense_is_refused() -> Outcome {
    let folder = Folder::new();
    folder.refuses("stress --kind sun", &["sun", "directional"])?;
    folder.refuses("stress --seconds 0", &["--seconds"])?;
    folder.refuses("stress --triangles-per-caster 3", &["3", "triangles"])?;
    folder.refuses("stress --casters 99999999999", &["99999999999", "casters", "65536"])?;
    folder.refuses("stress --lights 1025", &["1025", "lights", "1024"])?;
    folder.refuses("stress --sweep maps", &["maps", "casters"])?;
    Folder::with(&[("taken", "an older file")]).refuses("stress --sweep lights -o taken", &["taken"])
}

fn verifies_all_kinds() -> Outcome {
    for (kind, views) in [("mixed", 8), ("point", 18), ("spot", 3), ("directional", 3)] {
        for technique in ["smoothies", "pcf"] {
            let line = format!("stress --lights 3 --kind {kind} --technique {technique} {SMALL} --verify --json");
            let told = Folder::new().run(&line).json()?;
            let missing: Vec<_> = KEYS.iter().filter(|key| told.get(**key).is_none()).collect();
            let is_verified = told["verified_light_frames"].as_u64() >= Some(3) && told["differences"] == 0;
            if !missing.is_empty() || !is_verified || told["views"] != views {
                return Err(format!("{kind}, {technique}: no {missing:?} in {told}"));
            }
            let has_edges = told["silhouette_edges"].as_u64() > Some(0);
            if has_edges != (technique == "smoothies") {
                return Err(format!("{kind}, {technique}: silhouettes where none are needed, or none: {told}"));
            }
        }
    }
    Ok(())
}

/// Lights that see no change keep the maps of the first frame, which was drawn before the count begins.
fn stillness_costs_nothing() -> Outcome {
    for (line, drawn) in [("--still", 0), ("", 3)] {
        let told =
            Folder::new().run(&format!("stress --lights 1 --kind spot {SMALL} {line} --verify --json")).json()?;
        let frames = told["frames"].as_u64().ok_or("frames are counted")?;
        let [redone, kept] = if drawn == 0 { [0, frames] } else { [frames, 0] };
        let is_as_told = told["lights_redone"] == redone && told["lights_kept"] == kept && told["differences"] == 0;
        if !is_as_told || told["draws_recorded"] != drawn || (told["upload_bytes_per_frame"] == 0) != (drawn == 0) {
            return Err(format!("{line:?}: {told}"));
        }
    }
    Ok(())
}

fn a_sweep_is_written() -> Outcome {
    let folder = Folder::new();
    let line = "stress --sweep lights --casters 2 --triangles-per-caster 60 --map-size 32 --seconds 0.01 -o out --json";
    let told = folder.run(line).json()?;
    let table = folder.read("out/stress-lights.csv")?;
    let plot = folder.read("out/stress-lights.svg")?;
    if told.as_array().map(Vec::len) == Some(6) && table.lines().count() == 7 && plot.contains("<svg") {
        return Ok(());
    }
    Err(format!("{table}\n{told}"))
}
