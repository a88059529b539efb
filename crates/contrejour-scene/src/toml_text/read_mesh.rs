//! The sections `mesh`, and `shape` within.

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use contrejour_mesh::{LoadError, MeshFile};
use glam::{DMat4, DQuat, DVec3, EulerRot};

use super::section::Section;
use super::value::{ANY, NOT_ZERO, SHARE, Value};
use crate::scene::placed_meshes;
use crate::shapes::Shape;
use crate::{Material, MeshSource, Problem, Scene, SceneError, SceneMesh};

pub(super) const MESH_KEYS: &[&str] =
    &["name", "shape", "file", "translate", "rotate_degrees", "scale", "base_color", "casts", "receives"];
const SHAPE_KINDS: &[&str] = &["plane", "box", "cylinder", "sphere", "torus", "knot", "fence", "elephant"];
/// Keys of each kind, in the order of [`SHAPE_KINDS`].
const SHAPE_KEYS: [&[&str]; 8] = [
    &["kind", "size", "segments"],
    &["kind", "size"],
    &["kind", "radius", "height", "segments"],
    &["kind", "radius", "segments"],
    &["kind", "radius", "tube_radius", "segments", "sides"],
    &["kind", "radius", "tube_radius", "segments", "sides"],
    &["kind", "size", "columns", "rows", "bar"],
    &["kind", "height", "segments"],
];
const ALL_SHAPE_KEYS: &[&str] =
    &["kind", "size", "segments", "radius", "height", "tube_radius", "sides", "columns", "rows", "bar"];

/// Gives the meshes of a file.
pub(super) type LoadMeshes<'a> = dyn Fn(&Path) -> Result<MeshFile, LoadError> + 'a;

/// The meshes of sections, and what is known of those before.
pub(super) struct MeshReader<'a> {
    base_dir: &'a Path,
    load: &'a LoadMeshes<'a>,
    files: HashMap<PathBuf, Vec<SceneMesh>>,
    shape_triangles: usize,
    /// What the loaders warn about.
    pub warnings: Vec<String>,
}

impl<'a> MeshReader<'a> {
    /// A reader of files in `base_dir`.
    pub fn new(base_dir: &'a Path, load: &'a LoadMeshes<'a>) -> Self {
        Self { base_dir, load, files: HashMap::new(), shape_triangles: 0, warnings: Vec::new() }
    }

    /// The meshes of one section, one or as many as its file has.
    pub fn read(&mut self, section: &Section<'_>) -> Result<Vec<SceneMesh>, SceneError> {
        let mut meshes = match (section.get("shape"), section.get("file")) {
            (Some(shape), None) => vec![self.generated(&shape)?],
            (None, Some(file)) => self.loaded(&file)?,
            (None, None) => return Err(section.refuse(Problem::ShapeOrFile)),
            (Some(_), Some(_)) => return Err(section.refuse_key("file", Problem::ShapeOrFile)),
        };
        let world_from_section = read_placement(section)?;
        let name = section.get("name").map(|value| value.text()).transpose()?;
        let base_color = section.get("base_color").map(|value| value.color(SHARE)).transpose()?;
        let casts = section.read_or("casts", true, Value::flag)?;
        let receives = section.read_or("receives", true, Value::flag)?;
        for mesh in &mut meshes {
            if let Some(name) = name {
                mesh.name = name.to_owned();
            }
            mesh.world_from_object = world_from_section * mesh.world_from_object;
            mesh.material = Material { base_color };
            mesh.casts = casts;
            mesh.receives = receives;
        }
        Ok(meshes)
    }

    /// The meshes of a file, which sections that name the same file share.
    fn loaded(&mut self, file: &Value<'_>) -> Result<Vec<SceneMesh>, SceneError> {
        let name = file.text()?;
        if name.contains(char::is_control) {
            return Err(file.refuse(Problem::FileName));
        }
        let path = self.base_dir.join(name);
        if let Some(meshes) = self.files.get(&path) {
            return Ok(meshes.clone());
        }
        let mut loaded = (self.load)(&path).map_err(|error| file.refuse(error.into()))?;
        self.warnings.append(&mut loaded.warnings);
        let meshes = placed_meshes(loaded, &MeshSource::File(path.clone()));
        self.files.insert(path, meshes.clone());
        Ok(meshes)
    }

    fn generated(&mut self, value: &Value<'_>) -> Result<SceneMesh, SceneError> {
        let shape = read_shape(value)?;
        let mesh = shape.generate().map_err(|error| {
            let section = value.section("the shape", ALL_SHAPE_KEYS);
            match section {
                Ok(section) => section.refuse_key(error.parameter(), error.into()),
                Err(_) => value.refuse(error.into()),
            }
        })?;
        self.shape_triangles += mesh.triangles.len();
        if self.shape_triangles > Scene::MAX_SHAPE_TRIANGLES {
            return Err(value.refuse(Problem::TooManyShapeTriangles));
        }
        Ok(SceneMesh {
            name: shape.kind().to_owned(),
            source: MeshSource::Shape(shape),
            mesh: Arc::new(mesh),
            world_from_object: DMat4::IDENTITY,
            material: Material::default(),
            casts: true,
            receives: true,
        })
    }
}

/// First scaled, then turned about x, then y, then z, then moved.
fn read_placement(section: &Section<'_>) -> Result<DMat4, SceneError> {
    let scale = section.read_or("scale", DVec3::ONE, |value| {
        Ok(if value.is_array() { value.numbers(NOT_ZERO)?.into() } else { DVec3::splat(value.number(NOT_ZERO)?) })
    })?;
    let [x, y, z] = section.read_or("rotate_degrees", [0.0; 3], |value| value.numbers(ANY))?.map(f64::to_radians);
    let rotation = DQuat::from_euler(EulerRot::ZYX, z, y, x);
    let translation = DVec3::from(section.read_or("translate", [0.0; 3], |value| value.numbers(ANY))?);
    Ok(DMat4::from_scale_rotation_translation(scale, rotation, translation))
}

fn read_shape(value: &Value<'_>) -> Result<Shape, SceneError> {
    let kind = value.section("the shape", ALL_SHAPE_KEYS)?.require("kind")?.name_of(SHAPE_KINDS)?;
    let section = value.section(&format!("the shape \"{}\"", SHAPE_KINDS[kind]), SHAPE_KEYS[kind])?;
    let length = |key, default| section.read_or(key, default, |value| value.number(ANY));
    let count = |key, default| section.read_or(key, default, Value::count);
    Ok(match SHAPE_KINDS[kind] {
        "plane" => Shape::Plane {
            size: section.read_or("size", [10.0; 2], |value| value.numbers(ANY))?,
            segments: count("segments", 1)?,
        },
        "box" => Shape::Box { size: section.read_or("size", [1.0; 3], |value| value.numbers(ANY))? },
        "cylinder" => Shape::Cylinder {
            radius: length("radius", 0.5)?,
            height: length("height", 1.0)?,
            segments: count("segments", 96)?,
        },
        "sphere" => Shape::Sphere { radius: length("radius", 0.5)?, segments: count("segments", 64)? },
        "torus" => Shape::Torus {
            radius: length("radius", 1.0)?,
            tube_radius: length("tube_radius", 0.35)?,
            segments: count("segments", 128)?,
            sides: count("sides", 48)?,
        },
        "knot" => Shape::Knot {
            radius: length("radius", 1.0)?,
            tube_radius: length("tube_radius", 0.22)?,
            segments: count("segments", 320)?,
            sides: count("sides", 40)?,
        },
        "fence" => Shape::Fence {
            size: section.read_or("size", [4.0, 2.0, 0.04], |value| value.numbers(ANY))?,
            columns: count("columns", 32)?,
            rows: count("rows", 16)?,
            bar: length("bar", 0.04)?,
        },
        _ => Shape::Elephant { height: length("height", 2.0)?, segments: count("segments", 48)? },
    })
}
