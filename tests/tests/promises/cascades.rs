//! Cascades follow the eye: their maps are those that would be made from scratch, they stand while they may, shadows do not
//! flicker, and what is in front of a cascade casts as what is within.

use contrejour_gpu::{PrepareError, ShadowLightError, ShadowOptions};
use contrejour_plan::{
    CascadeSettings, Eye, Light, LightKind, ShadowSettings, SmoothieBlend, SmoothieSettings, SmoothieWidth, Technique,
    cascade_views,
};
use contrejour_tests::ask::{Point, visibility_at};
use contrejour_tests::avenue::{EYE, TOWARDS_LIGHT, avenue, seen, sun};
use contrejour_tests::compare::compare_exact;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::meshes::TestMesh;
use contrejour_tests::pipeline::Pipeline;
use contrejour_tests::random::Random;
use contrejour_tests::texture::read_layers;
use glam::{DMat4, DQuat, DVec3};
use libtest_mimic::Trial;

const MAP_SIZE: u32 = 256;

const ANGULAR_RADIUS: f64 = 0.01;

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("cascades::a_light_without_an_eye_is_refused", a_light_without_an_eye_is_refused),
        gpu_trial("cascades::maps_are_what_would_be_drawn", maps_are_what_would_be_drawn),
        gpu_trial("cascades::shadows_stand_still", shadows_stand_still),
        gpu_trial("cascades::what_is_in_front_casts", what_is_in_front_casts),
    ]
}

fn text(error: impl ToString) -> String {
    error.to_string()
}

fn settings(technique: &str) -> ShadowSettings {
    ShadowSettings { technique: technique.parse().expect("it is listed"), map_size: MAP_SIZE, ..Default::default() }
}

fn pipeline<'a>(gpu: &'a Gpu, mesh: &TestMesh, settings: &ShadowSettings) -> Result<Pipeline<'a>, String> {
    Pipeline::new(gpu, mesh, &ShadowOptions { settings: *settings, ..Default::default() })
}

fn drawn<'a>(
    gpu: &'a Gpu,
    mesh: &TestMesh,
    settings: &ShadowSettings,
    (light, eye): (&Light, &Eye),
) -> Result<Pipeline<'a>, String> {
    let mut pipeline = pipeline(gpu, mesh, settings)?;
    pipeline.follow_eye(eye);
    pipeline.complete_frame(light)?;
    Ok(pipeline)
}

fn maps(gpu: &Gpu, pipeline: &Pipeline<'_>) -> Result<Vec<u8>, String> {
    let kind = pipeline.shadows.visibility_kind(pipeline.light());
    let mut bytes = Vec::new();
    for kind in kind.textures() {
        bytes.extend(read_layers(gpu, pipeline.maps().of(*kind).ok_or("a listed map is there")?));
    }
    Ok(bytes)
}

fn a_light_without_an_eye_is_refused(gpu: &Gpu) -> Outcome {
    let mut pipeline = pipeline(gpu, &avenue(), &settings("pcf"))?;
    let light = sun(ANGULAR_RADIUS, CascadeSettings::DEFAULT);
    match pipeline.prepare(&light) {
        Err(PrepareError::NoEye { light }) if light == pipeline.light() => {}
        other => return Err(format!("without an eye: {other:?}")),
    }
    let blind = Eye { far: 0.0, ..EYE };
    match pipeline.shadows.set_eye(pipeline.light(), &blind) {
        Err(ShadowLightError::Cascades(_)) => {}
        other => return Err(format!("with an eye that sees nothing: {other:?}")),
    }
    if pipeline.prepare(&light).is_ok() {
        return Err("an eye that was refused is taken".into());
    }
    pipeline.follow_eye(&EYE);
    pipeline.complete_frame(&light)?;
    let size = pipeline.maps().shadow_hardware_depth.map(wgpu::Texture::depth_or_array_layers);
    if size == Some(4) { Ok(()) } else { Err(format!("{size:?} layers")) }
}

/// The eye walks and turns, by less than a texel and by more, and now and then a post moves.
fn maps_are_what_would_be_drawn(gpu: &Gpu) -> Outcome {
    let mesh = avenue();
    let light = sun(ANGULAR_RADIUS, CascadeSettings { caster_margin: 0.0, ..CascadeSettings::DEFAULT });
    for technique in ["smoothies", "shadow-map", "evsm"] {
        let settings = settings(technique);
        let mut random = Random::new(7);
        let mut walking = drawn(gpu, &mesh, &settings, (&light, &EYE))?;
        let mut eye = EYE;
        let mut placed = mesh.clone();
        let (mut kept, mut redone) = (0, 0);
        for step in 0..10 {
            let mut vector = || DVec3::new(random.signed(), random.signed(), random.signed());
            match step % 3 {
                // Far less than a texel, which is a hundredth or more.
                0 => eye.position += 1e-7 * vector(),
                1 => eye.position += vector(),
                _ => eye.forward = DQuat::from_rotation_y(0.3 * random.signed()) * eye.forward,
            }
            if step % 4 == 3 {
                let post = 2 + random.below(mesh.parts.len() - 2);
                let moved = DMat4::from_translation(DVec3::X * random.signed()) * placed.parts[post].world_from_object;
                placed.parts[post].world_from_object = moved;
                walking.place(post, moved);
            }
            walking.follow_eye(&eye);
            walking.frame(&light)?;
            let was_redone = walking.shadows.stats().lights_redone > 0;
            let first = maps(gpu, &walking)?;
            walking.complete_frame(&light)?;
            if was_redone {
                redone += 1;
            } else {
                kept += 1;
            }
            let scratch = drawn(gpu, &placed, &settings, (&light, &eye))?;
            let expected = maps(gpu, &scratch)?;
            let what = format!("{technique}, step {step}");
            compare_exact(&what, &expected, &maps(gpu, &walking)?)?;
            if !was_redone {
                compare_exact(&what, &expected, &first)?;
            }
            let asked: Vec<_> = seen(&eye, 500, step).iter().map(|seen| seen.point).collect();
            let [expected, found] = [&scratch, &walking]
                .map(|pipeline| visibility_at(gpu, &pipeline.shadows, pipeline.light(), &asked, None));
            compare_exact(&what, &expected, &found)?;
        }
        // Else maps that are never drawn again would pass, or that are always.
        if kept < 2 || redone < 5 {
            return Err(format!("{technique}: {kept} times maps stood, {redone} times they were drawn"));
        }
    }
    Ok(())
}

/// Of points far from borders, each looked up in one cascade, hardly any changes while the eye moves: hard edges fall on
/// the same texels. A map that follows the eye by less than texels is found.
fn shadows_stand_still(gpu: &Gpu) -> Outcome {
    let mesh = avenue();
    let settings = settings("shadow-map");
    let light = sun(0.0, CascadeSettings::DEFAULT);
    let cascades = cascade_views(&light, &EYE, &settings).map_err(text)?;
    let offsets: Vec<_> = (1..=6).map(|step| f64::from(step) * DVec3::new(0.0137, 0.0021, -0.0173)).collect();
    let eyes = || offsets.iter().map(|offset| Eye { position: EYE.position + *offset, ..EYE });
    let points: Vec<Point> = (seen(&EYE, 8000, 3).iter())
        .filter(|seen| {
            // From all eyes in the same cascade.
            let alike = |depth| {
                let share = cascades.at(depth)?;
                (share.next_share == 0.0).then_some(share.cascade)
            };
            let near = alike(seen.depth - 0.15);
            near.is_some() && near == alike(seen.depth + 0.15)
        })
        .map(|seen| seen.point)
        .collect();
    let changed = |draw: &dyn Fn(&Eye) -> Result<Vec<f32>, String>| {
        let before = draw(&EYE)?;
        let mut changed = 0;
        for eye in eyes() {
            changed += before.iter().zip(draw(&eye)?).filter(|(before, after)| **before != *after).count();
        }
        Ok::<_, String>(changed as f64 / (points.len() * offsets.len()) as f64)
    };
    let draw = |light: &Light, eye: &Eye| {
        let drawn = drawn(gpu, &mesh, &settings, (light, eye))?;
        Ok(visibility_at(gpu, &drawn.shadows, drawn.light(), &points, None))
    };
    let still = changed(&|eye| draw(&light, eye))?;
    // One map that shows what the last cascade does, and goes where the eye goes.
    let flickering = changed(&|eye| {
        let last = &cascades.cascades[cascades.cascades.len() - 1].view;
        let kind = LightKind::Directional {
            towards_light: TOWARDS_LIGHT,
            center: eye.position + 0.5 * EYE.far * EYE.axis_world(),
            half_extent: last.half_side,
            half_depth: 2.0 * last.half_side,
            angular_radius: 0.0,
        };
        draw(&Light { kind, ..light }, eye)
    })?;
    eprintln!("of {} points {still:.5} change, {flickering:.5} where maps do not snap", points.len());
    let is_told = points.len() > 2000 && flickering > 20.0 * still.max(1e-4);
    if still < 1e-3 && is_told { Ok(()) } else { Err(format!("{still} change, {flickering} where maps do not snap")) }
}

/// A sheet that stands on the floor and reaches far up in front of what the eye sees.
fn sheet() -> TestMesh {
    let corners = [[2.0, 0.0, -1.0], [2.0, 0.0, -30.0], [6.0, 40.0, -27.0], [6.0, 40.0, 2.0]];
    TestMesh::generated("sheet", &corners, &[[0, 1, 2], [0, 2, 3]])
}

/// Points in the air that an eye sees, some of them close behind the sheet.
fn in_the_air(count: usize) -> impl Iterator<Item = Point> {
    let mut random = Random::new(5);
    (0..count).map(move |_| {
        let [x, y, depth] = [(); 3].map(|()| random.signed());
        let depth = EYE.near * (EYE.far / EYE.near).powf(0.5 + 0.4 * depth);
        let ahead = EYE.axis_world() + 0.5 * (x * DVec3::X + y * DVec3::Y);
        Point { position: EYE.position + depth * ahead, normal: TOWARDS_LIGHT.normalize() }
    })
}

/// Slats and the top of a sheet are in front of cascades without a margin, and within those with a large one.
fn what_is_in_front_casts(gpu: &Gpu) -> Outcome {
    let mut mesh = avenue();
    mesh.parts.extend(sheet().parts);
    let on_surfaces = seen(&EYE, 6000, 4).into_iter().map(|seen| seen.point);
    let asked: Vec<_> = on_surfaces.chain(in_the_air(6000)).collect();
    let smoothies = |width, blend| {
        // Not wider than a guard without a margin, so that views with one are as large.
        let smoothies = SmoothieSettings { width, blend, width_max_ndc: 0.02, ..Default::default() };
        ShadowSettings { technique: Technique::Smoothies(smoothies), ..settings("smoothies") }
    };
    const MOST: f64 = 1e-3;
    for (name, settings) in [
        ("hardware depth", settings("pcf")),
        ("smoothies", smoothies(SmoothieWidth::FromLightSize, SmoothieBlend::TwoPasses)),
        ("even smoothies", smoothies(SmoothieWidth::Ndc(0.02), SmoothieBlend::TwoPasses)),
    ] {
        let draw = |mesh: &TestMesh, caster_margin| {
            let light = sun(ANGULAR_RADIUS, CascadeSettings { caster_margin, ..CascadeSettings::DEFAULT });
            let drawn = drawn(gpu, mesh, &settings, (&light, &EYE))?;
            Ok::<_, String>(visibility_at(gpu, &drawn.shadows, drawn.light(), &asked, None))
        };
        let within = draw(&mesh, 2.0)?;
        let difference = |found: Vec<f32>| {
            let sum: f32 = within.iter().zip(found).map(|(within, found)| (within - found).abs()).sum();
            f64::from(sum) / asked.len() as f64
        };
        let in_front = difference(draw(&mesh, 0.0)?);
        // Without the slats, as if they were cut off.
        let mut cut = mesh.clone();
        cut.parts.retain(|part| part.world_from_object.w_axis.y < 10.0);
        let cut = difference(draw(&cut, 0.0)?);
        eprintln!("{name}: a mean difference of {in_front:.5}, {cut:.5} where what is in front is cut off");
        if !(in_front <= MOST && cut > 10.0 * MOST) {
            return Err(format!("{name}: {in_front} where casters are in front, {cut} where they are cut off"));
        }
    }
    Ok(())
}
