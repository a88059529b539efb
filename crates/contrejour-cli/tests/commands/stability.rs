//! `contrejour stability`: what it writes, and what it refuses.

use contrejour_lab::stability::{COLUMNS, FAMILIES};
use libtest_mimic::Trial;

use crate::program::Folder;
use crate::{Outcome, cpu_trial, gpu_trial};

pub fn trials() -> Vec<Trial> {
    vec![
        cpu_trial("stability::what_is_no_family_is_refused", nonsense_is_refused),
        gpu_trial("stability::writes_table_and_page_and_finds_no_fault", table_and_page_are_written),
        gpu_trial("stability::no_family_has_a_fault", no_family_has_a_fault),
        gpu_trial("stability::results_need_a_folder", results_need_a_folder),
    ]
}

fn nonsense_is_refused() -> Outcome {
    let folder = Folder::new();
    folder.refuses("stability magic -o out", &["magic", "scale"])?;
    folder.refuses("stability scale --seed x -o out", &["--seed", "x"])?;
    folder.refuses("stability scale", &["--output", "DIR"])
}

/// Every family, quickly, but for those that are tried above.
fn no_family_has_a_fault() -> Outcome {
    let families = FAMILIES.map(|family| family.name).into_iter();
    let families: Vec<_> = families.filter(|name| !["scale", "distance", "few-faces"].contains(name)).collect();
    let told = Folder::new().run(&format!("stability {} --quick -o out --json", families.join(" "))).json()?;
    if told["families"] != families.len() || told["faulty"] != 0 {
        return Err(format!("a fault, or a family that was not tried: {told}"));
    }
    Ok(())
}

/// Refused in the only line: before a case is tried, not after the last one.
fn results_need_a_folder() -> Outcome {
    Folder::with(&[("taken", "an older file")]).refuses("stability -o taken", &["taken"])
}

/// Among the cases are the largest numbers of the type, a mesh far from the origin, refusals and meshes of no face.
fn table_and_page_are_written() -> Outcome {
    let folder = Folder::new();
    let told = folder.run("stability few-faces scale distance --quick -o out --json").json()?;
    for (name, expected) in [("families", 3), ("sign_errors", 0), ("open_cycles", 0), ("gaps", 0), ("non_finite", 0)] {
        if told[name] != expected {
            return Err(format!("{name} should be {expected}: {told}"));
        }
    }
    let seen = |name: &str| told[name].as_u64().unwrap_or(0);
    if seen("sign_errors_f32") == 0 || seen("degraded") == 0 || seen("rows") < 20 {
        return Err(format!("the bare test should fail somewhere and something be refused: {told}"));
    }

    let table = folder.read("out/stability.csv")?;
    if table.lines().next() != Some(COLUMNS.join(",").as_str()) || table.lines().count() as u64 != 1 + seen("rows") {
        return Err(format!("the table should have {} rows below its columns:\n{table}", seen("rows")));
    }
    // A refusal is a row with empty cells.
    let refused = |line: &str| line.starts_with("scale,\"1e-45, spot\",,,,,,,,,,\"the light's near is");
    if !table.lines().any(refused) {
        return Err(format!("the smallest scale should be refused:\n{table}"));
    }
    let json: serde_json::Value =
        serde_json::from_str(&folder.read("out/stability.json")?).map_err(|error| error.to_string())?;
    if json["families"][0]["name"] != "scale" || json["families"][2]["rows"][0]["family"] != "few-faces" {
        return Err(json.to_string());
    }
    let page = folder.read("out/index.html")?;
    for part in ["<h3>distance</h3>", "Error against run time", "<svg", "in words"] {
        if !page.contains(part) {
            return Err(format!("the page lacks {part}"));
        }
    }
    if folder.names() == ["out"] { Ok(()) } else { Err(format!("other files were left: {:?}", folder.names())) }
}
