//! `contrejour inspect`: the topology report of each mesh of a file, and its textures, cameras, lights and animations.

mod stream;

use std::collections::HashMap;
use std::path::Path;
use std::sync::Arc;

use contrejour_mesh::{
    BuildOptions, EncodedImage, FileCamera, FileLight, FileLightKind, LoadError, MeshFile, Rig, TopologyAwareMesh,
    TopologyReport, TriangleMesh, load, load_animated,
};
use serde::Serialize;

use crate::args::InspectArguments;
use crate::failure::Failure;
use crate::output::print;
use stream::StreamReport;

#[derive(Serialize)]
struct FileReport {
    file: String,
    meshes: Vec<MeshReport>,
    animations: Vec<AnimationReport>,
    cameras: Vec<CameraReport>,
    lights: Vec<LightReport>,
    textures: Vec<TextureReport>,
    warnings: Vec<String>,
}

#[derive(Serialize)]
struct MeshReport {
    name: String,
    /// Vertices of the file that no face uses and that the loader did not keep.
    unlisted_vertices: u32,
    /// Triangles that alpha masks cut: they count in the report, and have no silhouette when they cast.
    masked_triangles: u64,
    report: TopologyReport,
    tam_stream: StreamReport,
}

#[derive(Serialize)]
struct AnimationReport {
    name: String,
    seconds: f64,
}

#[derive(Serialize)]
struct CameraReport {
    name: String,
    fov_y_degrees: f64,
}

#[derive(Serialize)]
struct LightReport {
    name: String,
    kind: &'static str,
    /// In candela, or lux for a directional light.
    intensity: f64,
}

#[derive(Serialize)]
struct TextureReport {
    picture: String,
    bytes: usize,
    triangles: u64,
}

pub fn run(arguments: &InspectArguments) -> Result<(), Failure> {
    let (MeshFile { meshes, cameras, lights, warnings, .. }, rig) = load_all(&arguments.mesh)?;
    let textures = textures(&meshes);
    let meshes = meshes.iter().map(report).collect::<Result<Vec<_>, _>>()?;
    let animations = rig.animations.into_iter();
    let animations = animations.map(|animation| AnimationReport { name: animation.name, seconds: animation.duration });
    let camera = |FileCamera { name, fov_y, .. }| CameraReport { name, fov_y_degrees: f64::to_degrees(fov_y) };
    let file = FileReport {
        file: arguments.mesh.display().to_string(),
        meshes,
        animations: animations.collect(),
        cameras: cameras.into_iter().map(camera).collect(),
        lights: lights.into_iter().map(light).collect(),
        textures,
        warnings,
    };
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

fn light(FileLight { name, kind, intensity, .. }: FileLight) -> LightReport {
    let kind = match kind {
        FileLightKind::Directional { .. } => "directional",
        FileLightKind::Point { .. } => "point",
        FileLightKind::Spot { .. } => "spot",
    };
    LightReport { name, kind, intensity }
}

/// The pictures of base colour textures in the order in which meshes name them, and how many triangles have them.
fn textures(meshes: &[TriangleMesh]) -> Vec<TextureReport> {
    let mut reports: Vec<TextureReport> = Vec::new();
    let mut known = HashMap::new();
    let parts = meshes.iter().flat_map(|mesh| &mesh.parts);
    let textured = parts.filter_map(|part| Some((&part.triangles, part.texture.as_ref()?)));
    for (triangles, texture) in textured {
        let index = *known.entry(Arc::as_ptr(&texture.image)).or_insert_with(|| {
            let EncodedImage { place, bytes } = &*texture.image;
            reports.push(TextureReport { picture: place.clone(), bytes: bytes.len(), triangles: 0 });
            reports.len() - 1
        });
        reports[index].triangles += triangles.len() as u64;
    }
    reports
}

fn report(mesh: &TriangleMesh) -> Result<MeshReport, Failure> {
    let topology = TopologyAwareMesh::build(&mesh.positions, &mesh.triangles, &BuildOptions::default())?;
    Ok(MeshReport {
        tam_stream: StreamReport::new(&topology),
        name: mesh.name.clone(),
        unlisted_vertices: mesh.unlisted_vertices,
        masked_triangles: mesh.cut_triangle_count() as u64,
        report: topology.report,
    })
}

fn text(file: &FileReport) -> String {
    let mut text = format!("{}\n", file.file);
    for mesh in &file.meshes {
        let name = if mesh.name.is_empty() { "(no name)" } else { &mesh.name };
        text += &format!("\nmesh {name}\n{}", mesh.report);
        if mesh.unlisted_vertices > 0 {
            text += &format!("{:<22}{:>10}\n", "unused in the file", mesh.unlisted_vertices);
        }
        text += &mesh.tam_stream.text();
        if mesh.masked_triangles > 0 {
            text += &format!("{:<22}{:>10}  without silhouettes\n", "cut by alpha masks", mesh.masked_triangles);
        }
    }
    if file.meshes.is_empty() {
        text += "\nno mesh\n";
    }
    if !(file.animations.is_empty() && file.cameras.is_empty() && file.lights.is_empty() && file.textures.is_empty()) {
        text += "\n";
    }
    for TextureReport { picture, bytes, triangles } in &file.textures {
        text += &format!("texture {picture}, {bytes} bytes, on {triangles} triangles\n");
    }
    for CameraReport { name, fov_y_degrees } in &file.cameras {
        text += &format!("camera {name:?}, {fov_y_degrees:.1} degrees\n");
    }
    for LightReport { name, kind, intensity } in &file.lights {
        let unit = if *kind == "directional" { "lux" } else { "candela" };
        text += &format!("light {name:?}, {kind}, {intensity} {unit}\n");
    }
    for AnimationReport { name, seconds } in &file.animations {
        text += &format!("animation {name:?}, {seconds:.3} s\n");
    }
    for warning in &file.warnings {
        text += &format!("\nnote: {warning}\n");
    }
    text
}
