//! Smoothie shadows in a small forward renderer that owns its device, encoder and passes.
//!
//! `cargo run --release -p contrejour --example forward`

#[allow(dead_code, reason = "each example uses its part")]
mod common;

use std::sync::Arc;

use common::{Outcome, SIZE, Torus};
use contrejour::glam::DMat4;
use contrejour::prelude::*;
use contrejour::wgpu;

/// The renderer's own shader; contrejour's visibility function is appended to it.
const SHADER: &str = r#"
@group(0) @binding(0) var<uniform> eye_clip_from_world: mat4x4f;

struct Vertex {
    @builtin(position) clip: vec4f,
    @location(0) position_world: vec3f,
}

@vertex
fn vertex_main(@location(0) position_world: vec3f) -> Vertex {
    return Vertex(eye_clip_from_world * vec4f(position_world, 1.0), position_world);
}

@fragment
fn fragment_main(vertex: Vertex) -> @location(0) vec4f {
    let normal = normalize(cross(dpdy(vertex.position_world), dpdx(vertex.position_world)));
    let towards_light = normalize(vec3f(2.0, 6.0, 2.5) - vertex.position_world);
    let diffuse = max(dot(normal, towards_light), 0.0) * contrejour_visibility(vertex.position_world, normal);
    return vec4f(vec3f(0.9, 0.85, 0.75) * (0.08 + 0.8 * diffuse), 1.0);
}
"#;

fn main() -> Outcome {
    let (device, queue) = common::open_device()?;
    let torus = Torus::new(96, 48);

    // Once: add what casts, and a light.
    let mut shadows = Shadows::new(&device)?;
    let mesh = TopologyAwareMesh::build(&torus.positions, &torus.triangles, &BuildOptions::default())?;
    let mesh = shadows.add_mesh(Arc::new(mesh))?;
    // The floor too: a shadow hardens towards what is in the map.
    let floor = TopologyAwareMesh::build(&common::FLOOR, &[[0, 1, 2], [3, 4, 5]], &BuildOptions::default())?;
    let floor = shadows.add_mesh(Arc::new(floor))?;
    let body = CasterInput { mesh, world_from_object: common::world_from_body(), positions: Positions::OfMesh };
    let floor = CasterInput { mesh: floor, world_from_object: DMat4::IDENTITY, positions: Positions::OfMesh };
    shadows.add_caster(&body)?;
    shadows.add_caster(&floor)?;
    let light = shadows.add_light(&common::light(), &ShadowOptions::default())?;

    // Each frame: prepare, and record the maps before the pass that reads them.
    shadows.prepare(&device, &queue)?;
    let mut encoder = device.create_command_encoder(&Default::default());
    shadows.encode(&mut encoder, &mut Untimed);

    // The renderer's own pass, with contrejour's bind group beside its own.
    let picture = common::target(&device, wgpu::TextureFormat::Rgba8UnormSrgb, wgpu::TextureUsages::COPY_SRC);
    let depth = common::target(&device, wgpu::TextureFormat::Depth32Float, wgpu::TextureUsages::empty());
    let (vertices, vertex_count) = common::scene_vertices(&device, &torus);
    let pipeline = pipeline(&device, &shadows, light);
    let eye = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("eye"),
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[wgpu::BindGroupEntry { binding: 0, resource: common::eye_uniform(&device).as_entire_binding() }],
    });
    {
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("forward"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &picture.create_view(&Default::default()),
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth.create_view(&Default::default()),
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        pass.set_pipeline(&pipeline);
        pass.set_bind_group(0, &eye, &[]);
        pass.set_bind_group(1, shadows.visibility_bind_group(light), &[]);
        pass.set_vertex_buffer(0, vertices.slice(..));
        pass.draw(0..vertex_count, 0..1);
    }
    queue.submit([encoder.finish()]);
    println!("{} ({SIZE} x {SIZE})", common::save(&device, &queue, &picture, "contrejour-forward.png")?.display());
    Ok(())
}

fn pipeline(device: &wgpu::Device, shadows: &Shadows, light: LightHandle) -> wgpu::RenderPipeline {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("forward"),
        source: wgpu::ShaderSource::Wgsl(format!("{SHADER}\n{}", shadows.visibility_wgsl(light, 1)).into()),
    });
    let eye_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("eye"),
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        }],
    });
    let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("forward"),
        bind_group_layouts: &[Some(&eye_layout), Some(shadows.visibility_layout(light))],
        immediate_size: 0,
    });
    device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("forward"),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex_main"),
            compilation_options: Default::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: 12,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Float32x3],
            })],
        },
        primitive: Default::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: wgpu::TextureFormat::Depth32Float,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: Some(wgpu::FragmentState {
            module: &module,
            entry_point: Some("fragment_main"),
            compilation_options: Default::default(),
            targets: &[Some(wgpu::TextureFormat::Rgba8UnormSrgb.into())],
        }),
        multiview_mask: None,
        cache: None,
    })
}
