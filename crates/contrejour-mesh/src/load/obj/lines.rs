//! The pre-pass over an OBJ file: joins lines, checks what tobj would report without a line, keeps vertex numbers.

use std::collections::HashSet;
use std::collections::hash_map::{Entry, HashMap};
use std::path::Path;

use crate::LoadError;
use crate::load::is_finite;
use crate::normals::position_bits;

use super::elements::{self, Seen};
use super::logical_lines::LogicalLines;

/// What the pre-pass learns from a file.
#[derive(Default)]
pub(super) struct ObjLines {
    /// The lines for tobj: `v`, `vn`, `f`, `usemtl`, and one `mtllib`; joined, without comments.
    ///
    /// tobj would take an `l` line of three vertices for a triangle, and start a model at each `g`.
    pub(super) text: String,
    /// Name of the first object or group.
    pub(super) name: Option<String>,
    /// Material libraries, in order.
    pub(super) libraries: Vec<String>,
    /// Materials that faces use, each once, in order.
    pub(super) materials: Vec<String>,
    known_materials: HashSet<String>,
    /// Lowest `v` line, from 0, at each position.
    pub(super) numbers: HashMap<[u32; 3], u32>,
    /// `v` lines that no face uses.
    pub(super) unlisted_vertices: u32,
    lines_and_points: usize,
    short_faces: usize,
    first_short_face: Option<usize>,
    unusable_normals: usize,
    other_lines: usize,
    first_other_line: Option<usize>,
}

fn non_empty(name: &str) -> Option<String> {
    let name = name.trim();
    (!name.is_empty()).then(|| name.to_owned())
}

impl ObjLines {
    pub(super) fn read(text: &str, path: &Path) -> Result<Self, LoadError> {
        let malformed = |line: usize, problem: &str| LoadError::Malformed {
            path: path.into(),
            place: format!("line {line}"),
            problem: problem.into(),
        };
        let mut lines = Self::default();
        let mut seen = Seen::default();
        lines.text.reserve(text.len() + 16);
        lines.text.push_str("mtllib all\n");

        for (line, content) in LogicalLines::new(text) {
            let content = content.as_ref();
            let (keyword, rest) = content.split_once(char::is_whitespace).unwrap_or((content, ""));
            match keyword {
                "v" => {
                    let position =
                        elements::vertex_position(rest, &mut seen).map_err(|problem| malformed(line, problem))?;
                    if !is_finite(position) {
                        return Err(LoadError::NotFinite { path: path.into(), place: format!("line {line}") });
                    }
                    lines.number_vertex(position, &mut seen);
                    lines.keep(content);
                }
                "vn" => {
                    seen.normal_count += 1;
                    if elements::is_normal(rest) {
                        lines.keep(content);
                    } else {
                        lines.unusable_normals += 1;
                        lines.keep("vn 0 0 0");
                    }
                }
                "f" => {
                    let corner_count =
                        elements::check_face(rest, line, &mut seen).map_err(|problem| malformed(line, problem))?;
                    if corner_count < 3 {
                        lines.short_faces += 1;
                        lines.first_short_face = lines.first_short_face.or(Some(line));
                    } else {
                        lines.keep(content);
                    }
                }
                "usemtl" => lines.use_material(rest.trim()),
                "mtllib" => lines.libraries.push(rest.trim().to_owned()),
                "o" | "g" => lines.name = lines.name.take().or_else(|| non_empty(rest)),
                "l" | "p" => lines.lines_and_points += 1,
                "" | "vt" | "s" | "mg" | "lod" | "usemap" | "bevel" | "c_interp" | "d_interp" => {}
                _ => {
                    lines.other_lines += 1;
                    lines.first_other_line = lines.first_other_line.or(Some(line));
                }
            }
        }
        lines.finish(seen, path)
    }

    fn number_vertex(&mut self, position: [f32; 3], seen: &mut Seen) {
        let number = seen.is_vertex_used.len() as u32;
        if let Entry::Vacant(vacant) = self.numbers.entry(position_bits(position)) {
            vacant.insert(number);
        }
        seen.is_vertex_used.push(false);
    }

    fn keep(&mut self, line: &str) {
        self.text.push_str(line);
        self.text.push('\n');
    }

    fn use_material(&mut self, name: &str) {
        // A name that no library has makes tobj use no material.
        self.keep(&format!("usemtl {}", if name.is_empty() { "(none)" } else { name }));
        if self.known_materials.insert(name.to_owned()) {
            self.materials.push(name.to_owned());
        }
    }

    /// Checks what needs the whole file, and counts.
    fn finish(mut self, mut seen: Seen, path: &Path) -> Result<Self, LoadError> {
        let vertex_count = seen.is_vertex_used.len();
        for pending in &seen.pending {
            let count = match pending.what {
                elements::VERTEX => vertex_count,
                // Without any normal in the file tobj ignores their indices, and normals are computed.
                _ if seen.normal_count == 0 => continue,
                _ => seen.normal_count,
            };
            let place = usize::try_from(pending.index).unwrap_or(0);
            if !(1..=count).contains(&place) {
                return Err(LoadError::IndexOutOfRange {
                    path: path.into(),
                    place: format!("line {}", pending.line),
                    what: pending.what,
                    index: pending.index,
                    count,
                });
            }
            if pending.what == elements::VERTEX {
                seen.is_vertex_used[place - 1] = true;
            }
        }
        if seen.colored_count != 0 && seen.colored_count != vertex_count {
            return Err(LoadError::Malformed {
                path: path.into(),
                place: "v lines".into(),
                problem: format!(
                    "{} of {vertex_count} have a colour; give a colour to all or to none",
                    seen.colored_count
                ),
            });
        }
        let is_unused = |used: &&bool| !**used;
        self.unlisted_vertices = seen.is_vertex_used.iter().filter(is_unused).count() as u32;
        Ok(self)
    }

    /// What is left out of the mesh.
    pub(super) fn warnings(&self) -> Vec<String> {
        let mut warnings = Vec::new();
        if self.lines_and_points > 0 {
            warnings.push(format!("{} line and point elements (l, p) are left out", self.lines_and_points));
        }
        if let Some(first) = self.first_short_face {
            warnings.push(format!(
                "{} faces with fewer than three corners are left out; the first is line {first}",
                self.short_faces
            ));
        }
        if self.unusable_normals > 0 {
            warnings.push(format!(
                "{} vn lines are no three finite numbers; these normals are computed",
                self.unusable_normals
            ));
        }
        if let Some(first) = self.first_other_line {
            warnings.push(format!(
                "{} lines with unknown or unsupported keywords are left out; the first is line {first}",
                self.other_lines
            ));
        }
        warnings
    }
}
