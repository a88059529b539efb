//! Pipelines that draw the scene's meshes.

use crate::Gpu;
use crate::scene_meshes::VERTEX_LAYOUTS;
use crate::targets::DEPTH_FORMAT;

/// Bind groups of the modules that draw the scene's meshes.
pub(crate) const FRAME_GROUP: u32 = 0;
pub(crate) const SURFACE_GROUP: u32 = 1;

/// Two entry points of a module.
#[derive(Clone, Copy, Debug)]
pub(crate) struct EntryPoints {
    pub vertex: &'static str,
    pub fragment: &'static str,
}

/// A pipeline that draws meshes against the reversed depth buffer, the nearest over all others.
pub(crate) fn scene_pipeline(
    gpu: &Gpu,
    layout: &wgpu::PipelineLayout,
    module: &wgpu::ShaderModule,
    entry_points: EntryPoints,
    formats: &[wgpu::TextureFormat],
) -> wgpu::RenderPipeline {
    let targets: Vec<_> = formats.iter().map(|&format| format.into()).collect();
    let depth = depth_state(wgpu::CompareFunction::GreaterEqual, true);
    mesh_pipeline(gpu, (layout, module), entry_points, &targets, depth)
}

/// A pipeline that draws meshes. Both sides are drawn: meshes may be open, and wound as they like.
pub(crate) fn mesh_pipeline(
    gpu: &Gpu,
    (layout, module): (&wgpu::PipelineLayout, &wgpu::ShaderModule),
    entry_points: EntryPoints,
    targets: &[wgpu::ColorTargetState],
    depth: wgpu::DepthStencilState,
) -> wgpu::RenderPipeline {
    let targets: Vec<_> = targets.iter().cloned().map(Some).collect();
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(entry_points.fragment),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(entry_points.vertex),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &VERTEX_LAYOUTS.map(Some),
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(depth),
        multisample: wgpu::MultisampleState { count: gpu.sample_count, ..Default::default() },
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(entry_points.fragment),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &targets,
        }),
        multiview_mask: None,
        cache: None,
    })
}

/// A test against the reversed depth buffer.
pub(crate) fn depth_state(compare: wgpu::CompareFunction, writes: bool) -> wgpu::DepthStencilState {
    wgpu::DepthStencilState {
        format: DEPTH_FORMAT,
        depth_write_enabled: Some(writes),
        depth_compare: Some(compare),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    }
}
