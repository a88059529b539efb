//! Where a stage of the caller's moves the vertices on the device, the bits that it leaves are what facing is exact about.

use std::f64::consts::TAU;
use std::sync::Arc;

use contrejour_gpu::{CasterInput, Positions, ShadowOptions, Shadows, Untimed};
use contrejour_mesh::{BuildOptions, Motion, TopologyAwareMesh};
use contrejour_plan::{
    BufferKind, Light, LightKind, Outputs, Reason, ShadowSettings, SilhouetteMapSettings, Technique,
};
use contrejour_tests::exhaust::{Exhaust, OwnPositions};
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::lights::point;
use contrejour_tests::many_lights::{adversarial_lights, random_lights};
use contrejour_tests::meshes::{TestPart, shapes, shared_named};
use contrejour_tests::random::Random;
use contrejour_tests::texture::read_floats;
use glam::{DMat4, DVec3};
use libtest_mimic::Trial;

/// Two bones that a vertex follows by its height, as a skin does; positions have 16 bytes.
const SKIN: &str = r#"
struct Bones {
    low: mat4x4f,
    high: mat4x4f,
}

@group(0) @binding(0) var<uniform> bones: Bones;
@group(0) @binding(1) var<storage, read> rest: array<vec4f>;
@group(0) @binding(2) var<storage, read_write> moved: array<vec4f>;

@compute @workgroup_size(64)
fn skin(@builtin(global_invocation_id) id: vec3u) {
    if id.x < arrayLength(&rest) {
        let position = vec4f(rest[id.x].xyz, 1.0);
        let weight = smoothstep(-0.5, 0.5, position.y);
        moved[id.x] = mix(bones.low * position, bones.high * position, weight);
    }
}
"#;

/// Files with seams, skins, faces without area and non-manifold edges.
const FILES: [&str; 4] =
    ["animated/RiggedFigure.glb", "closed/Suzanne/Suzanne.gltf", "nasty/hollowcube.obj", "nasty/Offset1.obj"];

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("own_positions::silhouettes_are_exact_where_the_device_moves_vertices", are_exact),
        gpu_trial("own_positions::planes_come_with_the_positions_of_the_mesh", planes_come_with_the_mesh),
        gpu_trial("own_positions::a_stream_has_silhouettes_of_the_mesh_alone", a_stream_has_silhouettes_of_the_mesh),
    ]
}

fn are_exact(gpu: &Gpu) -> Outcome {
    let skin = skin_pipeline(gpu);
    let mut meshes = shapes();
    meshes.retain(|mesh| ["box", "torus", "knot"].contains(&mesh.name.as_str()));
    meshes.extend(shared_named(&FILES));
    let mut random = Random::new(3);
    for mesh in &meshes {
        // Ordinary numbers, numbers that lose bits far from the origin, subnormal and huge ones.
        for (scale, offset) in [(1.0, 0.0), (1.0, 3000.0), (1e-38, 0.0), (1e30, 0.0)] {
            let part = deforming(&mesh.parts[0])?;
            let moved = move_vertices(gpu, &skin, &part, scale, offset);
            let mut exhaust = Exhaust::of_moved(gpu, &part, moved)?;
            let faces = exhaust.faces();
            let mut lights = random_lights(&faces, 8, &mut random);
            lights.extend(adversarial_lights(&faces, 32, &mut random));
            if let Some(difference) = exhaust.run(&lights)?.first_difference {
                return Err(format!("{}, scale {scale}, offset {offset}: {difference}", mesh.name));
            }
        }
    }
    Ok(())
}

fn deforming(part: &TestPart) -> Result<TestPart, String> {
    let options = BuildOptions { motion: Motion::Deforming, ..Default::default() };
    let topology = TopologyAwareMesh::build(&part.topology.positions, &part.triangles, &options)
        .map_err(|error| error.to_string())?;
    Ok(TestPart { topology: Arc::new(topology), ..part.clone() })
}

/// The library gets the very buffer that the stage wrote; the CPU reads what is in it.
fn move_vertices(gpu: &Gpu, skin: &wgpu::ComputePipeline, part: &TestPart, scale: f64, offset: f64) -> OwnPositions {
    let bone = |turns: f64| {
        let turn = DMat4::from_axis_angle(DVec3::new(0.3, 0.9, 0.2).normalize(), turns * TAU);
        let place = DMat4::from_translation(DVec3::splat(offset)) * DMat4::from_scale(DVec3::splat(scale));
        (place * turn).as_mat4()
    };
    let rest: Vec<_> = part.topology.positions.iter().map(|&[x, y, z]| [x, y, z, 1.0]).collect();
    let buffers = [
        gpu.upload("bones", bytemuck::cast_slice(&[bone(0.1), bone(0.35)]), wgpu::BufferUsages::UNIFORM),
        gpu.upload("rest", bytemuck::cast_slice(&rest), wgpu::BufferUsages::STORAGE),
        gpu.upload("moved", &vec![0; size_of_val(&rest[..])], wgpu::BufferUsages::STORAGE),
    ];
    let entry = |(buffer, binding)| wgpu::BindGroupEntry { binding, resource: wgpu::Buffer::as_entire_binding(buffer) };
    let entries: Vec<_> = buffers.iter().zip(0..).map(entry).collect();
    let bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("skin"),
        layout: &skin.get_bind_group_layout(0),
        entries: &entries,
    });
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(skin);
    pass.set_bind_group(0, &bind_group, &[]);
    pass.dispatch_workgroups(rest.len().div_ceil(64) as u32, 1, 1);
    drop(pass);
    gpu.queue.submit([encoder.finish()]);

    let [_, _, buffer] = buffers;
    let moved: Vec<[f32; 4]> = gpu.read_back(&buffer, rest.len());
    OwnPositions { buffer, offset: 0, stride: 16, positions: moved.iter().map(|&[x, y, z, _]| [x, y, z]).collect() }
}

fn skin_pipeline(gpu: &Gpu) -> wgpu::ComputePipeline {
    let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("skin"),
        source: wgpu::ShaderSource::Wgsl(SKIN.into()),
    });
    gpu.device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("skin"),
        layout: None,
        module: &module,
        entry_point: Some("skin"),
        compilation_options: Default::default(),
        cache: None,
    })
}

const CORNERS: [[f32; 3]; 3] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

fn one_face() -> Result<Arc<TopologyAwareMesh>, String> {
    let options = BuildOptions { motion: Motion::Deforming, ..Default::default() };
    let topology = TopologyAwareMesh::build(&CORNERS, &[[0, 1, 2]], &options).map_err(|error| error.to_string())?;
    Ok(Arc::new(topology))
}

/// A face turns its back on the light while the caller moves it. The buffer of its plane is as large as one without.
fn planes_come_with_the_mesh(gpu: &Gpu) -> Outcome {
    let topology = one_face()?;
    let turned = [0, 2, 1].map(|corner| CORNERS[corner]);
    let buffer = gpu.upload("turned", bytemuck::cast_slice(&turned), wgpu::BufferUsages::STORAGE);
    let shadow_options = ShadowOptions { outputs: Outputs::Silhouettes, ..Default::default() };
    let mut shadows = Shadows::new(&gpu.device).map_err(|error| error.to_string())?;
    let mesh = shadows.add_mesh(topology).map_err(|error| error.to_string())?;
    let light = point(DVec3::new(0.1, 0.2, 4.0), DVec3::ZERO, 1.0);
    shadows.add_light(&light, &shadow_options).map_err(|error| error.to_string())?;
    let live = Positions::InBuffer { buffer, offset: 0, stride: 12, known: None };
    let takes_turns = [(live.clone(), 0_u32), (Positions::OfMesh, 1), (live, 0), (Positions::OfMesh, 1)];
    for (positions, expected) in takes_turns {
        let caster = CasterInput { mesh, world_from_object: DMat4::IDENTITY, positions: positions.clone() };
        let caster = shadows.add_caster(&caster).map_err(|error| error.to_string())?;
        shadows.prepare(&gpu.device, &gpu.queue).map_err(|error| error.to_string())?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        shadows.encode(&mut encoder, &mut Untimed);
        gpu.queue.submit([encoder.finish()]);
        shadows.wait_for_counters(&gpu.device).map_err(|error| error.to_string())?;
        let lit = shadows.buffer(BufferKind::Lit).ok_or("a frame with a face has lit bits")?;
        let found: u32 = gpu.read_part(lit, 1)[0];
        if found != expected {
            return Err(format!("lit bits are {found}, expected {expected} with {positions:?}"));
        }
        shadows.remove_caster(caster).map_err(|error| error.to_string())?;
    }
    Ok(())
}

/// What the caller moves is in the shadow map of a stream and not in its silhouette map, and the plan says so.
fn a_stream_has_silhouettes_of_the_mesh(gpu: &Gpu) -> Outcome {
    let buffer = gpu.upload("face", bytemuck::cast_slice(&CORNERS), wgpu::BufferUsages::STORAGE);
    let moved = Positions::InBuffer { buffer, offset: 0, stride: 12, known: None };
    let technique = Technique::SilhouetteMap(SilhouetteMapSettings::STREAM);
    let settings = ShadowSettings { technique, map_size: 64, ..Default::default() };
    let above = DVec3::new(0.1, 0.2, 4.0);
    let kind =
        LightKind::Spot { position: above, target: DVec3::ZERO, cone_angle: 1.0, radius: 0.1, near: 1.0, far: 9.0 };
    let light = Light { kind, color: [1.0; 3] };
    for (positions, has_silhouette) in [(Positions::OfMesh, true), (moved, false)] {
        let mut shadows = Shadows::new(&gpu.device).map_err(|error| error.to_string())?;
        let mesh = shadows.add_mesh(one_face()?).map_err(|error| error.to_string())?;
        let options = ShadowOptions { settings, ..Default::default() };
        let light = shadows.add_light(&light, &options).map_err(|error| error.to_string())?;
        let caster = CasterInput { mesh, world_from_object: DMat4::IDENTITY, positions };
        shadows.add_caster(&caster).map_err(|error| error.to_string())?;
        shadows.prepare(&gpu.device, &gpu.queue).map_err(|error| error.to_string())?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        shadows.encode(&mut encoder, &mut Untimed);
        gpu.queue.submit([encoder.finish()]);
        let maps = shadows.maps(light);
        let is_nearer = |depth: &f32| *depth < 9.0;
        let shadow_depth = read_floats(gpu, maps.shadow_depth.ok_or("there is no shadow map")?);
        let silhouettes = read_floats(gpu, maps.silhouette_map.ok_or("there is no silhouette map")?);
        let found = [shadow_depth.iter().any(is_nearer), silhouettes.iter().step_by(2).any(is_nearer)];
        let plan = shadows.plan(light).ok_or("the light was prepared")?;
        let is_told = plan.left_out.iter().any(|left_out| left_out.reason == Reason::StreamIsAtRest);
        if (found, is_told) != ([true, has_silhouette], !has_silhouette) {
            return Err(format!("in its maps: {found:?}, told as left out: {is_told}"));
        }
    }
    Ok(())
}
