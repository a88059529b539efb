//! `contrejour inspect`: the topology report of each mesh of a file, and its animations.

use std::path::Path;

use contrejour_mesh::{
    BuildOptions, LoadError, MeshFile, Rig, TopologyAwareMesh, TopologyReport, TriangleMesh, load, load_animated,
};
use serde::Serialize;

use crate::args::InspectArguments;
use crate::failure::Failure;
use crate::output::print;

#[derive(Serialize)]
struct FileReport {
    file: String,
    meshes: Vec<MeshReport>,
    animations: Vec<AnimationReport>,
    warnings: Vec<String>,
}

#[derive(Serialize)]
struct MeshReport {
    name: String,
    /// Vertices of the file that no face uses and that the loader did not keep.
    unlisted_vertices: u32,
    report: TopologyReport,
}

#[derive(Serialize)]
struct AnimationReport {
    name: String,
    seconds: f64,
}

pub fn run(arguments: &InspectArguments) -> Result<(), Failure> {
    let (MeshFile { meshes, warnings, .. }, rig) = load_all(&arguments.mesh)?;
    let meshes = meshes.iter().map(report).collect::<Result<Vec<_>, _>>()?;
    let animations = rig.animations.into_iter();
    let animations = animations.map(|animation| AnimationReport { name: animation.name, seconds: animation.duration });
    let file =
        FileReport { file: arguments.mesh.display().to_string(), meshes, animations: animations.collect(), warnings };
    print(&if arguments.json { serde_json::to_string_pretty(&file)? } else { text(&file) })
}

/// The meshes as every command but an animated `render` has them, and what moves them.
fn load_all(path: &Path) -> Result<(MeshFile, Rig), LoadError> {
    match load_animated(path) {
        Ok(model) if model.rig.parts.iter().all(|part| part.deforming.is_none()) => Ok((model.file, model.rig)),
        Ok(model) => Ok((load(path)?, model.rig)),
        Err(error) => {
            let mut file = load(path)?;
            file.warnings.push(format!("its animations are not read: {error}"));
            Ok((file, Rig::default()))
        }
    }
}

fn report(mesh: &TriangleMesh) -> Result<MeshReport, Failure> {
    let topology = TopologyAwareMesh::build(&mesh.positions, &mesh.triangles, &BuildOptions::default())?;
    Ok(MeshReport { name: mesh.name.clone(), unlisted_vertices: mesh.unlisted_vertices, report: topology.report })
}

fn text(file: &FileReport) -> String {
    let mut text = format!("{}\n", file.file);
    for mesh in &file.meshes {
        let name = if mesh.name.is_empty() { "(no name)" } else { &mesh.name };
        text += &format!("\nmesh {name}\n{}", mesh.report);
        if mesh.unlisted_vertices > 0 {
            text += &format!("{:<22}{:>10}\n", "unused in the file", mesh.unlisted_vertices);
        }
    }
    if file.meshes.is_empty() {
        text += "\nno mesh\n";
    }
    if !file.animations.is_empty() {
        text += "\n";
    }
    for AnimationReport { name, seconds } in &file.animations {
        text += &format!("animation {name:?}, {seconds:.3} s\n");
    }
    for warning in &file.warnings {
        text += &format!("\nnote: {warning}\n");
    }
    text
}
