//! `contrejour inspect`: the topology report of each mesh of a file.

use contrejour_mesh::{BuildOptions, MeshFile, TopologyAwareMesh, TopologyReport, TriangleMesh};
use serde::Serialize;

use crate::args::InspectArguments;
use crate::failure::Failure;
use crate::output::print;

#[derive(Serialize)]
struct FileReport {
    file: String,
    meshes: Vec<MeshReport>,
    warnings: Vec<String>,
}

#[derive(Serialize)]
struct MeshReport {
    name: String,
    /// Vertices of the file that no face uses and that the loader did not keep.
    unlisted_vertices: u32,
    report: TopologyReport,
}

pub fn run(arguments: &InspectArguments) -> Result<(), Failure> {
    let MeshFile { meshes, warnings, .. } = contrejour_mesh::load(&arguments.mesh)?;
    let meshes = meshes.iter().map(report).collect::<Result<Vec<_>, _>>()?;
    let file = FileReport { file: arguments.mesh.display().to_string(), meshes, warnings };
    print(&if arguments.json { serde_json::to_string_pretty(&file)? } else { text(&file) })
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
    for warning in &file.warnings {
        text += &format!("\nnote: {warning}\n");
    }
    text
}
