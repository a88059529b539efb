//! A scene on the device, and the visibility that techniques and the tracer give its receivers.

use std::path::Path;

use contrejour_plan::{Light, ShadowSettings, Technique};
use contrejour_render::{Contestant, Gpu, Judge};
use contrejour_scene::Scene;
use contrejour_tests::gpu::{Equipment, render_gpu};
use contrejour_trace::{LightShape, OccluderMesh, Occluders, Receiver, TraceOptions, trace};
use glam::DVec3;

/// How carefully the truth is traced.
#[derive(Clone, Copy)]
pub enum Care {
    /// Far below the errors of techniques on scenes as theory likes them.
    Fine,
    /// Enough to tell a shadow from none.
    Coarse,
}

impl Care {
    fn options(self) -> TraceOptions {
        let (most_samples, target_error) = match self {
            Self::Fine => (256, 0.006),
            Self::Coarse => (16, 0.03),
        };
        TraceOptions { first_samples: 8, most_samples, target_error, ..TraceOptions::default() }
    }
}

/// One scene with what is asked of it.
pub struct JudgedScene {
    scene: Scene,
    judge: Judge,
    /// Pixels with a receiver that looks at the light, and the receiver for the tracer.
    receivers: Vec<(usize, Receiver)>,
}

/// An upright spot over a floor, and plates above it: every depth is even, as theory likes it.
pub fn plates(plates: &[(&str, &str)]) -> Result<JudgedScene, String> {
    let plate = |(size, place): &(&str, &str)| {
        format!("[[mesh]]\nshape = {{ kind = \"plane\", size = {size} }}\ntranslate = {place}\n")
    };
    let plates: String = plates.iter().map(plate).collect();
    let text = format!(
        "size = [160, 120]
        [camera]
        eye = [2.5, 3.2, 3.6]
        target = [0.1, 0.2, 0]
        fov_y_degrees = 42
        [light]
        kind = \"spot\"
        position = [0, 6, 0]
        target = [0, 0, 0]
        radius = 0.4
        cone_angle_degrees = 50
        near = 1
        far = 8
        [[mesh]]
        name = \"floor\"
        shape = {{ kind = \"plane\", size = [5, 5] }}
        {plates}"
    );
    JudgedScene::new(Scene::from_toml(&text, Path::new(""), "plates.toml").map_err(text_of)?)
}

impl JudgedScene {
    pub fn new(scene: Scene) -> Result<Self, String> {
        let judge = Judge::new(render_gpu(Equipment::Best)?, &scene).map_err(text_of)?;
        let receivers = judge.receivers().map_err(text_of)?;
        let local = judge.local_space();
        let seen_from = scene.camera.eye;
        let light = towards(&scene.lights[0].light);
        let mut listed = Vec::new();
        for (pixel, receiver) in receivers.points.iter().enumerate() {
            let Some(receiver) = receiver else { continue };
            let position = local.point_world(receiver.position.as_dvec3());
            // A side averted from the light is dark by shading alone.
            if receiver.normal.as_dvec3().dot(light(position)) > 0.0 {
                listed.push((pixel, Receiver { position, face: receiver.face_id, seen_from }));
            }
        }
        Ok(Self { scene, judge, receivers: listed })
    }

    pub fn light(&self) -> &Light {
        &self.scene.lights[0].light
    }

    /// Keeps the receivers of the scene's first mesh.
    pub fn keep_floor(&mut self) {
        let faces = self.scene.meshes[0].mesh.triangles.len() as u32;
        self.receivers.retain(|(_, receiver)| receiver.face < faces);
    }

    pub fn receivers(&self) -> impl Iterator<Item = &Receiver> {
        self.receivers.iter().map(|(_, receiver)| receiver)
    }

    /// Of each receiver, its pixel.
    pub fn pixels(&self) -> impl Iterator<Item = usize> {
        self.receivers.iter().map(|(pixel, _)| *pixel)
    }

    /// The truth under a light, one value a receiver.
    pub fn truth(&self, light: &Light, care: Care) -> Result<Vec<f64>, String> {
        let meshes = self.scene.meshes.iter().map(|placed| OccluderMesh {
            casts: placed.casts,
            ..OccluderMesh::new(&placed.mesh.positions, &placed.mesh.triangles, placed.world_from_object)
        });
        let occluders = Occluders::new(&meshes.collect::<Vec<_>>()).map_err(text_of)?;
        let receivers: Vec<Receiver> = self.receivers().copied().collect();
        let shape = LightShape::of(light).map_err(text_of)?;
        let traced = trace(&occluders, &shape, &receivers, &care.options(), &|_| ()).map_err(text_of)?;
        Ok(traced.iter().map(|visibility| visibility.mean).collect())
    }

    /// What a technique makes of it, one value a receiver.
    pub fn visibility(&self, settings: &ShadowSettings) -> Result<Vec<f64>, String> {
        Ok(self.drawn(settings)?.0)
    }

    /// As [`visibility`](Self::visibility), with the technique itself: its maps are still there.
    pub fn drawn(&self, settings: &ShadowSettings) -> Result<(Vec<f64>, Contestant), String> {
        let mut contestant = self.judge.contestant(settings).map_err(text_of)?;
        Ok((self.under(&mut contestant, self.light())?, contestant))
    }

    /// What a technique makes of it under each of some lights of the scene's own kind.
    pub fn visibilities(&self, settings: &ShadowSettings, lights: &[Light]) -> Result<Vec<Vec<f64>>, String> {
        let mut contestant = self.judge.contestant(settings).map_err(text_of)?;
        lights.iter().map(|light| self.under(&mut contestant, light)).collect()
    }

    fn under(&self, contestant: &mut Contestant, light: &Light) -> Result<Vec<f64>, String> {
        contestant.draw(light).map_err(text_of)?;
        let visibility = contestant.visibility().map_err(text_of)?;
        Ok(self.receivers.iter().map(|(pixel, _)| f64::from(visibility[*pixel])).collect())
    }

    pub fn gpu(&self) -> &Gpu {
        self.judge.gpu()
    }
}

/// The direction towards a light's middle from a point.
fn towards(light: &Light) -> impl Fn(DVec3) -> DVec3 + use<> {
    let view = contrejour_plan::views(light).expect("the lights of the tests are good")[0];
    let light = view.light_world;
    move |position| light.truncate() - light.w * position
}

/// A technique of a name, tuned.
pub fn settings(technique: &str, parameters: &[(&str, f64)], map_size: u32) -> ShadowSettings {
    let mut technique: Technique = technique.parse().expect("listed");
    for (name, value) in parameters {
        technique.set(name, *value).expect("in range");
    }
    ShadowSettings { technique, map_size, ..ShadowSettings::default() }
}

pub fn rmse(found: &[f64], wanted: &[f64]) -> f64 {
    let squares: f64 = found.iter().zip(wanted).map(|(found, wanted)| (found - wanted).powi(2)).sum();
    (squares / found.len() as f64).sqrt()
}

pub fn text_of(error: impl std::error::Error) -> String {
    error.to_string()
}

/// Whether each of the errors is less than the one before, and the last at most `most`.
pub fn falls_to(most: f64, errors: &[f64]) -> Result<(), String> {
    let falls = errors.windows(2).all(|pair| pair[1] < pair[0]);
    // Positive, so that NaN is no success.
    if falls && errors.last().is_some_and(|last| *last <= most) {
        return Ok(());
    }
    Err(format!("the errors {errors:.4?} do not fall to {most}"))
}
