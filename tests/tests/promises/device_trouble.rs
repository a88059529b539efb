//! Nothing of the device's troubles is lost: each is a typed error, and the caller can go on.

use std::sync::Arc;

use contrejour_gpu::{
    CasterInput, CountersError, DeviceError, EyeInput, NewShadowsError, Positions, PrepareError, ShadowOptions,
    Shadows, Untimed,
};
use contrejour_plan::{BufferKind, Light, Outputs, ShadowSettings, Technique};
use contrejour_render::{DeviceFault, Gpu as RenderGpu, Judge, NewRendererError, PrepareShadowsError, Renderer};
use contrejour_scene::Scene;
use contrejour_tests::gpu::{Gpu, gpu_alone, gpu_with_large_textures};
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::image_compare::{ImageTolerance, compare_images};
use contrejour_tests::lights::lights;
use contrejour_tests::meshes::{TestMesh, shapes};
use contrejour_tests::pipeline::Pipeline;
use contrejour_tests::texture::read_floats;
use glam::DMat4;
use libtest_mimic::Trial;

pub fn trials() -> Vec<Trial> {
    let trial = |name: &str, test: fn() -> Outcome| gpu_trial(format!("device_trouble::{name}"), move |_| test());
    vec![
        trial("a_lost_device_is_told_and_left_behind", a_lost_device_is_told),
        trial("a_device_lost_under_way_hangs_nothing", a_device_lost_under_way),
        trial("a_frame_that_failed_is_made_again", a_frame_that_failed_is_made_again),
        trial("lack_of_memory_is_told_with_its_size", lack_of_memory_is_told),
        trial("a_format_that_cannot_be_drawn_into_is_refused", a_wrong_format_is_refused),
        trial("positions_that_were_destroyed_spoil_one_frame", destroyed_positions_spoil_one_frame),
        trial("the_renderer_tells_a_lost_device", the_renderer_tells_a_lost_device),
        trial("pictures_need_no_more_than_the_defaults", pictures_need_no_more_than_the_defaults),
    ]
}

fn text(error: impl std::error::Error) -> String {
    error.to_string()
}

fn body() -> TestMesh {
    shapes().swap_remove(1)
}

fn small(technique: Technique) -> ShadowOptions {
    let settings = ShadowSettings { map_size: 64, technique, ..Default::default() };
    ShadowOptions { settings, outputs: Outputs::Maps, ..Default::default() }
}

/// What the last frame found and drew.
fn left_by(gpu: &Gpu, pipeline: &mut Pipeline<'_>, light: &Light) -> Result<(Vec<u64>, Vec<f32>), String> {
    pipeline.complete_frame(light)?;
    let mut edges: Vec<u64> =
        pipeline.silhouettes().iter().map(|edge| u64::from(edge.caster) << 32 | u64::from(edge.edge_id)).collect();
    edges.sort_unstable();
    let depth = pipeline.maps().shadow_depth.ok_or("there is no map")?;
    Ok((edges, read_floats(gpu, depth)))
}

fn a_lost_device_is_told() -> Outcome {
    let (mesh, options) = (body(), small(Technique::default()));
    let light = lights(&mesh)[0];
    let gpu = gpu_alone()?;
    let mut pipeline = Pipeline::new(&gpu, &mesh, &options)?;
    let before = left_by(&gpu, &mut pipeline, &light)?;
    gpu.device.destroy();

    for frame in 0..2 {
        let lost = pipeline.prepare(&light);
        if !matches!(lost, Err(PrepareError::Device(DeviceError::Lost))) {
            return Err(format!("frame {frame} on a lost device was prepared: {lost:?}"));
        }
    }
    let lost = pipeline.shadows.wait_for_counters(&gpu.device);
    if !matches!(lost, Err(CountersError::Device(DeviceError::Lost))) {
        return Err(format!("a lost device has counted {lost:?}"));
    }
    let lost = Shadows::new(&gpu.device).map(|_| ());
    if !matches!(lost, Err(NewShadowsError::Device(DeviceError::Lost))) {
        return Err(format!("a lost device is as good as new: {lost:?}"));
    }

    let gpu = gpu_alone()?;
    let again = left_by(&gpu, &mut Pipeline::new(&gpu, &mesh, &options)?, &light)?;
    if again == before { Ok(()) } else { Err("what was built again draws another picture".into()) }
}

/// Between prepare and submission nobody asks: what is recorded comes to nothing, and the next call tells.
fn a_device_lost_under_way() -> Outcome {
    let mesh = body();
    let [first, second] = [0, 1].map(|light| lights(&mesh)[light]);
    let gpu = gpu_alone()?;
    let mut pipeline = Pipeline::new(&gpu, &mesh, &small(Technique::default()))?;
    pipeline.complete_frame(&first)?;
    let part = &mesh.parts[0];
    let mut shadows = Shadows::new(&gpu.device).map_err(text)?;
    let handle = shadows.add_mesh(Arc::clone(&part.topology)).map_err(text)?;
    let caster = CasterInput { mesh: handle, world_from_object: DMat4::IDENTITY, positions: Positions::OfMesh };
    shadows.add_caster(&caster).map_err(text)?;
    shadows.add_light(&second, &small(Technique::default())).map_err(text)?;
    shadows.prepare(&gpu.device, &gpu.queue).map_err(text)?;
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    gpu.device.destroy();
    shadows.encode(&mut encoder, &mut Untimed);
    gpu.queue.submit([encoder.finish()]);
    match shadows.wait_for_counters(&gpu.device) {
        Err(CountersError::Device(DeviceError::Lost)) => Ok(()),
        other => Err(format!("a lost device has counted {other:?}")),
    }
}

/// A buffer of the library's that somebody destroys stands for whatever the device may refuse.
fn a_frame_that_failed_is_made_again() -> Outcome {
    let mut mesh = body();
    mesh.parts.push(mesh.parts[0].clone());
    let light = lights(&mesh)[0];
    let gpu = gpu_alone()?;
    let mut pipeline = Pipeline::new(&gpu, &mesh, &small(Technique::default()))?;
    let before = left_by(&gpu, &mut pipeline, &light)?;
    pipeline.shadows.buffer(BufferKind::Casters).ok_or("there are casters")?.buffer().destroy();

    // A caster comes and another goes, so the records of all are written again.
    pipeline.replace_last();
    let refused = pipeline.prepare(&light);
    let told =
        matches!(&refused, Err(PrepareError::Device(DeviceError::Refused { text })) if text.contains("destroyed"));
    if !told || pipeline.plan().is_some() {
        return Err(format!("the frame is kept, or the reason is not told: {refused:?}"));
    }
    let again = left_by(&gpu, &mut pipeline, &light)?;
    if again == before { Ok(()) } else { Err("what was made again draws another picture".into()) }
}

/// Moments of 16384 x 16384 texels in 16 bytes are 5.3 GiB with their levels; software drivers give out 2 GiB at once.
fn lack_of_memory_is_told() -> Outcome {
    let gpu = match gpu_with_large_textures() {
        Ok(gpu) => gpu,
        Err(reason) => {
            eprintln!("not tested: {reason}");
            return Ok(());
        }
    };
    let mesh = body();
    let light = lights(&mesh)[0];
    let mut options = small("vsm".parse().map_err(text)?);
    options.settings.map_size = gpu.device.limits().max_texture_dimension_2d;
    let mut pipeline = Pipeline::new(&gpu, &mesh, &options)?;
    for attempt in 0..2 {
        match pipeline.prepare(&light) {
            Err(PrepareError::Device(DeviceError::OutOfMemory { bytes, text })) => {
                if bytes < 1 << 32 || !text.contains("moments") {
                    return Err(format!(
                        "{bytes} bytes are not all that was asked for, or the map is not named: {text}"
                    ));
                }
            }
            Ok(()) if attempt == 0 => {
                eprintln!("not tested: this device has memory for everything");
                return Ok(());
            }
            other => return Err(format!("attempt {attempt}: {other:?}")),
        }
        if pipeline.plan().is_some() {
            return Err("a frame without its maps is kept".into());
        }
    }
    // The device goes on.
    left_by(&gpu, &mut Pipeline::new(&gpu, &mesh, &small(Technique::default()))?, &light).map(|_| ())
}

fn a_wrong_format_is_refused() -> Outcome {
    let gpu = gpu_alone()?;
    let mesh = body();
    let options = ShadowOptions {
        visibility_format: wgpu::TextureFormat::Depth32Float,
        outputs: Outputs::VisibilityTexture,
        ..small(Technique::default())
    };
    let mut pipeline = Pipeline::new(&gpu, &mesh, &options)?;
    pipeline.complete_frame(&lights(&mesh)[0])?;
    let view = |usage| {
        let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
            label: Some("eye"),
            size: wgpu::Extent3d { width: 8, height: 8, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: wgpu::TextureFormat::Depth32Float,
            usage,
            view_formats: &[],
        });
        texture.create_view(&Default::default())
    };
    let (depth, target) = (view(wgpu::TextureUsages::TEXTURE_BINDING), view(wgpu::TextureUsages::RENDER_ATTACHMENT));
    let eye = EyeInput { depth: &depth, world_from_eye_clip: DMat4::IDENTITY, background_depth: 1.0, target: &target };
    for _ in 0..2 {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let light = pipeline.light();
        let on = (&gpu.device, &gpu.queue);
        let drawn = pipeline.shadows.encode_visibility(on, &mut encoder, light, &eye, &mut Untimed);
        if !matches!(drawn, Err(DeviceError::Refused { .. })) {
            return Err(format!("a depth format is drawn into as a colour: {drawn:?}"));
        }
        // Nothing was recorded, so nothing is wrong with the caller's commands.
        gpu.queue.submit([encoder.finish()]);
    }
    gpu.device.destroy();
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let light = pipeline.light();
    match pipeline.shadows.encode_visibility((&gpu.device, &gpu.queue), &mut encoder, light, &eye, &mut Untimed) {
        Err(DeviceError::Lost) => Ok(()),
        other => Err(format!("a lost device draws: {other:?}")),
    }
}

/// The library cannot see that a buffer of the caller's is destroyed; the caller's own scope does, and later frames are
/// whole.
fn destroyed_positions_spoil_one_frame() -> Outcome {
    let gpu = gpu_alone()?;
    let mesh = body();
    let light = lights(&mesh)[0];
    let part = &mesh.parts[0];
    let mut shadows = Shadows::new(&gpu.device).map_err(text)?;
    shadows.add_light(&light, &small(Technique::default())).map_err(text)?;
    let handle = shadows.add_mesh(Arc::clone(&part.topology)).map_err(text)?;
    let positions = || {
        let bytes = bytemuck::cast_slice(&part.topology.positions);
        gpu.upload("positions", bytes, wgpu::BufferUsages::STORAGE)
    };
    let mut frame = |buffer: &wgpu::Buffer| -> Result<Option<String>, String> {
        let positions = Positions::InBuffer { buffer: buffer.clone(), offset: 0, stride: 12, known: None };
        let caster = CasterInput { mesh: handle, world_from_object: part.world_from_object, positions };
        let caster = shadows.add_caster(&caster).map_err(text)?;
        shadows.prepare(&gpu.device, &gpu.queue).map_err(text)?;
        let scope = gpu.device.push_error_scope(wgpu::ErrorFilter::Validation);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        shadows.encode(&mut encoder, &mut Untimed);
        gpu.queue.submit([encoder.finish()]);
        let spoiled = pollster::block_on(scope.pop()).map(|error| error.to_string());
        if spoiled.is_none() {
            shadows.wait_for_counters(&gpu.device).map_err(text)?;
        }
        shadows.remove_caster(caster).map_err(text)?;
        Ok(spoiled)
    };
    let destroyed = positions();
    destroyed.destroy();
    let told = frame(&destroyed)?.ok_or("destroyed positions were read")?;
    if !told.contains("destroyed") {
        return Err(format!("the reason is not told: {told}"));
    }
    frame(&positions())?.map_or(Ok(()), Err)
}

fn small_scene() -> Result<Scene, String> {
    let mut scene = Scene::built_in(Some("cylinder")).ok_or("there is such a scene")?.map_err(text)?;
    scene.resize([160, 100]);
    Ok(scene)
}

fn the_renderer_tells_a_lost_device() -> Outcome {
    let scene = small_scene()?;
    let gpu = RenderGpu::open().map_err(text)?;
    let mut renderer = Renderer::new(gpu.clone(), &scene).map_err(text)?;
    renderer.draw_complete().map_err(text)?;
    let mut contestant =
        Judge::new(gpu.clone(), &scene).map_err(text)?.contestant(&scene.lights[0].shadow).map_err(text)?;
    contestant.draw(&scene.lights[0].light).map_err(text)?;
    gpu.device.destroy();

    let told = [
        ("draw", renderer.draw_complete().map_err(text)),
        ("read a picture", renderer.picture().map(|_| ()).map_err(text)),
        ("measure", renderer.measurements().map(|_| ()).map_err(text)),
        ("view", renderer.views().map(|_| ()).map_err(text)),
        ("judge", contestant.draw(&scene.lights[0].light).map(|_| ()).map_err(text)),
        ("read visibility", contestant.visibility().map(|_| ()).map_err(text)),
        ("upload", Renderer::new(gpu.clone(), &scene).map(|_| ()).map_err(text)),
        ("make a judge", Judge::new(gpu.clone(), &scene).map(|_| ()).map_err(text)),
    ];
    for (what, outcome) in told {
        let error = outcome.err().ok_or_else(|| format!("a lost device can {what}"))?;
        if !error.contains("lost") || error.contains('\n') {
            return Err(format!("{what}: {error}"));
        }
    }
    match gpu.check() {
        Err(DeviceFault::Lost(_)) => Ok(()),
        other => Err(format!("the device is not known to be lost: {other:?}")),
    }
}

fn pictures_need_no_more_than_the_defaults() -> Outcome {
    let scene = small_scene()?;
    let basic = RenderGpu::open_with_defaults().map_err(text)?;
    let (limits, features) = (basic.device.limits(), basic.device.features());
    if limits.max_texture_dimension_2d != 8192 || features.contains(wgpu::Features::TIMESTAMP_QUERY) {
        return Err("the device has more than the defaults".into());
    }
    let picture = |gpu: RenderGpu| -> Result<_, String> {
        let mut renderer = Renderer::new(gpu, &scene).map_err(text)?;
        renderer.draw_complete().map_err(text)?;
        renderer.views().map_err(text)?;
        renderer.measurements().map_err(text)?;
        renderer.picture().map_err(text)
    };
    let tolerance = ImageTolerance { mean: 0.25, max: 110 };
    let full = picture(RenderGpu::open().map_err(text)?)?;
    compare_images("defaults", &full, &picture(basic.clone())?, tolerance)?;
    let judge = Judge::new(basic, &scene).map_err(text)?;
    judge.contestant(&scene.lights[0].shadow).map_err(text)?.draw(&scene.lights[0].light).map_err(text)?;
    let mut too_large = scene.clone();
    too_large.set_shadow(&ShadowSettings { map_size: 16_384, ..Default::default() });
    match Renderer::new(RenderGpu::open_with_defaults().map_err(text)?, &too_large).map(|_| ()) {
        Err(NewRendererError::Prepare(PrepareShadowsError::Prepare(PrepareError::Plan(_)))) => Ok(()),
        other => Err(format!("a map larger than the defaults allow: {other:?}")),
    }
}
