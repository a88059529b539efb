//! Wavefront OBJ: tobj reads what a pre-pass has checked, numbered and cleaned.

mod elements;
mod lines;
mod logical_lines;
mod materials;

use std::path::Path;

use super::{ReadFile, read_file};
use crate::normals::position_bits;
use crate::{LoadError, MeshFile, TriangleMesh};

use lines::ObjLines;
use materials::Materials;

/// Loads an OBJ file from its bytes; `path` is for messages and for the material files beside it.
///
/// All groups and objects are one mesh. A polygon is a fan from its first corner. A vertex's number is the lowest
/// `v` line (from 0) with its position. The base colour of a face is the `Kd` of its material, taken as linear
/// (what exporters write today), times the colours of its `v` lines, taken as sRGB; textures are not read.
/// `v x y z w` is divided by w. Faces with fewer than three corners, lines and points are left out with a warning.
///
/// # Errors
///
/// [`LoadError`] with the line of an index out of range, of a number that cannot be read, and of a coordinate that is
/// not finite.
pub fn load_obj(bytes: &[u8], path: &Path) -> Result<MeshFile, LoadError> {
    load(bytes, path, &read_file)
}

/// [`load_obj`] with the material files from `read_beside`.
pub(super) fn load(bytes: &[u8], path: &Path, read_beside: &ReadFile) -> Result<MeshFile, LoadError> {
    if bytes.contains(&0) {
        return Err(LoadError::Malformed {
            path: path.into(),
            place: "bytes".into(),
            problem: "holds zero bytes, so it is no text; if it is another format, give it that extension".into(),
        });
    }
    let text = String::from_utf8_lossy(bytes);
    let lines = ObjLines::read(&text, path)?;
    let mut warnings = lines.warnings();
    let materials = Materials::read(&lines, path, read_beside, &mut warnings);

    let (models, _) = tobj::load_obj_buf(&mut lines.text.as_bytes(), &tobj::GPU_LOAD_OPTIONS, |_| materials.for_tobj())
        .map_err(|error| LoadError::Malformed {
            path: path.into(),
            place: "faces".into(),
            problem: format!("{error}; put all v and vn lines before the faces that use them"),
        })?;

    let mut mesh = TriangleMesh {
        name: lines.name.clone().unwrap_or_else(|| super::stem(path)),
        unlisted_vertices: lines.unlisted_vertices,
        ..TriangleMesh::default()
    };
    for model in &models {
        append_model(&mut mesh, &model.mesh, &materials, &lines);
    }
    if u32::try_from(mesh.positions.len()).is_err() {
        return Err(LoadError::TooManyVertices { path: path.into() });
    }
    mesh.complete_normals();
    Ok(MeshFile::single(mesh, warnings))
}

fn append_model(mesh: &mut TriangleMesh, model: &tobj::Mesh, materials: &Materials, lines: &ObjLines) {
    let first_vertex = mesh.positions.len() as u32;
    let (positions, _) = model.positions.as_chunks::<3>();
    let (normals, _) = model.normals.as_chunks::<3>();
    let (vertex_colors, _) = model.vertex_color.as_chunks::<3>();
    let (triangles, _) = model.indices.as_chunks::<3>();

    mesh.positions.extend(positions);
    mesh.vertex_numbers.extend(positions.iter().map(|&position| lines.numbers[&position_bits(position)]));
    let color = materials.color(model.material_id);
    mesh.colors.extend((0..positions.len()).map(|vertex| {
        vertex_colors.get(vertex).map_or(color, |&of_vertex| {
            let of_vertex = super::linear_from_srgb(of_vertex);
            [0, 1, 2].map(|channel| of_vertex[channel] * color[channel])
        })
    }));
    // tobj leaves out the normal of a corner that names none, and so loses which corner that was:
    // then all normals of this part are computed.
    if normals.len() == positions.len() {
        mesh.normals.extend(normals);
    } else {
        mesh.normals.resize(mesh.positions.len(), [0.0; 3]);
    }
    mesh.triangles.extend(triangles.iter().map(|triangle| triangle.map(|vertex| first_vertex + vertex)));
}
