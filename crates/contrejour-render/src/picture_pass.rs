//! The pass that makes a picture of what was added up.

use std::collections::HashMap;

use wgpu::{TextureFormat, TextureSampleType};

use crate::Gpu;
use crate::full_screen::full_screen_pipeline;
use crate::light_targets::LightTargets;
use crate::scene_pipeline::EntryPoints;
use crate::shaders::PICTURE;

/// Pipelines, one for each format of a picture, and what they bind.
#[derive(Debug)]
pub(crate) struct PicturePass {
    module: wgpu::ShaderModule,
    layout: wgpu::BindGroupLayout,
    pipeline_layout: wgpu::PipelineLayout,
    bind_group: wgpu::BindGroup,
    entry_point: &'static str,
    pipelines: HashMap<TextureFormat, wgpu::RenderPipeline>,
}

impl PicturePass {
    pub fn new(gpu: &Gpu, targets: &LightTargets) -> Self {
        let has_samples = gpu.sample_count > 1;
        let entry_point = if has_samples { "fragment_picture_of_samples" } else { "fragment_picture" };
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("picture"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty: wgpu::BindingType::Texture {
                    sample_type: TextureSampleType::Float { filterable: false },
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: has_samples,
                },
                count: None,
            }],
        });
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("picture"),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("picture"),
            source: wgpu::ShaderSource::Wgsl(PICTURE.into()),
        });
        let bind_group = bind(gpu, &layout, targets);
        Self { module, layout, pipeline_layout, bind_group, entry_point, pipelines: HashMap::new() }
    }

    /// Reads other targets from now on.
    pub fn bind_again(&mut self, gpu: &Gpu, targets: &LightTargets) {
        self.bind_group = bind(gpu, &self.layout, targets);
    }

    /// Makes what a picture of this format needs and is not there.
    pub fn prepare(&mut self, gpu: &Gpu, format: TextureFormat) {
        let Self { module, pipeline_layout, entry_point, pipelines, .. } = self;
        pipelines.entry(format).or_insert_with(|| pipeline(gpu, (pipeline_layout, module), entry_point, format));
    }

    /// Draws into a picture of a format that was prepared, and of the targets' size.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        (view, format): (&wgpu::TextureView, TextureFormat),
        timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) {
        let Some(pipeline) = self.pipelines.get(&format) else { return };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                // Every pixel is written.
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::BLACK), store: wgpu::StoreOp::Store },
            })],
            timestamp_writes,
            ..Default::default()
        });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &self.bind_group, &[]);
        pass.draw(0..3, 0..1);
    }
}

fn bind(gpu: &Gpu, layout: &wgpu::BindGroupLayout, targets: &LightTargets) -> wgpu::BindGroup {
    gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("picture"),
        layout,
        entries: &[wgpu::BindGroupEntry {
            binding: 0,
            resource: wgpu::BindingResource::TextureView(targets.radiance()),
        }],
    })
}

fn pipeline(
    gpu: &Gpu,
    (layout, module): (&wgpu::PipelineLayout, &wgpu::ShaderModule),
    entry_point: &'static str,
    format: TextureFormat,
) -> wgpu::RenderPipeline {
    let constants = [
        ("encodes_srgb", f64::from(u8::from(takes_shown_numbers(format)))),
        ("sample_count", f64::from(gpu.sample_count)),
    ];
    let entry_points = EntryPoints { vertex: "vertex_picture", fragment: entry_point };
    full_screen_pipeline(gpu, (layout, module), entry_points, &constants, format)
}

/// Whether numbers in a texture of this format are shown as they are: neither the format makes them sRGB, nor are they
/// floats, which are linear.
fn takes_shown_numbers(format: TextureFormat) -> bool {
    let is_float =
        matches!(format, TextureFormat::Rgba16Float | TextureFormat::Rgba32Float | TextureFormat::Rg11b10Ufloat);
    !format.is_srgb() && !is_float
}
