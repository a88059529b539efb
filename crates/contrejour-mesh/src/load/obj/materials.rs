//! Diffuse colours of OBJ materials.

use std::collections::HashSet;
use std::path::Path;

use super::lines::ObjLines;
use crate::TriangleMesh;
use crate::load::ReadFile;

/// Name and linear diffuse colour of each material that the file's libraries define.
#[derive(Default)]
pub(super) struct Materials {
    names: Vec<String>,
    colors: Vec<[f32; 3]>,
}

impl Materials {
    /// Reads the libraries that the file names; what is missing is a warning.
    pub(super) fn read(lines: &ObjLines, path: &Path, read_beside: &ReadFile, warnings: &mut Vec<String>) -> Self {
        let mut materials = Self::default();
        let mut has_textures = false;
        let mut is_complete = true;
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut append = |name: &str, bytes: &[u8], warnings: &mut Vec<String>| {
            has_textures |= materials.append(&String::from_utf8_lossy(bytes), name, warnings);
        };
        let mut names_read = HashSet::new();
        for line in &lines.libraries {
            if !names_read.insert(line.as_str()) {
                continue;
            }
            // One name with spaces where such a file exists, else names between spaces.
            if let Ok(bytes) = read_beside(&folder.join(line)) {
                append(line, &bytes, warnings);
                continue;
            }
            for name in line.split_whitespace().filter(|&name| name == line || names_read.insert(name)) {
                match read_beside(&folder.join(name)) {
                    Ok(bytes) => append(name, &bytes, warnings),
                    Err(error) => {
                        is_complete = false;
                        warnings.push(format!("material library not read, default colour used: {error}"));
                    }
                }
            }
        }
        if has_textures {
            warnings.push("textures of materials are not read; their diffuse colours are used".into());
        }
        let defined: HashSet<&String> = materials.names.iter().collect();
        let undefined: Vec<&String> = lines.materials.iter().filter(|name| !defined.contains(name)).collect();
        if let (Some(first), true) = (undefined.first(), is_complete) {
            warnings.push(format!(
                "{} materials are in no material library, default colour used; the first is {first:?}",
                undefined.len()
            ));
        }
        materials
    }

    /// Adds the materials of a library; says whether one of them has a diffuse texture.
    fn append(&mut self, text: &str, library: &str, warnings: &mut Vec<String>) -> bool {
        let mut has_textures = false;
        for (index, line) in text.lines().enumerate() {
            let line = line.trim();
            let (keyword, value) = line.split_once(char::is_whitespace).unwrap_or((line, ""));
            match keyword {
                "newmtl" => {
                    self.names.push(value.trim().to_owned());
                    self.colors.push(TriangleMesh::DEFAULT_COLOR);
                }
                "Kd" => match (diffuse_color(value), self.colors.last_mut()) {
                    (Some(diffuse), Some(color)) => *color = diffuse,
                    _ => {
                        let place = format!("{library}, line {}", index + 1);
                        warnings.push(format!("{place}: not read, default colour used: {line:?}"));
                    }
                },
                "map_Kd" => has_textures = true,
                _ => {}
            }
        }
        has_textures
    }

    /// Colour of a material as tobj numbers it.
    pub(super) fn color(&self, material: Option<usize>) -> [f32; 3] {
        material.map_or(TriangleMesh::DEFAULT_COLOR, |material| self.colors[material])
    }

    /// The materials as tobj's own reader would give them (which panics on a `Kd` with one number).
    pub(super) fn for_tobj(&self) -> tobj::MTLLoadResult {
        let to_material = |name: &String| tobj::Material { name: name.clone(), ..tobj::Material::default() };
        let by_name = self.names.iter().cloned().zip(0..).collect();
        Ok((self.names.iter().map(to_material).collect(), by_name))
    }
}

/// `r g b`, or `r` for a grey; `None` for spectral curves, CIE XYZ and what is no number.
fn diffuse_color(value: &str) -> Option<[f32; 3]> {
    let numbers: Result<Vec<f32>, _> = value.split_whitespace().map(str::parse).collect();
    let color = match numbers.ok()?[..] {
        [grey] => [grey; 3],
        [red, green, blue, ..] => [red, green, blue],
        _ => return None,
    };
    let is_finite = color.iter().all(|channel| channel.is_finite());
    is_finite.then(|| color.map(|channel| channel.clamp(0.0, 1.0)))
}
