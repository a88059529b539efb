//! Techniques are judged at the points that the picture shows: the receivers lie on the faces that a ray from the eye
//! meets first, the judged visibility is the one that the picture shows, and shading with it gives the picture.

use contrejour_plan::{FramePlan, Light, Omitted, ShadowSettings, Technique};
use contrejour_render::{ComposeError, Judge, LightPlan, Receivers, Renderer, frame_plans, rocked};
use contrejour_scene::Scene;
use contrejour_tests::gpu::{Equipment, render_gpu};
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::image_compare::{ImageTolerance, compare_images};
use contrejour_tests::ray_cast::{RayCaster, check_receivers};
use image::{Rgba, RgbaImage};
use libtest_mimic::Trial;

const SIZE: [u32; 2] = [160, 120];

/// Every face is asked for every pixel's ray, so there are fewer.
const RAY_CAST_SIZE: [u32; 2] = [96, 72];

const MAP_SIZE: u32 = 256;

/// Scenes with each kind of light, of few faces and of many.
const SCENES: [&str; 4] = ["boxes", "sundial", "lamp", "knot"];

/// Scenes in which rays are held against what is seen, whatever shines.
const RAY_CAST_SCENES: [&str; 3] = ["boxes", "fence", "knot"];

/// A step of 255: rounding may fall to the other side.
const TOLERANCE: ImageTolerance = ImageTolerance { mean: 0.05, max: 1 };

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("judged::receivers_lie_on_the_faces_that_are_seen", |_| receivers_lie_on_the_faces_that_are_seen()),
        gpu_trial("judged::planted_receivers_are_found", |_| planted_receivers_are_found()),
        gpu_trial("judged::visibility_is_what_the_picture_shows", |_| visibility_is_what_the_picture_shows()),
        gpu_trial("judged::composing_gives_the_picture", |_| composing_gives_the_picture()),
        gpu_trial("judged::what_cannot_be_composed_is_told", |_| what_cannot_be_composed_is_told()),
        gpu_trial("judged::a_rocked_light_does_all_the_work", |_| a_rocked_light_does_all_the_work()),
        gpu_trial("judged::equipment_hardly_shows", |_| equipment_hardly_shows()),
        gpu_trial("judged::the_plan_is_known_before", |_| the_plan_is_known_before()),
        gpu_trial("judged::contestants_do_not_touch_each_other", |_| contestants_do_not_touch_each_other()),
    ]
}

fn text(error: impl std::error::Error) -> String {
    error.to_string()
}

fn scene(name: &str) -> Result<Scene, String> {
    let mut scene = Scene::built_in(Some(name)).ok_or("there is such a scene")?.map_err(text)?;
    scene.resize(SIZE);
    Ok(scene)
}

fn judge(scene: &Scene) -> Result<Judge, String> {
    judge_on(Equipment::Baseline, scene)
}

fn judge_on(equipment: Equipment, scene: &Scene) -> Result<Judge, String> {
    Judge::new(render_gpu(equipment)?, scene).map_err(text)
}

/// What the device shows, and rays to hold it against.
fn receivers(scene: &Scene) -> Result<(RayCaster, Receivers), String> {
    let judge = judge(scene)?;
    let caster = RayCaster::new(scene, judge.local_space(), &judge.gpu().adapter_info.name);
    Ok((caster, judge.receivers().map_err(text)?))
}

/// Every technique, with small maps.
fn techniques(scene: &Scene) -> Vec<ShadowSettings> {
    let settings = ShadowSettings { map_size: MAP_SIZE, ..scene.lights[0].shadow };
    let of_name = |name: &str| ShadowSettings { technique: name.parse().expect("it is listed"), ..settings };
    Technique::NAMES.map(of_name).to_vec()
}

fn receivers_lie_on_the_faces_that_are_seen() -> Outcome {
    for name in RAY_CAST_SCENES {
        let mut scene = scene(name)?;
        scene.resize(RAY_CAST_SIZE);
        // The last mesh hides what is behind it and receives nothing.
        scene.meshes.last_mut().ok_or("there is a mesh")?.receives = false;
        let (caster, receivers) = receivers(&scene)?;
        let report = check_receivers(&caster, &receivers).map_err(|error| format!("{name}: {error}"))?;
        eprintln!("{name}: {report:?}");
        let seen = receivers.points.iter().flatten().count();
        if seen < receivers.points.len() / 4 || seen == receivers.points.len() {
            return Err(format!("{name}: {seen} receivers are too few, or leave no background"));
        }
    }
    Ok(())
}

fn planted_receivers_are_found() -> Outcome {
    let mut scene = scene("boxes")?;
    scene.resize(RAY_CAST_SIZE);
    let (caster, good) = receivers(&scene)?;
    check_receivers(&caster, &good)?;
    let [width, height] = good.size;
    let pixel = (height / 2 * width + width / 2) as usize;
    if good.points[pixel].is_none() {
        return Err("there is no receiver in the middle".into());
    }
    let planted = |change: &dyn Fn(&mut Receivers)| {
        let mut receivers = good.clone();
        change(&mut receivers);
        check_receivers(&caster, &receivers).is_err()
    };
    let each = |change: fn(&mut contrejour_render::Receiver)| {
        planted(&|receivers| receivers.points.iter_mut().flatten().for_each(change))
    };
    let found = [
        ("ids one too high", each(|receiver| receiver.face_id += 1)),
        ("ids one too low", each(|receiver| receiver.face_id = receiver.face_id.saturating_sub(1))),
        ("meshes numbered one face late", planted(&|receivers| receivers.first_faces[1] += 1)),
        ("points off their faces", each(|receiver| receiver.position += 4e-5 * receiver.normal)),
        (
            "points along their faces",
            each(|receiver| receiver.position += 1e-3 * receiver.normal.any_orthogonal_vector()),
        ),
        ("averted normals", each(|receiver| receiver.normal = -receiver.normal)),
        ("longer normals", each(|receiver| receiver.normal *= 1.01)),
        ("a missing receiver", planted(&|receivers| receivers.points[pixel] = None)),
        (
            "a receiver too many",
            planted(&|receivers| {
                receivers.points.iter_mut().for_each(|point| {
                    *point = point.or(good.points[pixel]);
                });
            }),
        ),
        ("rows upside down", planted(&|receivers| receivers.points.reverse())),
    ];
    let passing: Vec<_> = found.iter().filter(|(_, is_found)| !is_found).map(|(name, _)| name).collect();
    if passing.is_empty() { Ok(()) } else { Err(format!("{passing:?} pass")) }
}

/// The renderer of pictures with one sample a pixel.
fn one_sample_renderer(scene: &Scene, settings: &ShadowSettings) -> Result<Renderer, String> {
    let mut gpu = render_gpu(Equipment::Baseline)?;
    gpu.sample_count = 1;
    let mut scene = scene.clone();
    scene.set_shadow(settings);
    let mut renderer = Renderer::new(gpu, &scene).map_err(text)?;
    renderer.draw_complete().map_err(text)?;
    Ok(renderer)
}

/// Visibility as the view of that name shows it: grey, encoded as sRGB.
fn grey_picture(visibility: &[f32]) -> RgbaImage {
    let encoded = |linear: f32| {
        let linear = f64::from(linear.clamp(0.0, 1.0));
        let value = if linear <= 0.003_130_8 { 12.92 * linear } else { 1.055 * linear.powf(1.0 / 2.4) - 0.055 };
        (255.0 * value).round() as u8
    };
    RgbaImage::from_fn(SIZE[0], SIZE[1], |x, y| {
        let grey = encoded(visibility[(y * SIZE[0] + x) as usize]);
        Rgba([grey, grey, grey, 255])
    })
}

fn visibility_is_what_the_picture_shows() -> Outcome {
    for name in SCENES {
        let mut scene = scene(name)?;
        let judge_of_scene = judge(&scene)?;
        for settings in techniques(&scene) {
            let mut renderer = one_sample_renderer(&scene, &settings)?;
            let views = renderer.views().map_err(text)?;
            let view = views.iter().find(|view| view.name == "visibility").ok_or("there is such a view")?;
            let mut contestant = judge_of_scene.contestant(&settings).map_err(text)?;
            contestant.draw(&scene.lights[0].light).map_err(text)?;
            let visibility = contestant.visibility().map_err(text)?;
            let what = format!("{name}, {}", settings.technique);
            compare_images(&what, &view.picture, &grey_picture(&visibility), TOLERANCE)?;
            if !visibility.contains(&0.0) || !visibility.contains(&1.0) {
                return Err(format!("{what}: no shadow, or nothing else"));
            }

            // The same of another light is found to differ.
            contestant.draw(&contrejour_scene::orbit(&scene.lights[0].light, 1, 60)).map_err(text)?;
            let other = grey_picture(&contestant.visibility().map_err(text)?);
            if compare_images(&what, &view.picture, &other, TOLERANCE).is_ok() {
                return Err(format!("{what}: another light's visibility passes"));
            }
        }

        // What receives nothing is lit.
        scene.meshes.iter_mut().for_each(|placed| placed.receives = false);
        let mut contestant = judge(&scene)?.contestant(&techniques(&scene)[0]).map_err(text)?;
        contestant.draw(&scene.lights[0].light).map_err(text)?;
        if contestant.visibility().map_err(text)?.iter().any(|&value| value != 1.0) {
            return Err(format!("{name}: what receives no shadow has one"));
        }
    }
    Ok(())
}

fn composing_gives_the_picture() -> Outcome {
    for name in SCENES {
        let mut scene = scene(name)?;
        // Receives no shadow, and is shaded without.
        scene.meshes.last_mut().ok_or("there is a mesh")?.receives = false;
        let judge = judge(&scene)?;
        for settings in techniques(&scene) {
            let expected = one_sample_renderer(&scene, &settings)?.picture().map_err(text)?;
            let mut contestant = judge.contestant(&settings).map_err(text)?;
            contestant.draw(&scene.lights[0].light).map_err(text)?;
            let visibility = contestant.visibility().map_err(text)?;
            let compose = |visibility: &[f32]| judge.compose(&scene.lights[0].light, visibility).map_err(text);
            let what = format!("{name}, {}", settings.technique);
            let composed = compose(&visibility)?;
            compare_images(&what, &expected, &composed, TOLERANCE)?;

            // Faults in the visibility show, and only on receivers.
            let darker: Vec<f32> = visibility.iter().map(|value| 0.97 * value).collect();
            let shifted: Vec<f32> = visibility[1..].iter().chain(&visibility[..1]).copied().collect();
            for (fault, faulty) in [("darker", &darker), ("shifted", &shifted), ("lit", &vec![1.0; visibility.len()])] {
                let picture = compose(faulty)?;
                if compare_images(&what, &expected, &picture, TOLERANCE).is_ok() {
                    return Err(format!("{what}: a visibility that is {fault} passes"));
                }
                background_is_untouched(&judge, &composed, &picture).map_err(|error| format!("{what}: {error}"))?;
            }
        }
    }
    Ok(())
}

fn background_is_untouched(judge: &Judge, expected: &RgbaImage, picture: &RgbaImage) -> Outcome {
    let receivers = judge.receivers().map_err(text)?;
    for (pixel, (expected, found)) in expected.pixels().zip(picture.pixels()).enumerate() {
        if receivers.points[pixel].is_none() && expected != found {
            return Err(format!("pixel {pixel} is no receiver and changed from {expected:?} to {found:?}"));
        }
    }
    Ok(())
}

fn what_cannot_be_composed_is_told() -> Outcome {
    let scene = scene("boxes")?;
    let judge = judge(&scene)?;
    let mut visibility = vec![1.0; (SIZE[0] * SIZE[1]) as usize];
    judge.compose(&scene.lights[0].light, &visibility).map_err(text)?;
    visibility[SIZE[0] as usize + 7] = f32::NAN;
    match judge.compose(&scene.lights[0].light, &visibility) {
        Err(ComposeError::NotFinite { x: 7, y: 1, value }) if value.is_nan() => {}
        other => return Err(format!("{other:?} for a NaN")),
    }
    visibility.pop();
    match judge.compose(&scene.lights[0].light, &visibility) {
        Err(ComposeError::Count { values, width: 160, height: 120 }) if values == visibility.len() => Ok(()),
        other => Err(format!("{other:?} for a missing pixel")),
    }
}

fn a_rocked_light_does_all_the_work() -> Outcome {
    let on_baseline = SCENES.map(|name| (name, Equipment::Baseline));
    for (name, equipment) in on_baseline.into_iter().chain([("boxes", Equipment::Best)]) {
        let scene = scene(name)?;
        let judge = judge_on(equipment, &scene)?;
        for settings in techniques(&scene) {
            let mut contestant = judge.contestant(&settings).map_err(text)?;
            let what = format!("{name}, {}", settings.technique);
            let mut draw = |frame| contestant.draw(&rocked(&scene.lights[0].light, frame)).map_err(text);
            draw(0)?;
            let still = draw(0)?;
            if !still.is_unchanged {
                return Err(format!("{what}: the same light again was not told"));
            }
            let mut names_of_frame_1 = Vec::new();
            for frame in 1..5 {
                let cost = draw(frame)?;
                let names: Vec<_> = cost.passes.iter().map(|pass| pass.name.clone()).collect();
                if frame == 1 {
                    names_of_frame_1.clone_from(&names);
                }
                if cost.is_unchanged || cost.repeats > 0 || names != names_of_frame_1 {
                    return Err(format!("{what}: frame {frame} is {cost:?}, the first was {names_of_frame_1:?}"));
                }
                if !(cost.cpu_ms > 0.0 && cost.wall_ms > 0.0) {
                    return Err(format!("{what}: frame {frame} took no time: {cost:?}"));
                }
                let has_timestamps = judge.gpu().device.features().contains(wgpu::Features::TIMESTAMP_QUERY);
                let is_last = names.last().is_some_and(|name| name == "visibility");
                if has_timestamps != is_last || has_timestamps && names.len() <= still.passes.len() {
                    return Err(format!("{what}: {names:?} were timed, {:?} for a light that stood", still.passes));
                }
            }
            if contestant.map_bytes() < u64::from(4 * MAP_SIZE * MAP_SIZE) || contestant.buffer_bytes() == 0 {
                return Err(format!("{what}: {} and {} bytes", contestant.map_bytes(), contestant.buffer_bytes()));
            }
        }
    }
    Ok(())
}

fn contestants_do_not_touch_each_other() -> Outcome {
    let scene = scene("boxes")?;
    let judge = judge(&scene)?;
    let found = |backwards: bool| -> Result<Vec<Vec<f32>>, String> {
        let contestants: Result<Vec<_>, _> =
            techniques(&scene).iter().map(|settings| judge.contestant(settings)).collect();
        let mut contestants = contestants.map_err(text)?;
        if backwards {
            contestants.iter_mut().rev().try_for_each(|contestant| contestant.draw(&scene.lights[0].light).map(|_| ()))
        } else {
            contestants.iter_mut().try_for_each(|contestant| contestant.draw(&scene.lights[0].light).map(|_| ()))
        }
        .map_err(text)?;
        contestants.iter().map(|contestant| contestant.visibility().map_err(text)).collect()
    };
    let visibilities = found(false)?;
    if found(true)? != visibilities {
        return Err("the order of contestants matters".into());
    }
    // All sources of a silhouette map fill the same one.
    let of_other_sources = ["silhouette-map-tam", "silhouette-map-stream"];
    let is_another = |(index, _): &(usize, _)| !of_other_sources.contains(&Technique::NAMES[*index]);
    for (index, visibility) in visibilities.iter().enumerate().filter(is_another) {
        if visibilities[..index].contains(visibility) {
            return Err(format!("technique {index} has the visibility of another one"));
        }
    }
    Ok(())
}

/// What the best equipment does beside saving time, as an RMSE of visibility: moments of 32 bits instead of 16, alpha of
/// 32 bits instead of 16, nothing for the others.
fn most_of_equipment(technique: &Technique) -> f64 {
    match technique {
        Technique::Variance(_) => 0.01,
        Technique::Smoothies(_) => 1e-4,
        _ => 0.0,
    }
}

fn equipment_hardly_shows() -> Outcome {
    for name in SCENES {
        let scene = scene(name)?;
        let [baseline, best] = [judge_on(Equipment::Baseline, &scene)?, judge_on(Equipment::Best, &scene)?];
        for settings in techniques(&scene) {
            let difference = |settings_of_best: &ShadowSettings| {
                let found = visibility(&baseline, &settings, &scene.lights[0].light)?;
                Ok::<_, String>(rmse(&found, &visibility(&best, settings_of_best, &scene.lights[0].light)?))
            };
            let most = most_of_equipment(&settings.technique);
            let found = difference(&settings)?;
            if found > most {
                return Err(format!("{name}, {}: {found} on the best equipment, {most} allowed", settings.technique));
            }
            let coarser = ShadowSettings { map_size: MAP_SIZE / 4, ..settings };
            if difference(&coarser)? <= most {
                return Err(format!("{name}, {}: a coarser map passes", settings.technique));
            }
        }
    }
    Ok(())
}

fn visibility(judge: &Judge, settings: &ShadowSettings, light: &Light) -> Result<Vec<f32>, String> {
    let mut contestant = judge.contestant(settings).map_err(text)?;
    contestant.draw(light).map_err(text)?;
    contestant.visibility().map_err(text)
}

fn rmse(one: &[f32], other: &[f32]) -> f64 {
    let squares = one.iter().zip(other).map(|(one, other)| f64::from(one - other).powi(2));
    (squares.sum::<f64>() / one.len() as f64).sqrt()
}

/// The plan of a scene that no device has seen is the one that the device follows.
fn the_plan_is_known_before() -> Outcome {
    for name in SCENES {
        let mut scene = scene(name)?;
        scene.meshes[0].casts = false;
        let judge = judge(&scene)?;
        for settings in techniques(&scene) {
            scene.set_shadow(&settings);
            let plans = frame_plans(&scene, &judge.gpu().facts()).map_err(text)?;
            let [LightPlan { plan: before, .. }] = &plans[..] else { return Err(format!("{name} has one light")) };
            let contestant = judge.contestant(&settings).map_err(text)?;
            let followed = contestant.plan().ok_or("a contestant is prepared")?;
            let facts = |plan: &FramePlan| {
                let FramePlan { stages, passes, buffers, textures, casting, pages, .. } = plan.clone();
                (stages, passes, buffers, textures, casting, pages)
            };
            if facts(before) != facts(followed) {
                return Err(format!("{name}: {before:?} was planned and {followed:?} followed"));
            }
            if before.left_out.iter().all(|left_out| left_out.what != Omitted::Topology(scene.meshes[0].name.clone())) {
                return Err(format!("{name}: {:?} says nothing of what casts nothing", before.left_out));
            }
        }
    }
    Ok(())
}
