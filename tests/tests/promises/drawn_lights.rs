//! Pictures of many lights: light adds up, whatever stands where, and what moves is drawn as if it had always been there.

use std::path::Path;

use contrejour_render::{MoveError, Renderer, read_texture};
use contrejour_scene::{Scene, SceneLight, SceneMesh, orbit};
use contrejour_tests::gpu::{Equipment, render_gpu};
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::image_compare::{ImageTolerance, compare_images};
use glam::{DMat4, DVec3};
use image::RgbaImage;
use libtest_mimic::Trial;

const SIZE: [u32; 2] = [160, 120];

/// All kinds of light, three techniques, one light without a shadow; dark enough that tones are the light itself.
const SCENE: &str = r#"
size = [160, 120]
ambient = [0, 0, 0]
background = [0, 0, 0]
exposure_ev100 = 2
[camera]
eye = [2.4, 3.0, 4.2]
target = [0.1, 0.4, 0]
[shadow]
map_size = 256
[[light]]
kind = "spot"
position = [-2, 5, 2]
target = [0, 0.3, 0]
radius = 0.2
color = [0.15, 0.13, 0.1]
[[light]]
kind = "point"
position = [1.1, 1.6, 1.2]
color = [0.1, 0.4, 1.0]
intensity = 4
range = 4
shadow = { technique = "gaussian-pcf" }
[[light]]
kind = "directional"
towards_light = [3, 4, -1]
color = [0.08, 0.12, 0.05]
shadow = { technique = "evsm" }
[[light]]
kind = "point"
position = [-1.5, 0.9, -0.6]
color = [0.1, 0.02, 0.02]
casts = false
[[mesh]]
name = "floor"
shape = { kind = "box", size = [5, 0.2, 5] }
translate = [0, -0.1, 0]
base_color = [0.7, 0.7, 0.7]
[[mesh]]
name = "ring"
shape = { kind = "torus", radius = 0.6, tube_radius = 0.2, segments = 32, sides = 16 }
rotate_degrees = [70, 0, 0]
translate = [0, 0.9, 0]
base_color = [0.8, 0.6, 0.5]
"#;

/// Roundings of 8 bits and of 16-bit sums.
const ROUNDED: ImageTolerance = ImageTolerance { mean: 0.6, max: 4 };

/// Nothing but what two runs of one driver may differ by.
const SAME: ImageTolerance = ImageTolerance { mean: 0.001, max: 1 };

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("drawn_lights::light_adds_up", |_| light_adds_up()),
        gpu_trial("drawn_lights::faces_that_coincide_are_lit_once", |_| faces_that_coincide_are_lit_once()),
        gpu_trial("drawn_lights::what_moves_is_drawn_where_it_is", |_| what_moves_is_drawn_where_it_is()),
        gpu_trial("drawn_lights::a_frame_uploads_what_moved", |_| a_frame_uploads_what_moved()),
        gpu_trial("drawn_lights::a_picture_of_the_callers_is_the_same", |_| a_picture_of_the_callers_is_the_same()),
        gpu_trial("drawn_lights::rims_show_no_shadow_of_rounding", |_| rims_show_no_shadow_of_rounding()),
        gpu_trial("drawn_lights::each_light_has_its_views", |_| each_light_has_its_views()),
        gpu_trial("drawn_lights::triangles_of_silhouette_maps_are_seen", |_| triangles_of_silhouette_maps_are_seen()),
    ]
}

fn text(error: impl std::fmt::Display) -> String {
    error.to_string()
}

fn scene() -> Result<Scene, String> {
    Scene::from_toml(SCENE, Path::new(""), "lights.toml").map_err(text)
}

fn renderer(scene: &Scene) -> Result<Renderer, String> {
    Renderer::new(render_gpu(Equipment::Baseline)?, scene).map_err(text)
}

fn picture(scene: &Scene) -> Result<RgbaImage, String> {
    drawn(&mut renderer(scene)?)
}

fn drawn(renderer: &mut Renderer) -> Result<RgbaImage, String> {
    renderer.draw_complete().map_err(text)?;
    renderer.picture().map_err(text)
}

fn linear(value: u8) -> f64 {
    let value = f64::from(value) / 255.0;
    if value <= 0.04045 { value / 12.92 } else { ((value + 0.055) / 1.055).powf(2.4) }
}

fn encoded(linear: f64) -> u8 {
    let value = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
    (255.0 * value).round() as u8
}

fn sum(pictures: &[RgbaImage]) -> RgbaImage {
    RgbaImage::from_fn(SIZE[0], SIZE[1], |x, y| {
        let channel = |channel: usize| {
            encoded(pictures.iter().map(|picture| linear(picture.get_pixel(x, y).0[channel])).sum::<f64>().min(1.0))
        };
        image::Rgba([channel(0), channel(1), channel(2), 255])
    })
}

/// The picture of all lights is the sum of those of each; a light that is left out, or added twice, is found.
fn light_adds_up() -> Outcome {
    let scene = scene()?;
    let with = |lights: &[SceneLight]| picture(&Scene { lights: lights.to_vec(), ..scene.clone() });
    let each = scene.lights.iter().map(|light| with(std::slice::from_ref(light))).collect::<Result<Vec<_>, _>>()?;
    for (alone, light) in each.iter().zip(&scene.lights) {
        if alone.pixels().all(|pixel| pixel.0[..3] == [0; 3]) {
            return Err(format!("the {} light shows nowhere", light.name));
        }
    }
    let all = picture(&scene)?;
    compare_images("all lights", &sum(&each), &all, ROUNDED)?;
    for left_out in 0..each.len() {
        let mut others = each.clone();
        let twice = [&each[..], &each[left_out..=left_out]].concat();
        others.remove(left_out);
        for (what, pictures) in [("left out", others), ("added twice", twice)] {
            if compare_images(what, &sum(&pictures), &all, ROUNDED).is_ok() {
                return Err(format!("light {left_out} can be {what}"));
            }
        }
    }
    let none = with(&[])?;
    if none.pixels().any(|pixel| pixel.0 != [0, 0, 0, 255]) {
        return Err("without a light something shines".into());
    }
    Ok(())
}

/// A mesh that stands there twice looks as it does once.
fn faces_that_coincide_are_lit_once() -> Outcome {
    let scene = scene()?;
    let mut twice = scene.clone();
    let doubled: Vec<SceneMesh> = twice.meshes.iter().map(|mesh| SceneMesh { casts: false, ..mesh.clone() }).collect();
    twice.meshes.extend(doubled);
    compare_images("twice", &picture(&scene)?, &picture(&twice)?, SAME)
}

fn what_moves_is_drawn_where_it_is() -> Outcome {
    let scene = scene()?;
    let mut moved = scene.clone();
    let turn = DMat4::from_translation(DVec3::new(0.3, 0.2, 0.1)) * DMat4::from_rotation_y(0.7);
    moved.meshes[1].world_from_object = turn * scene.meshes[1].world_from_object;
    for light in &mut moved.lights {
        light.light = orbit(&light.light, 1, 9);
    }
    moved.camera.eye += DVec3::new(-0.6, 0.3, 0.0);
    let mut renderer = renderer(&scene)?;
    let before = drawn(&mut renderer)?;
    renderer.place_mesh(1, &moved.meshes[1].world_from_object).map_err(text)?;
    for (index, light) in moved.lights.iter().enumerate() {
        renderer.set_light(index, &light.light).map_err(text)?;
    }
    let without_camera = drawn(&mut renderer)?;
    renderer.set_camera(&moved.camera);
    let after = drawn(&mut renderer)?;
    // Another camera has another local space, whose numbers round in other ways.
    let fresh = picture(&moved)?;
    compare_images("moved", &fresh, &after, ImageTolerance { mean: 0.1, max: 110 })?;
    for (what, picture) in [("nothing moves", &before), ("the camera stands", &without_camera)] {
        if compare_images(what, &fresh, picture, ImageTolerance { mean: 0.1, max: 110 }).is_ok() {
            return Err(format!("it is not found that {what}"));
        }
    }
    let light = scene.lights[0].light;
    match (renderer.set_light(4, &light), renderer.place_mesh(2, &DMat4::IDENTITY)) {
        (Err(MoveError::NoSuchLight { index: 4, count: 4 }), Err(MoveError::NoSuchMesh { index: 2, count: 2 })) => {}
        other => return Err(format!("what is not there moves: {other:?}")),
    }
    match renderer.place_mesh(0, &DMat4::from_scale(DVec3::splat(f64::NAN))) {
        Err(MoveError::NotFinite { index: 0 }) => Ok(()),
        other => Err(format!("a mesh stands nowhere: {other:?}")),
    }
}

/// Frames in which nothing moves upload nothing; others upload records, however large the meshes are.
fn a_frame_uploads_what_moved() -> Outcome {
    let uploaded = |segments: u32, moves: bool| -> Result<u64, String> {
        let scene = SCENE.replace("segments = 32", &format!("segments = {segments}"));
        let scene = Scene::from_toml(&scene, Path::new(""), "lights.toml").map_err(text)?;
        let mut renderer = renderer(&scene)?;
        renderer.draw_complete().map_err(text)?;
        for frame in 1..8 {
            if moves {
                let turn = DMat4::from_rotation_y(0.1 * f64::from(frame)) * scene.meshes[1].world_from_object;
                renderer.place_mesh(1, &turn).map_err(text)?;
                renderer.set_light(0, &orbit(&scene.lights[0].light, frame, 90)).map_err(text)?;
            }
            renderer.draw().map_err(text)?;
        }
        Ok(renderer.measurements().map_err(text)?.upload_bytes_per_frame)
    };
    let [still, small, large] = [uploaded(32, false)?, uploaded(32, true)?, uploaded(256, true)?];
    if still == 0 && small == large && (1..4096).contains(&small) {
        return Ok(());
    }
    Err(format!("a frame uploads {still} bytes where nothing moves, {small} and {large} where something does"))
}

fn a_picture_of_the_callers_is_the_same() -> Outcome {
    let scene = scene()?;
    let gpu = render_gpu(Equipment::Baseline)?;
    let mut renderer = Renderer::new(gpu.clone(), &scene).map_err(text)?;
    let target = |size: [u32; 2], format| {
        gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: None,
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        })
    };
    let other_size = [96, 128];
    let formats =
        [wgpu::TextureFormat::Bgra8UnormSrgb, wgpu::TextureFormat::Bgra8Unorm, wgpu::TextureFormat::Rgba8Unorm];
    for size in [SIZE, other_size] {
        renderer.resize(size).map_err(text)?;
        let own = drawn(&mut renderer)?;
        for format in formats {
            let texture = target(size, format);
            let view = texture.create_view(&wgpu::TextureViewDescriptor::default());
            renderer.draw_into(&view, format).map_err(text)?;
            let mut bytes = read_texture(&gpu, &texture, 4).map_err(text)?;
            if format != wgpu::TextureFormat::Rgba8Unorm {
                bytes.chunks_exact_mut(4).for_each(|pixel| pixel.swap(0, 2));
            }
            let found = RgbaImage::from_raw(size[0], size[1], bytes).ok_or("it has all pixels")?;
            compare_images(&format!("{format:?}"), &own, &found, ImageTolerance { mean: 0.1, max: 1 })?;
        }
    }
    let wrong = target(SIZE, formats[0]).create_view(&wgpu::TextureViewDescriptor::default());
    match renderer.draw_into(&wrong, formats[0]).map_err(text) {
        Err(error) if error.contains("160x120 pixels and 96x128 are drawn") => {}
        other => return Err(format!("a picture of another size: {other:?}")),
    }
    match renderer.resize([0, 10]) {
        Err(_) => Ok(()),
        Ok(()) => Err("a picture without a pixel is drawn".into()),
    }
}

fn each_light_has_its_views() -> Outcome {
    let mut renderer = renderer(&scene()?)?;
    renderer.draw_complete().map_err(text)?;
    let views = renderer.views().map_err(text)?;
    let found: Vec<&str> = views.iter().map(|view| view.name.as_str()).collect();
    for light in 1..=3 {
        for name in ["visibility", "silhouette"] {
            let name = format!("light-{light}-{name}");
            if !found.contains(&name.as_str()) {
                return Err(format!("{name} is not among {found:?}"));
            }
        }
    }
    if !found.contains(&"light-1-smoothie_alpha") || found.iter().any(|name| name.starts_with("light-4")) {
        return Err(format!("light 1 has smoothies, light 4 has no shadow: {found:?}"));
    }
    let of = |name: &str| views.iter().find(|view| view.name == name).map(|view| &view.picture);
    let [Some(first), Some(second)] = ["light-1-visibility", "light-2-visibility"].map(of) else {
        return Err("both are there".into());
    };
    match compare_images("lights", first, second, SAME) {
        Ok(()) => Err("two lights are seen from the same places".into()),
        Err(_) => Ok(()),
    }
}

/// What each side of the cube around a point light drew to fill its silhouette map covers all that the map holds, and not
/// what the map of another side holds.
fn triangles_of_silhouette_maps_are_seen() -> Outcome {
    let lamp = |technique: &str| {
        format!(
            r#"
size = [32, 24]
[camera]
eye = [3, 2, 5]
target = [0, 0, 0]
[shadow]
technique = "{technique}"
map_size = 128
[light]
kind = "point"
position = [0.4, 1.1, 1.5]
radius = 0.05
[[mesh]]
shape = {{ kind = "box" }}
[[mesh]]
shape = {{ kind = "torus", radius = 0.6, tube_radius = 0.2, segments = 32, sides = 16 }}
translate = [1.6, 1.3, 2.4]
"#
        )
    };
    let sides = ["positive-x", "negative-x", "positive-y", "negative-y", "positive-z", "negative-z"];
    for (technique, triangles) in [
        ("silhouette-map", "strips"),
        ("silhouette-map-tam", "scaled_faces"),
        ("silhouette-map-stream", "scaled_faces"),
    ] {
        let scene = Scene::from_toml(&lamp(technique), Path::new(""), "lamp.toml").map_err(text)?;
        let mut renderer = renderer(&scene)?;
        renderer.draw_complete().map_err(text)?;
        let views = renderer.views().map_err(text)?;
        let drawn = |name: &str, side: &str| -> Result<Vec<bool>, String> {
            let name = format!("{name}-{side}");
            let view = views.iter().find(|view| view.name == name).ok_or(format!("{technique}: no {name}"))?;
            Ok(view.picture.pixels().map(|pixel| pixel.0 != [0, 0, 0, 255]).collect())
        };
        let uncovered = |held: &[bool], covered: &[bool]| {
            held.iter().zip(covered).filter(|(is_held, is_covered)| **is_held && !**is_covered).count()
        };
        let (mut held_texels, mut in_another) = (0, 0);
        for (side, next) in sides.iter().zip(sides.iter().cycle().skip(1)) {
            let held = drawn("signed_distance", side)?;
            held_texels += held.iter().filter(|is_held| **is_held).count();
            let missing = uncovered(&held, &drawn(triangles, side)?);
            if missing > 0 {
                return Err(format!("{technique}, {side}: {missing} texels of the map were not drawn"));
            }
            in_another += uncovered(&held, &drawn(triangles, next)?);
        }
        if in_another == 0 {
            return Err(format!("{technique}: of {held_texels} texels all are drawn in the view of another side too"));
        }
    }
    Ok(())
}

/// A column in the sun, seen along one ray by a camera whose target is near or ten times as far. Its surface is where it
/// is: only the space in which numbers are small differs, and where positions beside the surface would lie.
fn rims_show_no_shadow_of_rounding() -> Outcome {
    let picture = |target: &str| -> Result<RgbaImage, String> {
        let text = format!(
            r#"
size = [320, 180]
[camera]
eye = [-5, 2.5, -20]
target = {target}
fov_y_degrees = 52
near = 0.2
far = 90
[light]
kind = "directional"
towards_light = [0.55, 0.62, 0.42]
[[mesh]]
shape = {{ kind = "cylinder", radius = 0.26, height = 4.4, segments = 48 }}
translate = [-3, 2.201, -24]
"#
        );
        picture(&Scene::from_toml(&text, Path::new(""), "column").map_err(|error| error.to_string())?)
    };
    let [near, far] = ["[-2.756, 2.2, -24.08]", "[17.44, -0.5, -60.8]"].map(picture);
    let (near, far) = (near?, far?);
    let darker = |(one, other): (&image::Rgba<u8>, &image::Rgba<u8>)| one[0].abs_diff(other[0]) > 24;
    let changed = near.pixels().zip(far.pixels()).filter(|&pixels| darker(pixels)).count();
    if changed <= 4 { Ok(()) } else { Err(format!("{changed} pixels differ")) }
}
