//! Base colour textures show on surfaces texel by texel, beyond their edges as they say, and evenly where they are small.

use std::io::Cursor;
use std::sync::Arc;

use contrejour_mesh::{EncodedImage, MaterialPart, MeshFile, Texture, TextureFilter, TextureWrap, TriangleMesh};
use contrejour_render::{Judge, NewRendererError, Renderer};
use contrejour_scene::{Camera, Scene};
use contrejour_tests::gpu::{Equipment, render_gpu};
use contrejour_tests::harness::{Outcome, gpu_trial};
use glam::{DMat4, DVec3};
use image::{DynamicImage, ImageFormat, Rgb, RgbImage, Rgba, RgbaImage};
use libtest_mimic::Trial;

/// Pixels along a side of the picture, which the square fills.
const SIDE: u32 = 64;

/// Light on the square: less than what the picture's tones bend.
const AMBIENT: f32 = 0.5;

/// How often the texture fits on the square, each way.
const REPEATS: f32 = 2.0;

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("textured::texels_are_where_they_belong", |_| texels_are_where_they_belong()),
        gpu_trial("textured::small_texels_are_averaged", |_| small_texels_are_averaged()),
        gpu_trial("textured::a_scene_can_replace_them", |_| a_scene_can_replace_them()),
        gpu_trial("textured::alpha_cuts_what_is_seen", |_| alpha_cuts_what_is_seen()),
        gpu_trial("textured::a_damaged_picture_is_told", |_| a_damaged_picture_is_told()),
    ]
}

/// Four texels each way, all different.
fn patches() -> RgbImage {
    RgbImage::from_fn(4, 4, |x, y| Rgb([40 + 60 * x as u8, 250 - 70 * y as u8, 17 * (4 * y + x) as u8]))
}

fn encoded(picture: RgbImage) -> EncodedImage {
    let mut bytes = Cursor::new(Vec::new());
    DynamicImage::from(picture).write_to(&mut bytes, ImageFormat::Png).expect("it fits into memory");
    EncodedImage { place: "patches.png".into(), bytes: bytes.into_inner() }
}

/// A square that fills the picture, white but for its texture, in ambient light alone.
fn square(texture: Texture, repeats: f32) -> Scene {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let mesh = TriangleMesh {
        positions: corners.map(|[x, y]: [f32; 2]| [x, y, 0.0]).to_vec(),
        normals: vec![[0.0, 0.0, 1.0]; 4],
        colors: vec![[1.0; 3]; 4],
        texture_coordinates: corners.map(|[x, y]| [repeats * (0.5 + 0.5 * x), repeats * (0.5 - 0.5 * y)]).to_vec(),
        parts: vec![MaterialPart { triangles: 0..2, texture: Some(Arc::new(texture)), alpha_cutoff: None }],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        vertex_numbers: (0..4).collect(),
        ..TriangleMesh::default()
    };
    let mut scene = Scene::around(MeshFile::single(mesh, Vec::new()));
    scene.meshes.truncate(1);
    scene.camera = Camera {
        eye: DVec3::new(0.0, 0.0, 3.0),
        target: DVec3::ZERO,
        up: DVec3::Y,
        fov_y: 2.0 * (1.0_f64 / 3.0).atan(),
        near: 1.0,
        far: 5.0,
    };
    scene.size = [SIDE; 2];
    scene.ambient = [AMBIENT; 3];
    scene.lights[0].light.color = [0.0; 3];
    scene
}

fn draw(scene: &Scene) -> Result<RgbaImage, String> {
    let mut renderer = renderer(scene).map_err(|error| error.to_string())?;
    renderer.draw_complete().map_err(|error| error.to_string())?;
    renderer.picture().map_err(|error| error.to_string())
}

fn renderer(scene: &Scene) -> Result<Renderer, NewRendererError> {
    let gpu = render_gpu(Equipment::Baseline).expect("trials without a device do not run");
    Renderer::new(gpu, scene)
}

/// Code of a texel's colour in half of its light (IEC 61966-2-1:1999).
fn lit(code: u8) -> f32 {
    let code = f32::from(code) / 255.0;
    let light = if code > 0.040_45 { ((code + 0.055) / 1.055).powf(2.4) } else { code / 12.92 };
    code_of(AMBIENT * light)
}

fn code_of(light: f32) -> f32 {
    255.0 * if light > 0.003_130_8 { 1.055 * light.powf(1.0 / 2.4) - 0.055 } else { 12.92 * light }
}

/// The texel at a texture coordinate, in texels.
fn wrapped(texel: i32, wrap: TextureWrap) -> u32 {
    let texel = match wrap {
        TextureWrap::Repeat => texel.rem_euclid(4),
        // 0 1 2 3 3 2 1 0
        TextureWrap::Mirror => texel.rem_euclid(8).min(7 - texel.rem_euclid(8)),
        TextureWrap::Clamp => texel.clamp(0, 3),
    };
    texel as u32
}

/// Largest difference of a channel from the texels that should show, in steps of 255.
fn difference(picture: &RgbaImage, wrap: [TextureWrap; 2]) -> f32 {
    let patches = patches();
    let texels_per_pixel = 4.0 * REPEATS / SIDE as f32;
    let differences = picture.enumerate_pixels().map(|(x, y, found)| {
        let [u, v] = [x, y].map(|pixel| (texels_per_pixel * (pixel as f32 + 0.5)) as i32);
        let Rgb(texel) = *patches.get_pixel(wrapped(u, wrap[0]), wrapped(v, wrap[1]));
        texel.iter().zip(found.0).map(|(&code, found)| (lit(code) - f32::from(found)).abs()).fold(0.0, f32::max)
    });
    differences.fold(0.0, f32::max)
}

fn texels_are_where_they_belong() -> Outcome {
    let wraps = [TextureWrap::Repeat, TextureWrap::Mirror, TextureWrap::Clamp];
    let image = Arc::new(encoded(patches()));
    for (across, down) in [(0, 0), (1, 2), (2, 1), (0, 1)] {
        let wrap = [wraps[across], wraps[down]];
        let texture = Texture { image: Arc::clone(&image), wrap, filter: TextureFilter::Nearest };
        let picture = draw(&square(texture, REPEATS))?;
        let off = difference(&picture, wrap);
        if off > 1.0 {
            return Err(format!("{wrap:?}: a texel is off by {off} steps"));
        }
        // What would be right for other edges is found to be wrong.
        let turned = difference(&picture, [wraps[(across + 1) % 3], wraps[down]]);
        if turned < 20.0 {
            return Err(format!("{wrap:?}: other edges are only {turned} steps off"));
        }
    }
    Ok(())
}

fn small_texels_are_averaged() -> Outcome {
    let checks = RgbImage::from_fn(128, 128, |x, y| Rgb(if (x + y) % 2 == 0 { [255; 3] } else { [0; 3] }));
    let texture = |picture| Texture {
        image: Arc::new(encoded(picture)),
        wrap: [TextureWrap::Repeat; 2],
        filter: TextureFilter::Linear,
    };
    let expected = code_of(0.5 * AMBIENT);
    let off = |picture: &RgbaImage| {
        let differences = picture.pixels().map(|texel| (f32::from(texel.0[0]) - expected).abs());
        differences.fold(0.0, f32::max)
    };
    // Eight texels a pixel.
    let even = off(&draw(&square(texture(checks.clone()), 4.0))?);
    if even > 2.0 {
        return Err(format!("small texels are {even} steps off their mean"));
    }
    // The same texels, many pixels each.
    let large = off(&draw(&square(texture(checks), 0.05))?);
    if large < 50.0 {
        return Err(format!("large texels are within {large} steps of their mean"));
    }
    Ok(())
}

fn a_scene_can_replace_them() -> Outcome {
    let texture =
        Texture { image: Arc::new(encoded(patches())), wrap: [TextureWrap::Repeat; 2], filter: TextureFilter::Linear };
    let mut scene = square(texture, 1.0);
    scene.meshes[0].material.base_color = Some([0.25, 0.5, 1.0]);
    let expected = [0.25, 0.5, 1.0].map(|light| code_of(AMBIENT * light));
    let picture = draw(&scene)?;
    let is_near = |pixel: &Rgba<u8>| (0..3).all(|n| (f32::from(pixel.0[n]) - expected[n]).abs() <= 1.0);
    if picture.pixels().all(is_near) { Ok(()) } else { Err("a texture shows through a scene's own colour".into()) }
}

/// What alpha cuts is not there: not in the picture, not in the view of visibility, and not among the receivers, where the
/// wall behind is found.
fn alpha_cuts_what_is_seen() -> Outcome {
    let is_open = |x: u32, y: u32| (x + 2 * y).is_multiple_of(3);
    let texels = RgbaImage::from_fn(4, 4, |x, y| Rgba([200, 200, 200, if is_open(x, y) { 99 } else { 102 }]));
    let mut bytes = Cursor::new(Vec::new());
    DynamicImage::from(texels).write_to(&mut bytes, ImageFormat::Png).map_err(|error| error.to_string())?;
    let image = EncodedImage { place: "holes.png".into(), bytes: bytes.into_inner() };
    let texture = Texture { image: image.into(), wrap: Default::default(), filter: TextureFilter::Nearest };
    let mut scene = square(texture, 1.0);
    let mut card = (*scene.meshes[0].mesh).clone();
    // 0.8 times 102 / 255 is just above it, and 99 / 255 below.
    card.parts[0].alpha_cutoff = Some(0.8 * 100.5 / 255.0);
    card.alphas = vec![0.8; 4];
    let mut wall = scene.meshes[0].clone();
    let whole = TriangleMesh { parts: Vec::new(), alphas: Vec::new(), ..card.clone() };
    wall.mesh = Arc::new(whole);
    wall.world_from_object = DMat4::from_scale_rotation_translation(DVec3::splat(1.5), Default::default(), -DVec3::Z);
    wall.material.base_color = Some([0.1; 3]);
    scene.meshes[0].mesh = Arc::new(card);
    scene.meshes.push(wall);

    let picture = draw(&scene)?;
    let gpu = render_gpu(Equipment::Baseline)?;
    let judge = Judge::new(gpu, &scene).map_err(|error| error.to_string())?;
    let receivers = judge.receivers().map_err(|error| error.to_string())?;
    let composed = judge.compose(&scene.lights[0].light, &vec![1.0; (SIDE * SIDE) as usize]);
    let composed = composed.map_err(|error| error.to_string())?;
    let mut seen = [0, 0];
    for (x, y, pixel) in picture.enumerate_pixels() {
        // Beside an edge of the picture's texels a pixel has a part of both.
        if [x, y].iter().any(|place| [0, SIDE / 4 - 1].contains(&(place % (SIDE / 4)))) {
            continue;
        }
        let is_open = is_open(4 * x / SIDE, 4 * y / SIDE);
        let face = receivers.points[(y * SIDE + x) as usize].map(|receiver| receiver.face_id);
        let is_wall = face.is_some_and(|face| face >= 2);
        let is_dark = [pixel, composed.get_pixel(x, y)].map(|pixel| pixel.0[0] < 120);
        if is_wall != is_open || is_dark != [is_open; 2] || face.is_none() {
            return Err(format!("pixel {x}, {y}: open {is_open}, face {face:?}, {pixel:?}"));
        }
        seen[usize::from(is_open)] += 1;
    }
    if seen.iter().all(|count| *count > 100) { Ok(()) } else { Err(format!("{seen:?} pixels")) }
}

fn a_damaged_picture_is_told() -> Outcome {
    let mut image = encoded(patches());
    image.bytes.truncate(image.bytes.len() / 2);
    let texture = Texture { image: Arc::new(image), wrap: [TextureWrap::Repeat; 2], filter: TextureFilter::Linear };
    match renderer(&square(texture, 1.0)) {
        Err(NewRendererError::Upload(error)) if error.to_string().starts_with("patches.png: ") => Ok(()),
        Err(error) => Err(format!("refused for another reason: {error}")),
        Ok(_) => Err("half a picture is drawn".into()),
    }
}
