//! The pass that shades a picture from a visibility that was found before.

use super::error::ComposeError;
use super::visibility_pass::VISIBILITY_FORMAT;
use crate::Gpu;
use crate::frame_uniforms::{FrameBinding, FrameUniforms};
use crate::scene_meshes::SceneMeshes;
use crate::scene_pipeline::{EntryPoints, FRAME_GROUP, ScenePipelines};
use crate::shaders::COMPOSE;
use crate::targets::Targets;

const VISIBILITY_GROUP: u32 = 2;

/// The pass, and the texture that the visibility goes to.
#[derive(Debug)]
pub(super) struct ComposePass {
    pipelines: ScenePipelines,
    frame: FrameBinding,
    visibility: wgpu::Texture,
    visibility_bind_group: wgpu::BindGroup,
}

impl ComposePass {
    /// Draws into targets of a size and a format.
    pub fn new(
        gpu: &Gpu,
        size: [u32; 2],
        format: wgpu::TextureFormat,
        (surface_layout, has_cuts): (&wgpu::BindGroupLayout, bool),
    ) -> Self {
        let device = &gpu.device;
        let frame = FrameBinding::new(gpu, 1);
        let visibility = device.create_texture(&wgpu::TextureDescriptor {
            label: Some("given visibility"),
            size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: VISIBILITY_FORMAT,
            usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
            view_formats: &[],
        });
        let visibility_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("given visibility"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty: wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Float { filterable: false },
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
                count: None,
            }],
        });
        let view = visibility.create_view(&wgpu::TextureViewDescriptor::default());
        let visibility_bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("given visibility"),
            layout: &visibility_layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&view) }],
        });
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("compose"),
            source: wgpu::ShaderSource::Wgsl(COMPOSE.into()),
        });
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("compose"),
            bind_group_layouts: &[Some(&frame.layout), Some(surface_layout), Some(&visibility_layout)],
            immediate_size: 0,
        });
        let entry_points = EntryPoints { vertex: "vertex_shade", fragment: "fragment_compose" };
        let how = (wgpu::CompareFunction::GreaterEqual, has_cuts);
        let pipelines = ScenePipelines::new(gpu, (&layout, &module), entry_points, &[format], how);
        Self { pipelines, frame, visibility, visibility_bind_group }
    }

    /// Uploads camera, light and one visibility for each pixel.
    pub fn upload(&self, gpu: &Gpu, uniforms: &FrameUniforms, values: &[f32]) -> Result<(), ComposeError> {
        let (width, height) = (self.visibility.width(), self.visibility.height());
        if values.len() as u64 != u64::from(width) * u64::from(height) {
            return Err(ComposeError::Count { values: values.len(), width, height });
        }
        if let Some(pixel) = values.iter().position(|value| !value.is_finite()) {
            let (x, y) = (pixel as u32 % width, pixel as u32 / width);
            return Err(ComposeError::NotFinite { x, y, value: values[pixel] });
        }
        self.frame.write(gpu, 0, uniforms);
        let rows = wgpu::TexelCopyBufferLayout {
            offset: 0,
            bytes_per_row: Some(width * size_of::<f32>() as u32),
            rows_per_image: None,
        };
        gpu.queue.write_texture(
            self.visibility.as_image_copy(),
            bytemuck::cast_slice(values),
            rows,
            self.visibility.size(),
        );
        Ok(())
    }

    /// Draws the picture.
    pub fn draw(&self, gpu: &Gpu, targets: &Targets, background: wgpu::Color, meshes: &SceneMeshes) {
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = targets.begin_pass(&mut encoder, background, None);
            self.frame.bind(&mut pass, FRAME_GROUP, 0);
            pass.set_bind_group(VISIBILITY_GROUP, &self.visibility_bind_group, &[]);
            self.pipelines.draw(&mut pass, meshes);
        }
        gpu.queue.submit([encoder.finish()]);
    }
}
