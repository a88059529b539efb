//! What a scene is.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use contrejour_mesh::{LoadError, MeshFile, TriangleMesh, read_file};
use contrejour_plan::{Eye, ShadowSettings};
use glam::{DMat4, DVec3};

use crate::file_scene::FileView;
use crate::shapes::Shape;
use crate::toml_text::read_scene;
use crate::{Bounds, NoLight, SceneError, SceneLight};

/// Everything that a picture needs.
#[derive(Clone, Debug)]
pub struct Scene {
    /// From where it is seen.
    pub camera: Camera,
    /// Width and height of the picture, in pixels. Range: 1 to [`Scene::MAX_SIDE`] each.
    pub size: [u32; 2],
    /// What is seen, what casts and what receives.
    pub meshes: Vec<SceneMesh>,
    /// What shines. Range: 0 to [`Scene::MAX_LIGHTS`]. What is about one light takes the [first](Scene::first_light).
    pub lights: Vec<SceneLight>,
    /// Exposure value at ISO 100, of lights that have an [intensity](SceneLight::intensity): a luminance of
    /// 1.2 2^EV cd/m^2 is white in the picture. Range: -64 to 64. Default: 0; a lit room at night has some 6, a sunny day
    /// 15.
    ///
    /// 1.2 is 78 / (100 * 0.65), from the saturation of a sensor behind a lens that lets 0.65 through (Lagarde & de
    /// Rousiers 2014, "Moving Frostbite to Physically Based Rendering", on the camera).
    pub exposure_ev100: f64,
    /// Linear light that is everywhere, on top of `lights`, as bright as it is in the picture. Range: 0 and up.
    pub ambient: [f32; 3],
    /// Linear colour where there is no mesh. Range: 0 and up.
    pub background: [f32; 3],
    /// What the loaders of mesh files left out, a line each.
    pub warnings: Vec<String>,
}

impl Scene {
    /// Most pixels along a side of a picture.
    pub const MAX_SIDE: u32 = 16_384;

    /// Most meshes of a scene.
    pub const MAX_MESHES: usize = 65_536;

    /// Most lights of a scene.
    pub const MAX_LIGHTS: usize = 256;

    /// The largest [`Scene::exposure_ev100`]; the least is its negative.
    pub const MAX_EXPOSURE_EV100: f64 = 64.0;

    /// The most bytes of a scene file: 16 MiB.
    pub const MAX_FILE_BYTES: u64 = 1 << 24;

    /// Most triangles that the generated shapes of a scene may have together.
    pub const MAX_SHAPE_TRIANGLES: usize = 1 << 24;

    /// Size of a picture where the scene does not say. Unit: pixels.
    pub const DEFAULT_SIZE: [u32; 2] = [1280, 720];

    /// [`Scene::ambient`] where the scene does not say.
    pub const DEFAULT_AMBIENT: [f32; 3] = [0.16, 0.17, 0.19];

    /// [`Scene::background`] where the scene does not say.
    pub const DEFAULT_BACKGROUND: [f32; 3] = [0.55, 0.6, 0.66];

    /// The scene in a file: a scene file (`.toml`), or a mesh file, whose meshes are put [on a floor](Scene::around).
    ///
    /// # Errors
    /// A file that cannot be read, a mistake in a scene file, or a mesh that cannot be loaded.
    pub fn open(path: &Path) -> Result<Self, SceneError> {
        Self::open_seen_by(path, None)
    }

    /// [`Scene::open`], seen by the camera of this name in a mesh file; one without a name has its number, from 0.
    ///
    /// # Errors
    /// As [`Scene::open`], where the file has no such camera, or where it is a scene file, which has one camera.
    pub fn open_seen_by(path: &Path, camera: Option<&str>) -> Result<Self, SceneError> {
        let is_scene = path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case("toml"));
        if !is_scene {
            let file = contrejour_mesh::load(path)?;
            let unknown = |source| SceneError::UnknownCamera { path: path.to_owned(), source };
            let view = FileView::of(&file, camera).map_err(unknown)?;
            return Ok(Self::of_file(file, &view, &MeshSource::File(path.to_owned())));
        }
        if camera.is_some() {
            return Err(SceneError::CameraOfScene { path: path.to_owned() });
        }
        let bytes = read_file(path, Self::MAX_FILE_BYTES)?;
        let text = String::from_utf8(bytes).map_err(|error| {
            let byte = error.utf8_error().valid_up_to();
            SceneError::NotText { path: path.to_owned(), byte }
        })?;
        Self::from_toml(&text, path.parent().unwrap_or(Path::new("")), &path.display().to_string())
    }

    /// The scene that a scene file describes; see [`scene_format`](crate::scene_format).
    ///
    /// Mesh files are looked for in `base_dir`; `file_name` is for messages.
    ///
    /// # Errors
    /// A mistake in the text, with its line, or a mesh that cannot be loaded.
    pub fn from_toml(text: &str, base_dir: &Path, file_name: &str) -> Result<Self, SceneError> {
        Self::from_toml_with(text, base_dir, file_name, &contrejour_mesh::load)
    }

    /// [`Scene::from_toml`] with the mesh files from `load`, which opens none itself; each path is asked for once.
    ///
    /// # Errors
    /// A mistake in the text, with its line, or what `load` refuses.
    pub fn from_toml_with(
        text: &str,
        base_dir: &Path,
        file_name: &str,
        load: &dyn Fn(&Path) -> Result<MeshFile, LoadError>,
    ) -> Result<Self, SceneError> {
        read_scene(text, base_dir, file_name, load)
    }

    /// Puts meshes on a floor under a spot light, all of it in the picture; a room is lit and seen from within.
    ///
    /// Where the file brings cameras, its first one sees the scene; where it brings lights, they shine, exposed so that a
    /// white surface amid the meshes that faces all of them is white. A file with either stands on no floor.
    ///
    /// Works for sizes from 1e-30 and places up to 1e15, and for flat and empty meshes. The shadow stays in the light's cone on every
    /// frame of an [orbit](crate::orbit).
    pub fn around(file: MeshFile) -> Self {
        let view = FileView::of(&file, None).unwrap_or_default();
        Self::of_file(file, &view, &MeshSource::Given)
    }

    fn of_file(file: MeshFile, view: &FileView, source: &MeshSource) -> Self {
        let mut warnings = file.warnings.clone();
        let meshes = placed_meshes(file, source);
        let bounds = meshes.iter().map(SceneMesh::bounds).fold(Bounds::EMPTY, Bounds::union);
        let mut scene = view.scene(meshes, bounds);
        warnings.append(&mut scene.warnings);
        Self { warnings, ..scene }
    }

    /// Bounds of all meshes in world space, floors included; empty when there is no vertex.
    pub fn bounds(&self) -> Bounds {
        self.meshes.iter().map(SceneMesh::bounds).fold(Bounds::EMPTY, Bounds::union)
    }

    /// The light for what is about one light: the first.
    ///
    /// # Errors
    /// [`NoLight`].
    pub fn first_light(&self) -> Result<&SceneLight, NoLight> {
        self.lights.first().ok_or(NoLight)
    }

    /// Makes the shadows of all lights in one way.
    pub fn set_shadow(&mut self, settings: &ShadowSettings) {
        self.lights.iter_mut().for_each(|light| light.shadow = *settings);
    }

    /// What a luminance of 1 cd/m^2 is in the picture, where 1 is white; follows from
    /// [`exposure_ev100`](Self::exposure_ev100).
    pub fn exposure(&self) -> f64 {
        (1.2 * self.exposure_ev100.exp2()).recip()
    }

    /// Gives the picture another size. A narrower one keeps what is seen from side to side, so it opens upwards.
    pub fn resize(&mut self, size: [u32; 2]) {
        let width_tangent = (0.5 * self.camera.fov_y).tan() * self.aspect();
        let old_aspect = self.aspect();
        self.size = size;
        if self.aspect() < old_aspect {
            self.camera.fov_y = 2.0 * (width_tangent / self.aspect()).atan();
        }
    }

    /// Width of the picture over its height.
    pub fn aspect(&self) -> f64 {
        f64::from(self.size[0]) / f64::from(self.size[1])
    }
}

/// A perspective camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// Where it is, world space.
    pub eye: DVec3,
    /// What it looks at, world space.
    pub target: DVec3,
    /// Which way is up, world space; not along the view.
    pub up: DVec3,
    /// Full vertical opening angle. Unit: radians. Range: more than 0 and less than pi.
    pub fov_y: f64,
    /// Nearest depth that is drawn, world units. Range: more than 0.
    pub near: f64,
    /// Farthest depth that is drawn, world units. Range: more than `near`.
    pub far: f64,
}

impl Camera {
    /// Eye space (right-handed, y up, looking along -z) from world space.
    pub fn eye_from_world(&self) -> DMat4 {
        glam::dcamera::rh::view::look_at_mat4(self.eye, self.target, self.up)
    }

    /// What cascades follow, for a picture that is `aspect` times as wide as high.
    pub fn as_eye(&self, aspect: f64) -> Eye {
        let &Self { eye: position, target, fov_y, near, far, .. } = self;
        Eye { position, forward: target - position, fov_y, aspect, near, far }
    }

    /// Clip space (z from 0 to 1) from world space.
    pub fn clip_from_world(&self, aspect: f64) -> DMat4 {
        glam::dcamera::rh::proj::directx::perspective(self.fov_y, aspect, self.near, self.far) * self.eye_from_world()
    }
}

/// A mesh in its place.
#[derive(Clone, Debug)]
pub struct SceneMesh {
    /// Its name in the scene, for messages.
    pub name: String,
    /// Where its triangles come from.
    pub source: MeshSource,
    /// Its triangles.
    pub mesh: Arc<TriangleMesh>,
    /// World space from the mesh's object space.
    pub world_from_object: DMat4,
    /// How it looks.
    pub material: Material,
    /// Whether it throws a shadow. Default: true. What throws none is in no map, so a shadow that falls on it is as
    /// soft at the contact as far away.
    pub casts: bool,
    /// Whether it takes shadows. Default: true.
    pub receives: bool,
}

impl SceneMesh {
    /// Its bounds in world space; empty when it has no vertex.
    pub fn bounds(&self) -> Bounds {
        Bounds::of(
            self.mesh
                .positions
                .iter()
                .map(|position| self.world_from_object.transform_point3(DVec3::from(position.map(f64::from)))),
        )
    }
}

/// Where the triangles of a mesh come from.
#[derive(Clone, Debug, PartialEq)]
pub enum MeshSource {
    /// Generated.
    Shape(Shape),
    /// Read from a file.
    File(PathBuf),
    /// Given by the caller.
    Given,
}

/// How a mesh looks.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Material {
    /// Linear base colour that replaces the mesh's own vertex colours and textures. Range: 0 to 1. Default: none, the mesh's own.
    pub base_color: Option<[f32; 3]>,
}

/// The meshes of a file where it puts them. A node that names no mesh of the file places nothing.
pub(crate) fn placed_meshes(file: MeshFile, source: &MeshSource) -> Vec<SceneMesh> {
    let meshes: Vec<Arc<TriangleMesh>> = file.meshes.into_iter().map(Arc::new).collect();
    let placed = file.nodes.iter().filter_map(|node| {
        let mesh = meshes.get(node.mesh)?;
        Some(SceneMesh {
            name: mesh.name.clone(),
            source: source.clone(),
            mesh: Arc::clone(mesh),
            world_from_object: node.world_from_object,
            material: Material::default(),
            casts: true,
            receives: true,
        })
    });
    placed.collect()
}
