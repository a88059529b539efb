//! Mesh files that bring cameras and lights of their own.

use std::f64::consts::PI;

use contrejour_mesh::{FileCamera, FileLight, FileLightKind, MeshFile, Pose, PoseError};
use contrejour_plan::{Light, LightKind, ShadowSettings};
use glam::DVec3;

use crate::framing::{camera_depths, depths_all_around, frame_within, light_depths, sun_extents, with_some_size};
use crate::scene_light::SUN_ANGULAR_RADIUS_DEGREES;
use crate::{Bounds, Camera, Scene, SceneLight, SceneMesh};

/// The widest cone that a shadow map can show.
const WIDEST_CONE_DEGREES: f64 = 179.0;

/// A mesh file has no camera of a name.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("there is no camera {name:?}; {}", known_names(known))]
pub struct UnknownCamera {
    /// The name that was given.
    pub name: String,
    /// The names of the file's cameras.
    pub known: Vec<String>,
}

fn known_names(known: &[String]) -> String {
    match known {
        [] => "the file has none: leave the name out".to_owned(),
        known => format!("give one of {}", known.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ")),
    }
}

/// What of a file's cameras and lights a scene takes.
#[derive(Clone, Debug, Default)]
pub(crate) struct FileView {
    camera: Option<FileCamera>,
    lights: Vec<FileLight>,
}

impl FileView {
    /// All lights, and the camera of a name, or else the first; a camera without a name has its number, from 0.
    pub fn of(file: &MeshFile, camera: Option<&str>) -> Result<Self, UnknownCamera> {
        let names = file.cameras.iter().enumerate().map(|(number, camera)| match &camera.name[..] {
            "" => number.to_string(),
            name => name.to_owned(),
        });
        let names: Vec<String> = names.collect();
        let index = match camera {
            None => 0,
            Some(name) => match names.iter().position(|known| known == name) {
                Some(index) => index,
                None => return Err(UnknownCamera { name: name.to_owned(), known: names }),
            },
        };
        Ok(Self { camera: file.cameras.get(index).cloned(), lights: file.lights.clone() })
    }

    /// The same where the nodes are in a pose; lights that no scene takes stay where they are.
    pub fn posed(&self, pose: &Pose, time: f64) -> Result<Self, PoseError> {
        let at = |node: usize| move |source| PoseError::Outlook { node, time, source };
        let matrix = |node: usize| &pose.world_from_nodes[node];
        let camera = self.camera.as_ref().map(|seen| seen.seen_from(matrix(seen.node)).map_err(at(seen.node)));
        let mut posed = self.clone();
        posed.camera = camera.transpose()?;
        for light in posed.lights.iter_mut().take(Scene::MAX_LIGHTS) {
            *light = light.shining_from(matrix(light.node)).map_err(at(light.node))?;
        }
        Ok(posed)
    }

    /// The camera and the lights alone of the scene that it makes; none of what the file does not bring.
    pub fn seen_and_lit(&self, bounds: Bounds) -> (Option<Camera>, Vec<Light>) {
        let bounds = with_some_size(bounds);
        let used = &self.lights[..self.lights.len().min(Scene::MAX_LIGHTS)];
        // They were told when the scene was made.
        let mut warnings = Vec::new();
        let lights = used.iter().map(|light| shining(light, &bounds, &mut warnings).light).collect();
        (self.camera.as_ref().map(|camera| seen_by(camera, &bounds)), lights)
    }

    /// A scene of the file's meshes. What a file with a camera or lights does not bring is as it is around a lone mesh,
    /// but for the floor: where its author looks from, or what shines, nothing is added.
    pub fn scene(&self, meshes: Vec<SceneMesh>, bounds: Bounds) -> Scene {
        let count = meshes.len();
        let mut scene = frame_within(meshes, bounds);
        if self.camera.is_some() || !self.lights.is_empty() {
            scene.meshes.truncate(count);
        }
        let bounds = with_some_size(bounds);
        if let Some(camera) = &self.camera {
            scene.camera = seen_by(camera, &bounds);
        }
        if self.lights.is_empty() {
            return scene;
        }
        let (used, left) = self.lights.split_at(self.lights.len().min(Scene::MAX_LIGHTS));
        if !left.is_empty() {
            let most = Scene::MAX_LIGHTS;
            scene.warnings.push(format!("{} lights are left out; a scene has {most} at most", left.len()));
        }
        let lights = used.iter().map(|light| shining(light, &bounds, &mut scene.warnings));
        scene.lights = lights.collect();
        scene.exposure_ev100 = exposure(used, &bounds);
        scene
    }
}

/// How far ahead what is looked at is: the middle of the meshes, where it is ahead; never so near that it is lost beside
/// the coordinates of the eye.
fn ahead(bounds: &Bounds, eye: DVec3, forward: DVec3, least: f64) -> f64 {
    (bounds.center() - eye).dot(forward).max(least).max(1e-6 * eye.abs().max_element())
}

fn seen_by(camera: &FileCamera, bounds: &Bounds) -> Camera {
    let &FileCamera { eye, forward, up, fov_y, near, far, .. } = camera;
    let far = far.unwrap_or_else(|| camera_depths(bounds, eye, forward)[1].max(2.0 * near));
    Camera { eye, target: eye + ahead(bounds, eye, forward, near) * forward, up, fov_y, near, far }
}

fn shining(light: &FileLight, bounds: &Bounds, warnings: &mut Vec<String>) -> SceneLight {
    // What is beyond the light's range is not lit, so no map needs to reach there.
    let within = |[near, far]: [f64; 2]| [near, far.min(light.range.unwrap_or(far).max(2.0 * near))];
    let mut inner_cone_angle = None;
    let kind = match light.kind {
        FileLightKind::Directional { direction } => {
            let [half_extent, half_depth] = sun_extents(bounds, bounds.center(), -direction);
            LightKind::Directional {
                towards_light: -direction,
                center: bounds.center(),
                half_extent,
                half_depth,
                angular_radius: SUN_ANGULAR_RADIUS_DEGREES.to_radians(),
            }
        }
        FileLightKind::Point { position } => {
            let [near, far] = within(depths_all_around(bounds, position));
            LightKind::Point { position, radius: 0.0, near, far }
        }
        FileLightKind::Spot { position, direction, inner_half_angle, outer_half_angle } => {
            let [near, far] = within(light_depths(bounds, position, direction));
            let widest = WIDEST_CONE_DEGREES.to_radians();
            if 2.0 * outer_half_angle > widest {
                let name = &light.name;
                warnings.push(format!(
                    "light {name:?}: its cone is cut to {WIDEST_CONE_DEGREES} degrees, so that it fits a map"
                ));
            }
            let cone_angle = (2.0 * outer_half_angle).min(widest);
            inner_cone_angle = Some((2.0 * inner_half_angle).min(cone_angle));
            let target = position + ahead(bounds, position, direction, near) * direction;
            LightKind::Spot { position, target, cone_angle, radius: 0.0, near, far }
        }
    };
    let of_kind = SceneLight::new(Light { kind, color: light.color }, ShadowSettings::default());
    let name = if light.name.is_empty() { of_kind.name.clone() } else { light.name.clone() };
    let has_range = !matches!(light.kind, FileLightKind::Directional { .. });
    SceneLight {
        name,
        intensity: Some(light.intensity),
        range: light.range.filter(|_| has_range),
        inner_cone_angle,
        ..of_kind
    }
}

/// The exposure in which a white surface in the middle of the meshes that faces all lights is white.
fn exposure(lights: &[FileLight], bounds: &Bounds) -> f64 {
    let nearest = 0.1 * bounds.size().max_element();
    let illuminance = |light: &FileLight| {
        let strength = light.intensity * f64::from(light.color.into_iter().fold(0.0, f32::max));
        match light.kind {
            FileLightKind::Directional { .. } => strength,
            FileLightKind::Point { position } | FileLightKind::Spot { position, .. } => {
                strength / position.distance(bounds.center()).max(nearest).powi(2)
            }
        }
    };
    let luminance = lights.iter().map(illuminance).sum::<f64>() / PI;
    // Of `Scene::exposure_ev100`.
    let ev100 = (luminance / 1.2).log2();
    if luminance > 0.0 && ev100.is_finite() {
        ev100.clamp(-Scene::MAX_EXPOSURE_EV100, Scene::MAX_EXPOSURE_EV100)
    } else {
        0.0
    }
}

#[cfg(test)]
mod tests {
    use contrejour_mesh::TriangleMesh;

    use super::*;

    fn camera(name: &str) -> FileCamera {
        FileCamera {
            name: name.to_owned(),
            node: 0,
            eye: DVec3::new(0.0, 1.0, 5.0),
            forward: DVec3::NEG_Z,
            up: DVec3::Y,
            fov_y: 0.8,
            near: 0.1,
            far: None,
        }
    }

    fn light(kind: FileLightKind) -> FileLight {
        FileLight { name: String::new(), node: 0, kind, color: [1.0, 0.5, 0.25], intensity: 100.0, range: Some(20.0) }
    }

    fn file(cameras: Vec<FileCamera>, lights: Vec<FileLight>) -> MeshFile {
        let mesh = TriangleMesh {
            positions: vec![[-1.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 2.0, 1.0]],
            triangles: vec![[0, 1, 2]],
            ..TriangleMesh::default()
        };
        MeshFile { cameras, lights, ..MeshFile::single(mesh, Vec::new()) }
    }

    #[test]
    fn a_file_without_any_stands_on_a_floor() {
        let scene = Scene::around(file(vec![], vec![]));
        assert_eq!((scene.meshes.len(), scene.lights.len(), scene.lights[0].intensity), (2, 1, None));
    }

    #[test]
    fn cameras_are_chosen_by_name() {
        let file = file(vec![camera(""), camera("door")], vec![]);
        let seen = |name| FileView::of(&file, name).map(|view| view.camera.map(|camera| camera.name));
        assert_eq!(seen(None), Ok(Some(String::new())));
        assert_eq!(seen(Some("0")), Ok(Some(String::new())));
        assert_eq!(seen(Some("door")), Ok(Some("door".to_owned())));
        let told = seen(Some("roof")).expect_err("there is none").to_string();
        assert_eq!(told, r#"there is no camera "roof"; give one of "0", "door""#);
    }

    #[test]
    fn a_camera_looks_where_it_looked() {
        let scene = Scene::around(file(vec![camera("")], vec![]));
        assert_eq!((scene.meshes.len(), scene.lights.len()), (1, 1));
        assert_eq!((scene.camera.eye, scene.camera.target), (DVec3::new(0.0, 1.0, 5.0), DVec3::new(0.0, 1.0, 0.0)));
        assert_eq!((scene.camera.fov_y, scene.camera.near), (0.8, 0.1));
        assert!(scene.camera.far > 6.0, "{}", scene.camera.far);
    }

    #[test]
    fn lights_keep_their_units() {
        let position = DVec3::new(0.0, 5.0, 0.0);
        let spot = FileLightKind::Spot {
            position,
            direction: DVec3::NEG_Y,
            inner_half_angle: 0.1,
            outer_half_angle: 0.5 * PI,
        };
        let kinds = [FileLightKind::Directional { direction: DVec3::NEG_Y }, FileLightKind::Point { position }, spot];
        let scene = Scene::around(file(vec![], kinds.map(light).to_vec()));
        assert_eq!(scene.meshes.len(), 1);
        for light in &scene.lights {
            light.validate().unwrap_or_else(|error| panic!("{error}"));
            assert_eq!((light.intensity, light.light.color), (Some(100.0), [1.0, 0.5, 0.25]));
        }
        let [sun, lamp, spot] = &scene.lights[..] else { panic!("three lights") };
        assert_eq!([&sun.name, &lamp.name, &spot.name], ["directional", "point", "spot"]);
        assert_eq!([sun.range, lamp.range, spot.range], [None, Some(20.0), Some(20.0)]);
        assert_eq!(spot.inner_cone_angle, Some(0.2));
        assert!(matches!(spot.light.kind, LightKind::Spot { target, .. } if target == DVec3::new(0.0, 1.0, 0.0)));
        assert!(scene.warnings.iter().any(|warning| warning.contains("179 degrees")), "{:?}", scene.warnings);
    }

    #[test]
    fn white_is_white_in_the_middle() {
        let lamp = |height: f64| light(FileLightKind::Point { position: DVec3::new(0.0, 1.0 + height, 0.0) });
        let ev100 = |lights: Vec<FileLight>| Scene::around(file(vec![], lights)).exposure_ev100;
        // 100 candela at 2 m are 25 lux, of which a white surface sheds 25 / pi.
        assert!((ev100(vec![lamp(2.0)]) - (25.0 / PI / 1.2).log2()).abs() < 1e-12);
        assert!((ev100(vec![lamp(2.0), lamp(2.0)]) - ev100(vec![lamp(2.0)]) - 1.0).abs() < 1e-12);
        assert_eq!(ev100(vec![FileLight { intensity: 0.0, ..lamp(2.0) }]), 0.0);
    }
}
