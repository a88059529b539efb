//! The pass that draws the scene from the eye.

use contrejour_gpu::{Shadows, VisibilityKind};

use crate::Gpu;
use crate::frame_uniforms::FrameUniforms;
use crate::scene_meshes::{SceneMeshes, VERTEX_LAYOUT, surface_layout};
use crate::shaders::{SHADE, VISIBILITY_GROUP};
use crate::targets::{COLOR_FORMAT, DEPTH_FORMAT};

const FRAME_GROUP: u32 = 0;
const SURFACE_GROUP: u32 = 1;

/// What a picture shows on its surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shading {
    /// Light and material.
    Lit,
    /// Visibility of the light: black to white.
    Visibility,
}

impl Shading {
    fn entry_point(self) -> &'static str {
        match self {
            Self::Lit => "fragment_shade",
            Self::Visibility => "fragment_show_visibility",
        }
    }
}

/// Bind groups and shader of the pass, for one kind of visibility.
#[derive(Debug)]
pub(crate) struct PicturePass {
    kind: VisibilityKind,
    module: wgpu::ShaderModule,
    layout: wgpu::PipelineLayout,
    surface_layout: wgpu::BindGroupLayout,
    uniforms: wgpu::Buffer,
    frame_bind_group: wgpu::BindGroup,
}

impl PicturePass {
    /// The pass for shadows that were prepared.
    pub fn new(gpu: &Gpu, shadows: &Shadows) -> Self {
        let device = &gpu.device;
        let wgsl = format!("{SHADE}\n{}", shadows.visibility_wgsl(VISIBILITY_GROUP));
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("shade"),
            source: wgpu::ShaderSource::Wgsl(wgsl.into()),
        });
        let uniforms = device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("frame"),
            size: size_of::<FrameUniforms>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let frame_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("frame"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        let frame_bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("frame"),
            layout: &frame_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: uniforms.as_entire_binding() }],
        });
        let surface_layout = surface_layout(device);
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shade"),
            bind_group_layouts: &[Some(&frame_layout), Some(&surface_layout), Some(shadows.visibility_layout())],
            immediate_size: 0,
        });
        Self { kind: shadows.visibility_kind(), module, layout, surface_layout, uniforms, frame_bind_group }
    }

    /// Whether the pass looks up the maps that these shadows have.
    pub fn fits(&self, shadows: &Shadows) -> bool {
        self.kind == shadows.visibility_kind()
    }

    pub fn surface_layout(&self) -> &wgpu::BindGroupLayout {
        &self.surface_layout
    }

    pub fn pipeline(&self, gpu: &Gpu, shading: Shading) -> wgpu::RenderPipeline {
        gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(shading.entry_point()),
            layout: Some(&self.layout),
            vertex: wgpu::VertexState {
                module: &self.module,
                entry_point: Some("vertex_shade"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[Some(VERTEX_LAYOUT)],
            },
            // Both sides are drawn: meshes may be open, and wound as they like.
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(depth_state(wgpu::CompareFunction::GreaterEqual, true)),
            multisample: wgpu::MultisampleState { count: gpu.sample_count, ..Default::default() },
            fragment: Some(wgpu::FragmentState {
                module: &self.module,
                entry_point: Some(shading.entry_point()),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(COLOR_FORMAT.into())],
            }),
            multiview_mask: None,
            cache: None,
        })
    }

    /// Uploads camera and light; returns the number of bytes.
    pub fn upload(&self, gpu: &Gpu, uniforms: &FrameUniforms) -> u64 {
        gpu.queue.write_buffer(&self.uniforms, 0, bytemuck::bytes_of(uniforms));
        self.uniforms.size()
    }

    pub fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        pipeline: &wgpu::RenderPipeline,
        shadows: &Shadows,
        meshes: &SceneMeshes,
    ) {
        pass.set_pipeline(pipeline);
        pass.set_bind_group(FRAME_GROUP, &self.frame_bind_group, &[]);
        pass.set_bind_group(VISIBILITY_GROUP, shadows.visibility_bind_group(), &[]);
        meshes.draw(pass, SURFACE_GROUP);
    }
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
