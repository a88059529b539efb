//! `contrejour stress`: what it tells, what it writes, and what it refuses.

use std::collections::BTreeSet;
use std::ops::RangeFrom;

use libtest_mimic::Trial;

use crate::program::Folder;
use crate::{Outcome, cpu_trial, gpu_trial};

pub fn trials() -> Vec<Trial> {
    vec![
        cpu_trial("stress::what_makes_no_sense_is_refused", nonsense_is_refused),
        gpu_trial("stress::verifies_lights_and_casters_of_all_kinds", verifies_all_kinds),
        gpu_trial("stress::mixed_lights_have_settings_of_their_own", mixed_lights_differ),
        gpu_trial("stress::where_nothing_moves_nothing_is_drawn", stillness_costs_nothing),
        gpu_trial("stress::a_sweep_writes_a_table_and_a_plot", a_sweep_is_written),
    ]
}

const SMALL: &str = "--casters 5 --triangles-per-caster 150 --map-size 64 --seconds 0.1";

/// The keys that scripts rely on.
const KEYS: [&str; 20] = [
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
    "verified_texels",
    "differences",
    "light_settings",
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
    for (kind, views) in [("mixed", 8), ("point", 18), ("spot", 3), ("directional", 5)] {
        for technique in ["smoothies", "pcf"] {
            let line = format!("stress --lights 3 --kind {kind} --technique {technique} {SMALL} --verify --json");
            let told = Folder::new().run(&line).json()?;
            let missing: Vec<_> = KEYS.iter().filter(|key| told.get(**key).is_none()).collect();
            let [light_frames, texels] = ["verified_light_frames", "verified_texels"].map(|key| told[key].as_u64());
            let is_verified = light_frames >= Some(3) && texels >= Some(9216) && told["differences"] == 0;
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

/// Six lights are of all kinds; what is given holds for all, and sweeps give all the same.
fn mixed_lights_differ() -> Outcome {
    let few = "--casters 4 --triangles-per-caster 60 --seconds 0.01 --json";
    let kinds = ["spot", "point", "directional", "spot", "point", "cascaded"];
    for (line, techniques, sizes) in [
        ("--lights 6 --verify", 3.., 2..),
        ("--lights 6 --map-size 32", 3.., 1..),
        ("--lights 6 --technique pcf", 1.., 2..),
        ("--lights 6 --width 0.1 --map-size 32", 1.., 1..),
        ("--lights 6 --preset low", 1.., 1..),
    ] {
        let told = Folder::new().run(&format!("stress {line} {few}")).json()?;
        let lights = told["light_settings"].as_array().ok_or("lights are told")?;
        let different = |key: &str| lights.iter().map(|light| light[key].to_string()).collect::<BTreeSet<_>>().len();
        // One is told as such; where there are several any number of them is.
        let holds =
            |range: RangeFrom<usize>, count: usize| if range.start == 1 { count == 1 } else { range.contains(&count) };
        let is_mixed = holds(techniques, different("technique")) && holds(sizes, different("map_size"));
        let are_kinds = lights.iter().map(|light| &light["kind"]).eq(kinds);
        if !is_mixed || !are_kinds || different("color") != 6 || different("softness") < 2 || told["differences"] != 0 {
            return Err(format!("{line}: {told}"));
        }
    }
    let folder = Folder::new();
    let told = folder.run(&format!("stress --sweep lights --map-size 32 {few}")).json()?;
    let first = &told[5]["light_settings"][0];
    let are_same = told[5]["light_settings"].as_array().is_some_and(|lights| {
        lights.iter().all(|light| ["technique", "map_size", "softness"].iter().all(|key| light[key] == first[key]))
    });
    if are_same { Ok(()) } else { Err(told[5].to_string()) }
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
