//! PLY, text and binary (Turk 1994).

mod header;
mod values;

use std::path::Path;

use super::{is_finite, linear_from_srgb, stem};
use crate::{LoadError, MeshFile, TriangleMesh};

use header::{Element, Header, Property};
use values::Values;

/// Loads a PLY file from its bytes; `path` is for messages.
///
/// Reads `x y z`, `nx ny nz` and `red green blue` (sRGB) of `vertex`, of any number type, and the `vertex_indices` or
/// `vertex_index` lists of `face`; polygons are fans from their first corner. Vertex numbers are rows; vertices
/// that no face uses stay in the mesh.
///
/// # Errors
///
/// [`LoadError`] with the line (text) or row (binary) of what cannot be read, is out of range or not finite.
pub fn load_ply(bytes: &[u8], path: &Path) -> Result<MeshFile, LoadError> {
    let header = Header::read(bytes).map_err(|(line, problem)| LoadError::Malformed {
        path: path.into(),
        place: format!("line {line}"),
        problem: problem.into(),
    })?;
    let mut values = Values::new(bytes, &header);
    let mut mesh = TriangleMesh { name: stem(path), ..TriangleMesh::default() };
    let mut warnings = Vec::new();
    for element in &header.elements {
        let needed = element.least_bytes(header.encoding);
        if needed > values.remaining() {
            return Err(LoadError::BeyondData {
                path: path.into(),
                place: format!("element {}", element.name),
                needed,
                available: values.remaining(),
            });
        }
        match element.name.as_str() {
            "vertex" => read_vertices(element, &mut values, &mut mesh, path)?,
            "face" => read_faces(element, &mut values, &mut mesh, path, &mut warnings)?,
            other => {
                read_rows(element, &mut values, path, |_| Ok(()))?;
                if element.count > 0 {
                    warnings.push(format!("{} elements {other:?} are left out", element.count));
                }
            }
        }
    }
    check_indices(&mesh, path)?;
    let vertex_count =
        u32::try_from(mesh.positions.len()).map_err(|_| LoadError::TooManyVertices { path: path.into() })?;
    mesh.vertex_numbers = (0..vertex_count).collect();
    mesh.complete_normals();
    Ok(MeshFile::single(mesh, warnings))
}

/// One row of an element: for each property its numbers, and where the row stands in the file.
struct Row<'a> {
    numbers: &'a [Vec<f64>],
    place: &'a dyn Fn() -> String,
}

fn read_rows(
    element: &Element,
    values: &mut Values,
    path: &Path,
    mut take: impl FnMut(Row) -> Result<(), LoadError>,
) -> Result<(), LoadError> {
    let mut numbers = vec![Vec::new(); element.properties.len()];
    if numbers.is_empty() {
        return Ok(());
    }
    for row in 0..element.count {
        for (property, numbers) in element.properties.iter().zip(&mut numbers) {
            read_property(property, values, numbers).map_err(|problem| LoadError::Malformed {
                path: path.into(),
                place: values.place(&element.name, row),
                problem: problem.into(),
            })?;
        }
        take(Row { numbers: &numbers, place: &|| values.place(&element.name, row) })?;
    }
    Ok(())
}

fn read_property(property: &Property, values: &mut Values, numbers: &mut Vec<f64>) -> Result<(), &'static str> {
    numbers.clear();
    let length = match property.length {
        Some(length) => values.next(length)?,
        None => 1.0,
    };
    if !(length >= 0.0 && length.fract() == 0.0) {
        return Err("a list has a length that is no whole number; export the file again");
    }
    // Grows with what is there, not with what a broken length promises.
    for _ in 0..length as u64 {
        numbers.push(values.next(property.value)?);
    }
    Ok(())
}

/// Where three properties stand in a row; `None` unless all are there and no lists.
fn columns(element: &Element, names: [&str; 3]) -> Option<[usize; 3]> {
    let mut columns = [0; 3];
    for (column, name) in columns.iter_mut().zip(names) {
        *column = element.properties.iter().position(|property| property.name == name && property.length.is_none())?;
    }
    Some(columns)
}

fn read_vertices(
    element: &Element,
    values: &mut Values,
    mesh: &mut TriangleMesh,
    path: &Path,
) -> Result<(), LoadError> {
    let position_columns = columns(element, ["x", "y", "z"]).ok_or_else(|| LoadError::Malformed {
        path: path.into(),
        place: "header".into(),
        problem: "vertex has no properties x, y and z; add them".into(),
    })?;
    let normal_columns = columns(element, ["nx", "ny", "nz"]);
    let color_columns = columns(element, ["red", "green", "blue"]);
    read_rows(element, values, path, |row| {
        let at = |columns: [usize; 3]| columns.map(|column| row.numbers[column][0] as f32);
        let position = at(position_columns);
        if !is_finite(position) {
            return Err(LoadError::NotFinite { path: path.into(), place: (row.place)() });
        }
        mesh.positions.push(position);
        mesh.normals.push(normal_columns.map_or([0.0; 3], at));
        let color = |columns: [usize; 3]| {
            let one = |column: usize| element.properties[column].value.color_one();
            linear_from_srgb(columns.map(|column| (row.numbers[column][0] / one(column)) as f32))
        };
        let color = color_columns.map_or(TriangleMesh::DEFAULT_COLOR, color);
        if !is_finite(color) {
            return Err(LoadError::Malformed {
                path: path.into(),
                place: (row.place)(),
                problem: "a colour is no number; correct it".into(),
            });
        }
        mesh.colors.push(color);
        Ok(())
    })?;
    Ok(())
}

fn read_faces(
    element: &Element,
    values: &mut Values,
    mesh: &mut TriangleMesh,
    path: &Path,
    warnings: &mut Vec<String>,
) -> Result<(), LoadError> {
    let is_indices = |property: &Property| {
        matches!(property.name.as_str(), "vertex_indices" | "vertex_index") && property.length.is_some()
    };
    let column = element.properties.iter().position(is_indices);
    let column = column.ok_or_else(|| LoadError::Malformed {
        path: path.into(),
        place: "header".into(),
        problem: "face has no list vertex_indices; add it".into(),
    })?;
    let mut short_faces = 0;
    read_rows(element, values, path, |row| {
        let corners = &row.numbers[column];
        if corners.len() < 3 {
            short_faces += 1;
            return Ok(());
        }
        if let Some(corner) = corners.iter().find(|&&corner| !is_index(corner)) {
            return Err(LoadError::IndexOutOfRange {
                path: path.into(),
                place: (row.place)(),
                what: "vertex",
                index: *corner as i64,
                count: mesh.positions.len(),
            });
        }
        let fan = corners[1..].windows(2);
        mesh.triangles.extend(fan.map(|pair| [corners[0], pair[0], pair[1]].map(|corner| corner as u32)));
        Ok(())
    })?;
    if short_faces > 0 {
        warnings.push(format!("{short_faces} faces with fewer than three corners are left out"));
    }
    Ok(())
}

fn is_index(number: f64) -> bool {
    (0.0..=f64::from(u32::MAX)).contains(&number) && number.fract() == 0.0
}

/// Faces may stand before the vertices, so this comes last.
fn check_indices(mesh: &TriangleMesh, path: &Path) -> Result<(), LoadError> {
    let count = mesh.positions.len();
    let is_beyond = |triangle: &[u32; 3]| triangle.iter().any(|&vertex| vertex as usize >= count);
    let Some(triangle) = mesh.triangles.iter().position(is_beyond) else {
        return Ok(());
    };
    let beyond = mesh.triangles[triangle].iter().max();
    Err(LoadError::IndexOutOfRange {
        path: path.into(),
        place: format!("triangle {triangle}"),
        what: "vertex",
        index: beyond.map_or(0, |&vertex| i64::from(vertex)),
        count,
    })
}
