//! Smoothie shadows for a deferred renderer: a full-screen visibility texture from the eye's depth buffer.
//!
//! `cargo run --release -p contrejour --example deferred`

#[allow(dead_code, reason = "each example uses its part")]
mod common;

use std::sync::Arc;

use common::{Outcome, Torus};
use contrejour::glam::DMat4;
use contrejour::prelude::*;
use contrejour::wgpu;

/// The renderer's depth pass; a deferred renderer would fill its other buffers here too.
const SHADER: &str = r#"
@group(0) @binding(0) var<uniform> eye_clip_from_world: mat4x4f;

@vertex
fn vertex_main(@location(0) position_world: vec3f) -> @builtin(position) vec4f {
    return eye_clip_from_world * vec4f(position_world, 1.0);
}
"#;

fn main() -> Outcome {
    let (device, queue) = common::open_device()?;
    let torus = Torus::new(96, 48);
    let options = ShadowOptions { outputs: Outputs::VisibilityTexture, ..Default::default() };
    let mut shadows = Shadows::new(&device, &options)?;
    let mesh = TopologyAwareMesh::build(&torus.positions, &torus.triangles, &BuildOptions::default())?;
    let mesh = shadows.add_mesh(Arc::new(mesh))?;
    // The floor too: a shadow hardens towards what is in the map.
    let floor = TopologyAwareMesh::build(&common::FLOOR, &[[0, 1, 2], [3, 4, 5]], &BuildOptions::default())?;
    let floor = shadows.add_mesh(Arc::new(floor))?;

    let light = common::light();
    let body = CasterInput { mesh, world_from_object: common::world_from_body(), positions: Positions::OfMesh };
    let floor = CasterInput { mesh: floor, world_from_object: DMat4::IDENTITY, positions: Positions::OfMesh };
    shadows.prepare(&device, &queue, &FrameInput { light: &light, casters: &[body, floor] })?;
    let mut encoder = device.create_command_encoder(&Default::default());
    shadows.encode(&mut encoder, &mut Untimed);

    // The renderer's own depth, then visibility for each of its pixels.
    let depth = common::target(&device, wgpu::TextureFormat::Depth32Float, wgpu::TextureUsages::TEXTURE_BINDING);
    let depth = depth.create_view(&Default::default());
    draw_depth(&device, &mut encoder, &torus, &depth);
    let visibility = common::target(&device, wgpu::TextureFormat::R8Unorm, wgpu::TextureUsages::COPY_SRC);
    let eye = EyeInput {
        depth: &depth,
        world_from_eye_clip: common::eye_clip_from_world().inverse(),
        background_depth: 1.0,
        target: &visibility.create_view(&Default::default()),
    };
    shadows.encode_visibility(&device, &queue, &mut encoder, &eye, &mut Untimed);
    queue.submit([encoder.finish()]);
    println!("{}", common::save(&device, &queue, &visibility, "contrejour-deferred.png")?.display());
    Ok(())
}

fn draw_depth(device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, torus: &Torus, depth: &wgpu::TextureView) {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("depth"),
        source: wgpu::ShaderSource::Wgsl(SHADER.into()),
    });
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("depth"),
        layout: None,
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
        fragment: None,
        multiview_mask: None,
        cache: None,
    });
    let eye = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("eye"),
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[wgpu::BindGroupEntry { binding: 0, resource: common::eye_uniform(device).as_entire_binding() }],
    });
    let (vertices, vertex_count) = common::scene_vertices(device, torus);
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("depth"),
        color_attachments: &[],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: depth,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store }),
            stencil_ops: None,
        }),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &eye, &[]);
    pass.set_vertex_buffer(0, vertices.slice(..));
    pass.draw(0..vertex_count, 0..1);
}
