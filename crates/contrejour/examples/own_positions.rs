//! A caster whose positions a stage of the caller's writes: a wave runs through the torus, and its silhouette follows.
//!
//! `cargo run --release -p contrejour --example own_positions`

#[allow(dead_code, reason = "each example uses its part")]
mod common;

use std::sync::Arc;

use common::{Outcome, Torus};
use contrejour::mesh::Motion;
use contrejour::prelude::*;
use contrejour::wgpu::{self, util::DeviceExt};

/// The caller's own deformation. Its vertices have 16 bytes; contrejour reads the first 12 of each.
const SHADER: &str = r#"
@group(0) @binding(0) var<storage, read> rest: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> deformed: array<vec4f>;
override time = 0.0;

@compute @workgroup_size(64)
fn wave(@builtin(global_invocation_id) id: vec3u) {
    if id.x < arrayLength(&rest) {
        let position = rest[id.x];
        deformed[id.x] = position + vec4f(0.0, 0.5 * sin(3.0 * position.x + time), 0.0, 0.0);
    }
}
"#;

const STRIDE: u64 = 16;

fn main() -> Outcome {
    let (device, queue) = common::open_device()?;
    let torus = Torus::new(96, 48);

    // Every edge of a deforming mesh can come into a silhouette.
    let options = BuildOptions { motion: Motion::Deforming, ..Default::default() };
    let mesh = TopologyAwareMesh::build(&torus.positions, &torus.triangles, &options)?;
    let mut shadows = Shadows::new(&device)?;
    let mesh = shadows.add_mesh(Arc::new(mesh))?;

    let rest: Vec<[f32; 4]> = torus.positions.iter().map(|&[x, y, z]| [x, y, z, 1.0]).collect();
    let rest = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("rest"),
        contents: bytemuck::cast_slice(&rest),
        usage: wgpu::BufferUsages::STORAGE,
    });
    let deformed = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("deformed"),
        size: STRIDE * torus.positions.len() as u64,
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });

    let positions = Positions::InBuffer { buffer: deformed.clone(), offset: 0, stride: STRIDE, known: None };
    shadows.add_caster(&CasterInput { mesh, world_from_object: common::world_from_body(), positions })?;
    shadows.add_light(&common::light(), &ShadowOptions::default())?;
    for time in [0.0, 1.0, 2.0] {
        shadows.prepare(&device, &queue)?;
        let mut encoder = device.create_command_encoder(&Default::default());
        deform(&device, &mut encoder, &rest, &deformed, time);
        shadows.encode(&mut encoder, &mut Untimed);
        queue.submit([encoder.finish()]);
        let counters = shadows.wait_for_counters(&device)?;
        println!("at {time}: {} silhouette edges, {} quads", counters.silhouette_edges, counters.quads);
    }
    Ok(())
}

fn deform(
    device: &wgpu::Device,
    encoder: &mut wgpu::CommandEncoder,
    rest: &wgpu::Buffer,
    deformed: &wgpu::Buffer,
    time: f64,
) {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("wave"),
        source: wgpu::ShaderSource::Wgsl(SHADER.into()),
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("wave"),
        layout: None,
        module: &module,
        entry_point: Some("wave"),
        compilation_options: wgpu::PipelineCompilationOptions { constants: &[("time", time)], ..Default::default() },
        cache: None,
    });
    let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("wave"),
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: rest.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: deformed.as_entire_binding() },
        ],
    });
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &bind_group, &[]);
    pass.dispatch_workgroups((deformed.size() / STRIDE).div_ceil(64) as u32, 1, 1);
}
