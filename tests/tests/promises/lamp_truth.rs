//! Shadows of a point light are as near to the truth beside the borders of the cube's faces as they are elsewhere.
//!
//! A wall, plates before it and a sphere of light. All of it is turned about the light again and again, and the faces of the
//! cube are not: so the truth stays, while borders run across other parts of the wall. A pixel of a penumbra is beside a
//! border in some turns and away from all in others, and is compared with itself: what makes one penumbra harder than
//! another is the same on both sides.

use std::f64::consts::PI;
use std::path::Path;

use contrejour_plan::{CubeFace, Light, LightKind, ShadowSettings, Technique, guard_ndc, views_with_guard};
use contrejour_scene::Scene;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::lights::through;
use contrejour_tests::random::Random;
use glam::{DMat4, DQuat, DVec3, Vec4Swizzles};
use libtest_mimic::Trial;

use crate::peers::judged_scene::{Care, JudgedScene, settings, text_of};

const SIZE: [u32; 2] = [320, 240];
const MAP_SIZE: u32 = 1024;

const RADIUS: f64 = 0.06;
const NEAR: f64 = 0.8;
const FAR: f64 = 12.0;

/// Turns at random, beside those that bring a face's middle, an edge and a corner of the cube before the wall.
const RANDOM_TURNS: usize = 2;

/// How far below the light the wall is.
const WALL: f64 = 4.0;

/// Points that a pixel shows before and after a turn are nearer to each other.
const SAME_PLACE: f64 = 1e-3;

/// Errors may be so many times as large beside borders: spheres are small to first order only.
const ROUNDING: f64 = 1.02;

pub fn trials() -> Vec<Trial> {
    vec![gpu_trial("lamp_truth::borders_are_as_near_to_the_truth", |_| borders_are_as_near_to_the_truth())]
}

/// The wall below the light, and plates between them.
fn scene(light: &str) -> Result<Scene, String> {
    let mut random = Random::new(11);
    let mut plates = String::new();
    for index in 0..16 {
        let mut about = |middle: f64, range: f64| middle + range * random.signed();
        let [x, z] = [index % 4, index / 4].map(|step| about(0.62 * f64::from(step) - 0.93, 0.2));
        let y = about(-1.75, 0.2);
        let turns = [about(0.0, 35.0), about(0.0, 180.0), about(0.0, 35.0)];
        plates.push_str(&format!(
            "[[mesh]]\nshape = {{ kind = \"plane\", size = [0.36, 0.3] }}\nrotate_degrees = {turns:?}\n\
             translate = [{x}, {y}, {z}]\n"
        ));
    }
    let text = format!(
        "size = {SIZE:?}
        [camera]
        eye = [3.6, -1.3, 2.6]
        target = [0, -4, 0]
        fov_y_degrees = 62
        near = 0.5
        far = 20
        [light]
        {light}
        [[mesh]]
        name = \"wall\"
        shape = {{ kind = \"plane\", size = [7, 7] }}
        translate = [0, -4, 0]
        {plates}"
    );
    Scene::from_toml(&text, Path::new(""), "wall.toml").map_err(text_of)
}

/// The scene turned about the light.
fn turned(light: &str, turn: DQuat) -> Result<JudgedScene, String> {
    let mut scene = scene(light)?;
    for placed in &mut scene.meshes {
        placed.world_from_object = DMat4::from_quat(turn) * placed.world_from_object;
    }
    let camera = &mut scene.camera;
    for vector in [&mut camera.eye, &mut camera.target, &mut camera.up] {
        *vector = turn * *vector;
    }
    JudgedScene::new(scene)
}

fn lamp() -> String {
    format!("kind = \"point\"\nposition = [0, 0, 0]\nradius = {RADIUS}\nnear = {NEAR}\nfar = {FAR}")
}

fn any_spot() -> String {
    format!("kind = \"spot\"\nposition = [0, 0, 0]\ntarget = [0, -1, 0]\nradius = {RADIUS}\nnear = {NEAR}\nfar = {FAR}")
}

/// From the wall's side of the cube to its faces, edges and corners.
fn turns() -> Vec<DQuat> {
    let down = -DVec3::Y;
    let towards = |direction: DVec3| DQuat::from_rotation_arc(down, direction.normalize());
    let mut turns = vec![
        DQuat::IDENTITY,
        towards(DVec3::new(0.0, -1.0, 1.0)),
        towards(DVec3::new(1.0, -1.0, 0.0)),
        towards(DVec3::new(1.0, 1.0, 1.0)),
        towards(DVec3::new(-1.0, -1.0, 1.0)),
    ];
    let mut random = Random::new(5);
    let mut number = || random.signed();
    turns.extend((0..RANDOM_TURNS).map(|_| DQuat::from_xyzw(number(), number(), number(), number()).normalize()));
    turns
}

/// What is done with the lamp: the technique as it is, or with a fault.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Way {
    Sound,
    /// A spot a face, whose disk takes the sphere's place.
    Disks,
    /// The same, and the border between faces is looked for where it is not.
    ShiftedBorders,
}

/// What each pixel should show.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Truth {
    /// Visibility of the sphere.
    Sphere,
    /// Visibility of its middle.
    Middle,
    /// What smoothies make of an edge where so much of the sphere is seen: nothing inside of the hard shadow, and outside
    /// the distance from it as a share of the penumbra's.
    AsSmoothies,
}

/// Mean errors in penumbrae.
#[derive(Clone, Copy, Debug)]
struct Errors {
    beside_borders: f64,
    elsewhere: f64,
    pixels: usize,
}

impl Errors {
    /// Beside borders they are not above those elsewhere, but for rounding.
    fn check(&self) -> Outcome {
        // Positive, so that NaN is no success.
        if self.pixels > 300 && self.beside_borders <= ROUNDING * self.elsewhere {
            return Ok(());
        }
        Err(format!("above the error elsewhere: {self:?}"))
    }
}

struct Wall {
    turned: Vec<Turned>,
    /// Of each pixel of the wall its place before any turn, and visibility of the sphere and of its middle.
    pixels: Vec<Option<(DVec3, [f64; 2])>>,
}

struct Turned {
    turn: DQuat,
    lamp: JudgedScene,
    spots: JudgedScene,
}

impl Wall {
    fn new() -> Result<Self, String> {
        let scenes = |turn| Ok(Turned { turn, lamp: turned(&lamp(), turn)?, spots: turned(&any_spot(), turn)? });
        let turned = turns().into_iter().map(scenes).collect::<Result<Vec<_>, String>>()?;
        let first = &turned[0].lamp;
        let LightKind::Point { position, near, far, .. } = first.light().kind else {
            return Err("the lamp is a point light".into());
        };
        let middle = Light { kind: LightKind::Point { position, radius: 0.0, near, far }, ..*first.light() };
        let truths = first.truth(first.light(), Care::Fine)?.into_iter().zip(first.truth(&middle, Care::Fine)?);
        let mut pixels = vec![None; (SIZE[0] * SIZE[1]) as usize];
        for ((pixel, receiver), (sphere, middle)) in first.pixels().zip(first.receivers()).zip(truths) {
            if receiver.position.y < -WALL + SAME_PLACE {
                pixels[pixel] = Some((receiver.position, [sphere, middle]));
            }
        }
        Ok(Self { turned, pixels })
    }

    fn errors(&self, settings: &ShadowSettings, truth: Truth, way: Way) -> Result<Errors, String> {
        // Beside borders, elsewhere: the sum of errors, and of how many turns.
        let mut of_pixels = vec![[(0.0, 0_u32); 2]; self.pixels.len()];
        for Turned { turn, lamp, spots } in &self.turned {
            let guard = guard_ndc(lamp.light(), settings);
            let views = views_with_guard(lamp.light(), guard).map_err(text_of)?;
            let (scene, lights) = match way {
                Way::Sound => (lamp, vec![*lamp.light()]),
                Way::Disks | Way::ShiftedBorders => (spots, views.iter().map(|view| through(view, RADIUS)).collect()),
            };
            let found = scene.visibilities(settings, &lights)?;
            // As wide as what faces share, or half a face.
            let band = guard.min(0.5 * (1.0 - guard));
            for (index, (receiver, pixel)) in scene.receivers().zip(scene.pixels()).enumerate() {
                let Some((unturned, [sphere, middle])) = self.pixels[pixel] else { continue };
                let position = receiver.position;
                // What a pixel at an edge shows, rounding decides.
                let is_same = position.distance(*turn * unturned) < SAME_PLACE;
                if !is_same || !(0.02..0.98).contains(&sphere) {
                    continue;
                }
                let truth = match truth {
                    Truth::Sphere => sphere,
                    Truth::Middle => middle,
                    Truth::AsSmoothies => distance_outside(sphere).max(0.0),
                };
                let face = CubeFace::of(position).index();
                let shown_by = match way {
                    Way::Sound => 0,
                    Way::Disks => face,
                    Way::ShiftedBorders => CubeFace::of(position * DVec3::new(1.0, 1.0, 1.3)).index(),
                };
                let clip = views[face].light_clip_from_world * position.extend(1.0);
                let from_border = 1.0 - guard - (clip.xy() / clip.w).abs().max_element();
                let (sum, count) = &mut of_pixels[pixel][usize::from(from_border > band)];
                *sum += (found[shown_by][index] - truth).abs();
                *count += 1;
            }
        }
        let both: Vec<_> = of_pixels.into_iter().filter(|sides| sides.iter().all(|(_, count)| *count > 0)).collect();
        let mean = |side: usize| {
            both.iter().map(|sides| sides[side].0 / f64::from(sides[side].1)).sum::<f64>() / both.len() as f64
        };
        Ok(Errors { beside_borders: mean(0), elsewhere: mean(1), pixels: both.len() })
    }
}

/// How far outside of a straight edge's hard shadow a point lies that sees a part of a small sphere, as a share of how far
/// the penumbra reaches: the sphere's silhouette is a disk, and the edge's image cuts it at that distance.
fn distance_outside(visible: f64) -> f64 {
    let seen = |d: f64| ((-d).acos() + d * (1.0 - d * d).sqrt()) / PI;
    let (mut low, mut high) = (-1.0, 1.0);
    for _ in 0..40 {
        let middle = 0.5 * (low + high);
        if seen(middle) < visible { low = middle } else { high = middle }
    }
    0.5 * (low + high)
}

fn borders_are_as_near_to_the_truth() -> Outcome {
    let wall = Wall::new()?;
    let errors = |technique: &str, truth, way| {
        let errors = wall.errors(&settings(technique, &[], MAP_SIZE), truth, way)?;
        println!("{technique}, {truth:?}, {way:?}: {errors:.4?}");
        Ok::<_, String>(errors)
    };
    for technique in Technique::NAMES {
        let truths = match technique {
            "smoothies" => &[Truth::Sphere, Truth::AsSmoothies][..],
            "pcss" | "vsm-pcss" | "evsm-pcss" => &[Truth::Sphere],
            _ => &[Truth::Middle],
        };
        for truth in truths {
            errors(technique, *truth, Way::Sound)?.check().map_err(|error| format!("{technique}: {error}"))?;
        }
    }
    let faults = [
        ("smoothies", Truth::AsSmoothies, Way::Disks),
        ("pcss", Truth::Sphere, Way::Disks),
        ("evsm-pcss", Truth::Sphere, Way::Disks),
        ("smoothies", Truth::AsSmoothies, Way::ShiftedBorders),
        ("shadow-map", Truth::Middle, Way::ShiftedBorders),
    ];
    for (technique, truth, way) in faults {
        if errors(technique, truth, way)?.check().is_ok() {
            return Err(format!("{technique}: {way:?} pass"));
        }
    }
    Ok(())
}
