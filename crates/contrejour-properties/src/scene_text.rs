//! A text as a scene file: refused in one line with its place, or a scene that all that follows can rely on.

use std::io;
use std::path::Path;

use contrejour_mesh::{MeshFile, ReadFileError, TriangleMesh};
use contrejour_scene::{Scene, SceneError};
use glam::DVec3;

use crate::mesh_file::assert_one_line;

/// Reads a text as a scene file; `None` where it is refused. No file is opened: each mesh file is one triangle, but
/// for those whose name has `missing`.
///
/// # Panics
///
/// When a refusal has more or less than one line or is at no place of the text, or when the scene is not as its type
/// says.
pub fn check_scene_text(text: &str) -> Option<usize> {
    let load = |path: &Path| match path.to_string_lossy().contains("missing") {
        true => Err(ReadFileError::System { path: path.into(), source: io::ErrorKind::NotFound.into() }.into()),
        false => Ok(one_triangle()),
    };
    match Scene::from_toml_with(text, Path::new("scenes"), "any.toml", &load) {
        Ok(scene) => {
            check_scene(&scene);
            Some(scene.meshes.iter().map(|mesh| mesh.mesh.triangles.len()).sum())
        }
        Err(error) => {
            assert_one_line(&error.to_string());
            if let SceneError::InFile { place, .. } = error {
                let lines = text.split('\n').count();
                assert!((1..=lines).contains(&place.line), "line {} of {lines}", place.line);
            }
            None
        }
    }
}

fn one_triangle() -> MeshFile {
    let positions = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
    let mut mesh = TriangleMesh {
        colors: vec![TriangleMesh::DEFAULT_COLOR; positions.len()],
        vertex_numbers: vec![0, 1, 2],
        triangles: vec![[0, 1, 2]],
        positions,
        ..TriangleMesh::default()
    };
    mesh.complete_normals();
    MeshFile::single(mesh, Vec::new())
}

/// What a frame is made of must be in its range.
pub(crate) fn check_scene(scene: &Scene) {
    assert!((1..=Scene::MAX_LIGHTS).contains(&scene.lights.len()), "{} lights", scene.lights.len());
    for light in &scene.lights {
        light.validate().unwrap_or_else(|error| panic!("{error}"));
    }
    assert!(scene.exposure().is_normal(), "{}", scene.exposure_ev100);
    assert!(scene.size.iter().all(|side| (1..=Scene::MAX_SIDE).contains(side)), "{:?}", scene.size);
    for color in [scene.ambient, scene.background] {
        assert!(color.iter().all(|&channel| channel >= 0.0 && channel.is_finite()), "{color:?}");
    }
    let camera = &scene.camera;
    assert!(0.0 < camera.near && camera.near < camera.far && camera.far.is_finite(), "{camera:?}");
    assert!(camera.clip_from_world(scene.aspect()).is_finite(), "{camera:?}");
    assert!(camera.up.cross(camera.target - camera.eye) != DVec3::ZERO, "{camera:?}");
    for mesh in &scene.meshes {
        assert!(mesh.world_from_object.is_finite(), "{} stands nowhere", mesh.name);
    }
}

#[cfg(test)]
mod tests {
    use contrejour_plan::LightKind;

    use super::*;
    use crate::planted::{Planted, assert_found};

    #[test]
    fn a_wrong_scene_is_found() {
        let good = Scene::around(one_triangle());
        check_scene(&good);
        let faults: [Planted<Scene>; 11] = [
            ("near is 0", |scene| {
                if let LightKind::Spot { near, .. } = &mut scene.lights[0].light.kind {
                    *near = 0.0;
                }
            }),
            ("map size", |scene| scene.lights[0].shadow.map_size = 0),
            ("0 lights", |scene| scene.lights.clear()),
            ("intensity", |scene| scene.lights[0].intensity = Some(-1.0)),
            ("inner cone", |scene| scene.lights[0].inner_cone_angle = Some(3.0)),
            ("2000", |scene| scene.exposure_ev100 = 2000.0),
            ("[0, ", |scene| scene.size[0] = 0),
            ("NaN", |scene| scene.ambient[2] = f32::NAN),
            ("Camera", |scene| scene.camera.near = scene.camera.far),
            ("Camera", |scene| scene.camera.up = scene.camera.eye - scene.camera.target),
            ("stands nowhere", |scene| scene.meshes[0].world_from_object.x_axis.y = f64::NAN),
        ];
        for (told, fault) in faults {
            let mut scene = good.clone();
            fault(&mut scene);
            assert_found(told, || check_scene(&scene));
        }
    }
}
