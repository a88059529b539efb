//! What an eye sees of a case: visibility against the ray-traced truth, and the shaded picture.

use std::io::Cursor;
use std::sync::Arc;

use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use contrejour_mesh::TriangleMesh;
use contrejour_render::Gpu;
use contrejour_scene::{Camera, Material, MeshSource, Scene, SceneLight, SceneMesh};
use contrejour_trace::TraceOptions;
use image::{ImageFormat, RgbaImage};

use super::case::{Case, CaseMesh};
use super::checks::non_finite;
use super::error::CaseError;
use crate::metrics::error_figures;
use crate::report::visibility_picture;
use crate::run::{NamedScene, RunError, Subject, is_fair};

/// Width and height of the picture, in pixels.
const SIZE: [u32; 2] = [96, 72];

/// Ten times as exact as what is compared with it.
const TRUTH: TraceOptions =
    TraceOptions { seed: 0, replicates: 8, first_samples: 8, most_samples: 64, target_error: 0.01 };

/// What was seen.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Sight {
    /// RMSE of visibility over the receivers that lie in the light's maps and have the whole light above their plane;
    /// none where there are none.
    pub visibility_error: Option<f64>,
    /// Numbers that are not finite, in visibility and in the shaded picture.
    pub non_finite: u64,
    /// The truth and the technique, PNG pictures as addresses that hold them.
    pub pictures: [String; 2],
}

/// Looks at a case; none where no surface is in the picture.
pub(super) fn look(gpu: &Gpu, case: &Case, camera: Camera) -> Result<Option<Sight>, CaseError> {
    let scene = NamedScene { name: case.parameter.clone(), scene: scene(case, camera) };
    let subject = match Subject::new(gpu, &scene, SIZE) {
        Err(RunError::NothingToCompare { .. }) => return Ok(None),
        subject => subject?,
    };
    let mut contestant = subject.judge.contestant(&case.settings).map_err(RunError::from)?;
    contestant.draw(&case.light).map_err(RunError::from)?;
    let visibility = contestant.visibility()?;

    // The truth, where it means the same as the technique.
    let pixels = subject.pixel_count();
    let (mut truth, mut compared) = (vec![1.0; pixels], vec![false; pixels]);
    let answers = subject.trace(&case.light, &TRUTH, 1, &|_| ())?;
    let in_maps = subject.in_maps(&case.light)?;
    for ((&pixel, answer), in_maps) in subject.pixels().iter().zip(&answers).zip(in_maps) {
        truth[pixel] = answer.mean as f32;
        compared[pixel] = in_maps && is_fair(answer);
    }

    let mut sight = Sight { non_finite: non_finite(&visibility), ..Sight::default() };
    if sight.non_finite == 0 {
        let shaded = subject.judge.compose_floats(&case.light, &visibility).map_err(RunError::from)?;
        sight.non_finite = non_finite(shaded.as_flattened());
        sight.visibility_error = error_figures(&truth, &visibility, &compared)?.map(|figures| figures.rmse);
    }
    let seen: Vec<bool> = (0..pixels).map(|pixel| subject.pixels().binary_search(&pixel).is_ok()).collect();
    sight.pictures =
        [png(&visibility_picture(SIZE, &truth, &seen)?)?, png(&visibility_picture(SIZE, &visibility, &seen)?)?];
    Ok(Some(sight))
}

/// The case as a scene in which everything casts and receives.
fn scene(case: &Case, camera: Camera) -> Scene {
    Scene {
        camera,
        size: SIZE,
        meshes: case.meshes.iter().map(placed).collect(),
        lights: vec![SceneLight::new(case.light, case.settings)],
        exposure_ev100: 0.0,
        ambient: Scene::DEFAULT_AMBIENT,
        background: Scene::DEFAULT_BACKGROUND,
        warnings: Vec::new(),
    }
}

fn placed(mesh: &CaseMesh) -> SceneMesh {
    let vertices = mesh.positions.len();
    let triangles = TriangleMesh {
        positions: mesh.positions.clone(),
        // None: faces are shaded flat.
        normals: vec![[0.0; 3]; vertices],
        colors: vec![TriangleMesh::DEFAULT_COLOR; vertices],
        triangles: mesh.triangles.clone(),
        ..TriangleMesh::default()
    };
    SceneMesh {
        name: String::new(),
        source: MeshSource::Given,
        mesh: Arc::new(triangles),
        world_from_object: mesh.world_from_object,
        material: Material::default(),
        casts: true,
        receives: true,
    }
}

fn png(picture: &RgbaImage) -> Result<String, CaseError> {
    let mut bytes = Cursor::new(Vec::new());
    picture.write_to(&mut bytes, ImageFormat::Png)?;
    Ok(format!("data:image/png;base64,{}", STANDARD.encode(bytes.into_inner())))
}
