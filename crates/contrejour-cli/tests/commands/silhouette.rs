//! `contrejour silhouette`.

use std::fs;

use libtest_mimic::Trial;

use crate::program::{Folder, asset};
use crate::xml::check_well_formed;
use crate::{Outcome, cpu_trial, gpu_trial};

const FACE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// ```text
///    4---3
///    |  /|     a third face, 1 3 5, stands on the edge that the square's two faces share
///    | / |
///    |/  |
///    1---2
/// ```
const SHEETS: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0.5 0.5 1\nf 1 2 3 4\nf 1 3 5\n";

const LIGHTS: [&str; 8] = [
    "--point 0.2,0.3,5",
    "--point -4,-2.5,-3e0",
    "--point=-1e3,2,-1",
    "--point 0,0,0",
    "--point 2,2,0",
    "--direction 0,1,0",
    "--direction -0.3,-1,0.25",
    "--direction=-1e-3,0,0",
];

/// So many separate tetrahedra, which have more silhouette edges than a list for a mesh of as many faces begins with.
fn tetrahedra(count: u32) -> String {
    let tetrahedron = |index: u32| {
        let [x, y] = [index % 50, index / 50].map(f64::from);
        let [a, b, c, d] = [1, 2, 3, 4].map(|corner| 4 * index + corner);
        let (right, back) = (x + 0.5, y + 0.5);
        let corners = format!("v {x} {y} 0\nv {right} {y} 0\nv {x} {back} 0\nv {x} {y} 0.5\n");
        corners + &format!("f {a} {c} {b}\nf {a} {b} {d}\nf {a} {d} {c}\nf {b} {c} {d}\n")
    };
    (0..count).map(tetrahedron).collect()
}

pub fn trials() -> Vec<Trial> {
    vec![
        cpu_trial("silhouette::a_face_has_its_three_edges", a_face_has_its_three_edges),
        cpu_trial("silhouette::every_format_tells_the_same_edges", every_format_tells_the_same_edges),
        gpu_trial("silhouette::gpu_and_cpu_print_the_same", gpu_and_cpu_print_the_same),
    ]
}

fn a_face_has_its_three_edges() -> Outcome {
    let folder = Folder::with(&[("face.obj", FACE)]);
    for (light, expected) in [
        ("--point 0.2,0.2,5", r#"{"edges":[[0,1,1],[0,2,-1],[1,2,1]]}"#),
        ("--point 0.2,0.2,-5", r#"{"edges":[[0,1,-1],[0,2,1],[1,2,-1]]}"#),
        ("--direction 0,0,1", r#"{"edges":[[0,1,1],[0,2,-1],[1,2,1]]}"#),
        ("--direction 0.5,0.5,-1", r#"{"edges":[[0,1,-1],[0,2,1],[1,2,-1]]}"#),
    ] {
        let printed = folder.run(&format!("silhouette face.obj --on cpu {light}")).stdout()?;
        if printed.trim_end() != expected {
            return Err(format!("{light}: expected {expected}, printed {printed}"));
        }
    }
    Ok(())
}

fn gpu_and_cpu_print_the_same() -> Outcome {
    let folder = Folder::with(&[("face.obj", FACE), ("sheets.obj", SHEETS), ("many.obj", &tetrahedra(2000))]);
    for mesh in ["knot.obj", "elephant.obj"] {
        fs::copy(asset(&format!("meshes/{mesh}")), folder.path(mesh)).map_err(|error| format!("{mesh}: {error}"))?;
    }
    for mesh in ["face.obj", "sheets.obj", "knot.obj", "elephant.obj", "many.obj"] {
        let mut seen = Vec::new();
        for light in LIGHTS {
            let on = |who: &str| folder.run(&format!("silhouette {mesh} {light} --on {who}")).stdout();
            let (gpu, cpu) = (on("gpu")?, on("cpu")?);
            if gpu != cpu {
                return Err(format!("{mesh} {light}: the GPU prints {gpu}, the CPU {cpu}"));
            }
            seen.push(gpu);
        }
        seen.sort();
        seen.dedup();
        // Else all lights might have been read as one.
        if seen.len() < 2 {
            return Err(format!("{mesh} has the same silhouette under all lights"));
        }
    }
    Ok(())
}

fn every_format_tells_the_same_edges() -> Outcome {
    let folder = Folder::new();
    let path = asset("meshes/knot.obj");
    fs::copy(&path, folder.path("knot.obj")).map_err(|error| format!("{}: {error}", path.display()))?;
    let silhouette = "silhouette knot.obj --on cpu --point 3,-4,5";
    let json = folder.run(silhouette).json()?;
    let edges = json["edges"].as_array().ok_or("`edges` is a list")?;
    if edges.len() < 50 {
        return Err(format!("only {} edges", edges.len()));
    }
    if let Some(edge) = edges.iter().find(|edge| edge[0].as_u64() >= edge[1].as_u64() || edge[2].as_i64() == Some(0)) {
        return Err(format!("{edge} is no edge from a lower to a higher vertex"));
    }

    let printed = folder.run(&format!("{silhouette} --format obj -o lines.obj")).stdout()?;
    if !printed.is_empty() {
        return Err(format!("with a file named, it prints {printed}"));
    }
    let lines = line_count(&folder.read("lines.obj")?)?;
    if lines != edges.len() {
        return Err(format!("{} edges in JSON, {lines} lines in OBJ", edges.len()));
    }

    let svg = folder.run(&format!("{silhouette} --format svg")).stdout()?;
    check_well_formed(&svg)?;
    if svg.starts_with("<svg ") && svg.contains(&format!("<desc>{lines} silhouette edges")) {
        return Ok(());
    }
    Err(format!("the drawing does not tell of {lines} edges"))
}

/// Reads OBJ with line elements.
fn line_count(obj: &str) -> Result<usize, String> {
    let (mut vertices, mut lines) = (0, 0);
    for line in obj.lines().filter(|line| !line.starts_with('#')) {
        let (kind, rest) = line.split_once(' ').ok_or_else(|| format!("{line:?} says nothing"))?;
        let numbers = rest.split(' ').map(str::parse::<f64>).collect::<Result<Vec<_>, _>>();
        let numbers = numbers.map_err(|error| format!("{line:?}: {error}"))?;
        match (kind, &numbers[..]) {
            ("v", [_, _, _]) if numbers.iter().all(|number| number.is_finite()) => vertices += 1,
            ("l", [from, to]) if from != to && numbers.iter().all(|&end| end >= 1.0 && end <= f64::from(vertices)) => {
                lines += 1;
            }
            _ => return Err(format!("{line:?} is neither a vertex nor a line between vertices before it")),
        }
    }
    Ok(lines)
}
