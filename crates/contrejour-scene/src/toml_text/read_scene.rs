//! The whole file.

use std::path::Path;

use contrejour_plan::ShadowSettings;
use toml::de::DeTable;

use super::read_camera::read_camera;
use super::read_light::read_lights;
use super::read_mesh::{LoadMeshes, MESH_KEYS, MeshReader};
use super::read_shadow::read_shadow;
use super::section::{Document, Section};
use super::value::{EXPOSURE, NOT_NEGATIVE, Value};
use crate::{Bounds, Problem, Scene, SceneError, SceneMesh};

const SCENE_KEYS: &[&str] = &["size", "exposure_ev100", "ambient", "background", "camera", "light", "shadow", "mesh"];

pub(crate) fn read_scene(text: &str, base_dir: &Path, file_name: &str, load: &LoadMeshes) -> Result<Scene, SceneError> {
    let document = Document { file_name, text };
    let table = DeTable::parse(text).map_err(|error| document.refuse_syntax(&error))?;
    // What the scene as a whole lacks is told at its first line.
    let section = Section::new(document, "the scene", 0..0, table.get_ref(), SCENE_KEYS)?;
    let mut meshes: Vec<SceneMesh> = Vec::new();
    let mut reader = MeshReader::new(base_dir, load);
    for mesh in section.require("mesh")?.sections("a mesh", MESH_KEYS)? {
        meshes.extend(reader.read(&mesh)?);
        if meshes.len() > Scene::MAX_MESHES {
            return Err(mesh.refuse(Problem::TooManyMeshes));
        }
    }
    let bounds = meshes.iter().map(SceneMesh::bounds).fold(Bounds::EMPTY, Bounds::union);
    let color = |key, default| section.read_or(key, default, |value| value.color(NOT_NEGATIVE));
    let shadow = ShadowSettings::default();
    let shadow = section.read_or("shadow", shadow, |value| read_shadow(value, shadow))?;
    Ok(Scene {
        camera: read_camera(&section.require("camera")?, &bounds)?,
        lights: read_lights(&section.require("light")?, &bounds, shadow)?,
        exposure_ev100: section.read_or("exposure_ev100", 0.0, |value| value.number(EXPOSURE))?,
        size: section.read_or("size", Scene::DEFAULT_SIZE, read_size)?,
        ambient: color("ambient", Scene::DEFAULT_AMBIENT)?,
        background: color("background", Scene::DEFAULT_BACKGROUND)?,
        meshes,
        warnings: reader.warnings,
    })
}

fn read_size(value: &Value<'_>) -> Result<[u32; 2], SceneError> {
    let [width, height] = value.items::<2>("whole numbers")?;
    let (width, height) = (width.count()?, height.count()?);
    if [width, height].iter().all(|side| (1..=Scene::MAX_SIDE).contains(side)) {
        Ok([width, height])
    } else {
        Err(value.refuse(Problem::PictureSize { width, height }))
    }
}
