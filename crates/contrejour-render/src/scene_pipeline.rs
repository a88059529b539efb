//! Pipelines that draw the scene's meshes.

use crate::Gpu;
use crate::scene_meshes::{Parts, SceneMeshes, VERTEX_LAYOUTS};
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

/// Pipelines that fill the depth buffer: alpha cuts what they draw.
#[derive(Debug)]
pub(crate) struct ScenePipelines {
    uncut: wgpu::RenderPipeline,
    /// Where the scene has parts that alpha cuts.
    cut: Option<wgpu::RenderPipeline>,
}

impl ScenePipelines {
    /// Draw meshes against the reversed depth buffer by a comparison.
    pub fn new(
        gpu: &Gpu,
        (layout, module): (&wgpu::PipelineLayout, &wgpu::ShaderModule),
        entry_points: EntryPoints,
        formats: &[wgpu::TextureFormat],
        (compare, has_cuts): (wgpu::CompareFunction, bool),
    ) -> Self {
        let targets: Vec<_> = formats.iter().map(|&format| format.into()).collect();
        let depth = || depth_state(compare, true);
        let pipeline = |cuts| mesh_pipeline(gpu, (layout, module), entry_points, &targets, (depth(), cuts));
        Self { uncut: pipeline(false), cut: has_cuts.then(|| pipeline(true)) }
    }

    /// Draws everything; the other groups are bound.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, meshes: &SceneMeshes) {
        pass.set_pipeline(&self.uncut);
        meshes.draw(pass, SURFACE_GROUP, Parts::Uncut);
        if let Some(cut) = &self.cut {
            pass.set_pipeline(cut);
            meshes.draw(pass, SURFACE_GROUP, Parts::Cut);
        }
    }
}

/// A pipeline that draws meshes, cut by alpha or not. Both sides are drawn: meshes may be open, and wound as they like.
pub(crate) fn mesh_pipeline(
    gpu: &Gpu,
    (layout, module): (&wgpu::PipelineLayout, &wgpu::ShaderModule),
    entry_points: EntryPoints,
    targets: &[wgpu::ColorTargetState],
    (depth, cuts): (wgpu::DepthStencilState, bool),
) -> wgpu::RenderPipeline {
    let constants = [("cuts", f64::from(u8::from(cuts)))];
    let compilation_options = wgpu::PipelineCompilationOptions { constants: &constants, ..Default::default() };
    let targets: Vec<_> = targets.iter().cloned().map(Some).collect();
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(entry_points.fragment),
        layout: Some(layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some(entry_points.vertex),
            compilation_options: compilation_options.clone(),
            buffers: &VERTEX_LAYOUTS.map(Some),
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(depth),
        multisample: wgpu::MultisampleState { count: gpu.sample_count, ..Default::default() },
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(entry_points.fragment),
            compilation_options,
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
