//! `contrejour plan` and `contrejour inspect`, which need no device.

use libtest_mimic::Trial;

use crate::program::Folder;
use crate::{Outcome, cpu_trial};

pub fn trials() -> Vec<Trial> {
    vec![
        cpu_trial("plan::tells_what_a_frame_does_and_leaves_out", plan_tells),
        cpu_trial("inspect::tells_what_a_mesh_is_made_of", inspect_tells),
        cpu_trial("help_and_version_are_no_errors", help_and_version_are_no_errors),
    ]
}

fn expect_all(text: &str, expected: &[&str]) -> Outcome {
    match expected.iter().find(|word| !text.contains(*word)) {
        None => Ok(()),
        Some(word) => Err(format!("{word:?} is missing in:\n{text}")),
    }
}

fn plan_tells() -> Outcome {
    let folder = Folder::new();
    let soft = folder.run("plan boxes").stdout()?;
    expect_all(&soft, &["device: ", "detect_silhouette", "extrude_edges", "shadow_map", "smoothie", "left out"])?;
    let hard = folder.run("plan boxes --technique shadow-map").stdout()?;
    if hard.lines().any(|line| line.trim() == "extrude_edges") {
        return Err(format!("a shadow map needs no smoothies:\n{hard}"));
    }
    let json = folder.run("plan boxes --json").json()?;
    let stages = json["lights"][0]["plan"]["stages"].as_array().map(Vec::len);
    if stages == Some(14) && json.get("device").is_some() {
        Ok(())
    } else {
        Err(format!("{stages:?} stages in {json}"))
    }
}

fn inspect_tells() -> Outcome {
    let folder = Folder::with(&[("open.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 0 0\nv 1 1 0\nf 1 2 3\nf 3 4 5\n")]);
    let text = folder.run("inspect open.obj").stdout()?;
    expect_all(&text, &["open.obj", "faces", "border", "closed", "36 a face; 0.38 of no index, 0.39 of an index"])?;
    let json = folder.run("inspect open.obj --json").json()?;
    let report = &json["meshes"][0]["report"];
    let counts = (&report["faces"], &report["welded_vertices"], &report["border_edges"]["count"]);
    if counts.0 != 2 || counts.1 != 1 || counts.2 != 4 || report["closed"] != false {
        return Err(format!("faces, welded vertices, border edges: {counts:?}"));
    }
    let stream = &json["meshes"][0]["tam_stream"];
    let bytes = ["items", "half_items", "face_records", "half_face_records"].map(|form| stream[form]["bytes"].as_u64());
    let expected = [504, 288, 144, 72].map(Some);
    if bytes == expected { Ok(()) } else { Err(format!("bytes of the streams: {bytes:?}, not {expected:?}")) }
}

fn help_and_version_are_no_errors() -> Outcome {
    let folder = Folder::new();
    expect_all(&folder.run("--help").stdout()?, &["render", "silhouette", "inspect", "plan", "report"])?;
    expect_all(&folder.run("silhouette --help").stdout()?, &["--point", "--direction", "--format"])?;
    expect_all(&folder.run("--version").stdout()?, &[env!("CARGO_PKG_VERSION")])
}
