//! The visibility function of a light, asked from any points.

use contrejour_gpu::{LightHandle, Shadows};
use glam::DVec3;
use wgpu::BufferUsages;

use crate::gpu::Gpu;
use crate::planted::{Replaced, planted};

/// A point of a surface.
#[derive(Clone, Copy, Debug)]
pub struct Point {
    /// Where it is, world space.
    pub position: DVec3,
    /// The surface's unit normal.
    pub normal: DVec3,
}

const ASK: &str = "
@group(0) @binding(0) var<storage, read> points: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> found: array<f32>;

@compute @workgroup_size(64)
fn ask(@builtin(global_invocation_id) id: vec3u) {
    if id.x < arrayLength(&found) {
        found[id.x] = contrejour_visibility(points[2u * id.x].xyz, points[2u * id.x + 1u].xyz);
    }
}
";

/// What a light's function says of points after a frame, 0 dark to 1 lit; with a fault where one is given.
///
/// # Panics
///
/// When the function's text does not have the piece exactly once: then the fault would be none.
pub fn visibility_at(
    gpu: &Gpu,
    shadows: &Shadows,
    light: LightHandle,
    points: &[Point],
    fault: Option<Replaced>,
) -> Vec<f32> {
    let device = &gpu.device;
    let mut function = shadows.visibility_wgsl(light, 1);
    if let Some(fault) = fault {
        function = planted(&function, fault);
    }
    let entry = |binding, read_only| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::COMPUTE,
        ty: wgpu::BindingType::Buffer {
            ty: wgpu::BufferBindingType::Storage { read_only },
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("ask"),
        entries: &[entry(0, true), entry(1, false)],
    });
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("ask"),
        source: wgpu::ShaderSource::Wgsl(format!("{ASK}{function}").into()),
    });
    let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("ask"),
        bind_group_layouts: &[Some(&layout), Some(shadows.visibility_layout(light))],
        immediate_size: 0,
    });
    let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
        label: Some("ask"),
        layout: Some(&pipeline_layout),
        module: &module,
        entry_point: Some("ask"),
        compilation_options: Default::default(),
        cache: None,
    });
    let rows: Vec<[f32; 4]> = (points.iter().flat_map(|point| [point.position, point.normal]))
        .map(|vector| vector.as_vec3().extend(0.0).to_array())
        .collect();
    let asked = gpu.upload("points", bytemuck::cast_slice(&rows), BufferUsages::STORAGE);
    let found = gpu.upload("found", bytemuck::cast_slice(&vec![-1.0_f32; points.len()]), BufferUsages::STORAGE);
    let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("ask"),
        layout: &layout,
        entries: &[
            wgpu::BindGroupEntry { binding: 0, resource: asked.as_entire_binding() },
            wgpu::BindGroupEntry { binding: 1, resource: found.as_entire_binding() },
        ],
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    let mut pass = encoder.begin_compute_pass(&Default::default());
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &bind_group, &[]);
    pass.set_bind_group(1, shadows.visibility_bind_group(light), &[]);
    pass.dispatch_workgroups(points.len().div_ceil(64) as u32, 1, 1);
    drop(pass);
    gpu.queue.submit([encoder.finish()]);
    gpu.read_back(&found, points.len())
}
