//! STL, binary and text, read facet by facet so that vertices keep their numbers.

use std::path::Path;

use super::{is_finite, stem};
use crate::{LoadError, MeshFile, TriangleMesh};

/// Bytes before the facets of a binary file: a free header and the number of facets.
const HEADER_BYTES: usize = 84;
/// A normal, three corners and two bytes of attributes.
const FACET_BYTES: usize = 50;

/// Loads an STL file from its bytes; `path` is for messages.
///
/// Vertex numbers are 3 * facet + corner; nothing is merged. The facet normals of the file are not read (too many
/// exporters leave them zero or wrong): they follow from the corners.
///
/// # Errors
///
/// [`LoadError`] with the line or facet where the file is cut off, is no STL, or has a coordinate that is not finite.
pub fn load_stl(bytes: &[u8], path: &Path) -> Result<MeshFile, LoadError> {
    let mut warnings = Vec::new();
    let positions = if is_text(bytes) {
        text_corners(&String::from_utf8_lossy(bytes), path)?
    } else {
        binary_corners(bytes, path, &mut warnings)?
    };
    let vertex_count = u32::try_from(positions.len()).map_err(|_| LoadError::TooManyVertices { path: path.into() })?;
    let mut mesh = TriangleMesh {
        name: stem(path),
        colors: vec![TriangleMesh::DEFAULT_COLOR; positions.len()],
        triangles: (0..vertex_count / 3).map(|facet| [3 * facet, 3 * facet + 1, 3 * facet + 2]).collect(),
        vertex_numbers: (0..vertex_count).collect(),
        positions,
        ..TriangleMesh::default()
    };
    mesh.complete_normals();
    Ok(MeshFile::single(mesh, warnings))
}

/// Binary headers may start with `solid` too: a length that fits the facet count, or a zero byte, tells them apart.
fn is_text(bytes: &[u8]) -> bool {
    let has_binary_length =
        facet_count(bytes).is_some_and(|count| bytes.len() as u64 == HEADER_BYTES as u64 + FACET_BYTES as u64 * count);
    let start = &bytes[..bytes.len().min(512)];
    start.trim_ascii_start().starts_with(b"solid") && !has_binary_length && !start.contains(&0)
}

fn facet_count(bytes: &[u8]) -> Option<u64> {
    let count = bytes.get(HEADER_BYTES - 4..)?.first_chunk()?;
    Some(u64::from(u32::from_le_bytes(*count)))
}

fn binary_corners(bytes: &[u8], path: &Path, warnings: &mut Vec<String>) -> Result<Vec<[f32; 3]>, LoadError> {
    let needed = HEADER_BYTES as u64 + FACET_BYTES as u64 * facet_count(bytes).unwrap_or(0);
    let available = bytes.len() as u64;
    if needed > available {
        return Err(LoadError::BeyondData { path: path.into(), place: "binary STL".into(), needed, available });
    }
    if available > needed {
        warnings.push(format!("{} bytes after the last facet are left out", available - needed));
    }
    let (facets, _) = bytes[HEADER_BYTES..needed as usize].as_chunks::<FACET_BYTES>();
    let mut positions = Vec::with_capacity(3 * facets.len());
    for (facet, record) in facets.iter().enumerate() {
        let (words, _) = record.as_chunks::<4>();
        for corner in 1..4 {
            let position = [0, 1, 2].map(|axis| f32::from_le_bytes(words[3 * corner + axis]));
            if !is_finite(position) {
                return Err(LoadError::NotFinite { path: path.into(), place: format!("facet {facet}") });
            }
            positions.push(position);
        }
    }
    Ok(positions)
}

fn text_corners(text: &str, path: &Path) -> Result<Vec<[f32; 3]>, LoadError> {
    let malformed = |line: usize, problem: &str| LoadError::Malformed {
        path: path.into(),
        place: format!("line {line}"),
        problem: problem.into(),
    };
    let mut positions = Vec::new();
    let mut facet_begin = 0;
    let mut last_line = 0;
    for (index, content) in text.lines().enumerate() {
        let line = index + 1;
        let mut words = content.split_whitespace();
        let keyword = words.next().unwrap_or("").to_ascii_lowercase();
        match keyword.as_str() {
            "vertex" => {
                let numbers: Result<Vec<f32>, _> = words.map(str::parse).collect();
                let Ok(&[x, y, z]) = numbers.as_deref() else {
                    return Err(malformed(line, "a vertex is not three numbers; write vertex x y z"));
                };
                if !is_finite([x, y, z]) {
                    return Err(LoadError::NotFinite { path: path.into(), place: format!("line {line}") });
                }
                positions.push([x, y, z]);
            }
            "facet" | "endfacet" => {
                if ![0, 3].contains(&(positions.len() - facet_begin)) {
                    return Err(malformed(line, "a facet does not have three vertices; split it into triangles"));
                }
                facet_begin = positions.len();
            }
            "" | "solid" | "outer" | "endloop" | "endsolid" => {}
            _ => {
                return Err(malformed(line, "no line of a text STL; export the mesh again as binary STL"));
            }
        }
        last_line = line;
    }
    if positions.len() % 3 != 0 {
        return Err(malformed(last_line, "the file ends inside a facet; export it again"));
    }
    Ok(positions)
}
