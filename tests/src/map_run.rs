//! One raster pass alone on the device, over buffers and a shadow map made on the CPU.

use crate::gpu::Gpu;
use crate::stage_run::{Binding, bindings_of};
use crate::texture::read_floats;

/// A pass that fills a map of two floats a texel, by depth that its fragments write.
#[derive(Debug)]
pub struct MapRun {
    name: &'static str,
    pipeline: wgpu::RenderPipeline,
    bindings: Vec<Binding>,
    /// Of the buffers, and of the shadow map.
    layouts: [wgpu::BindGroupLayout; 2],
}

const COLOR: wgpu::TextureFormat = wgpu::TextureFormat::Rg32Float;
const DEPTH: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

impl MapRun {
    /// Builds the pipeline of two entry points of a pass's text, which may have a fault.
    ///
    /// # Panics
    ///
    /// When the WGSL is not valid.
    pub fn new(gpu: &Gpu, wgsl: &str, name: &'static str, [vertex, fragment]: [&str; 2]) -> Self {
        let bindings = bindings_of(wgsl);
        let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty,
            count: None,
        };
        let buffer = |binding: &Binding| {
            let ty = wgpu::BindingType::Buffer { ty: binding.kind, has_dynamic_offset: false, min_binding_size: None };
            entry(binding.index, ty)
        };
        let map = wgpu::BindingType::Texture {
            sample_type: wgpu::TextureSampleType::Float { filterable: false },
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        };
        // Named and not read off the entry points, since a fault may leave one unused.
        let layouts = [bindings.iter().map(buffer).collect(), vec![entry(0, map)]].map(|entries: Vec<_>| {
            let descriptor = wgpu::BindGroupLayoutDescriptor { label: Some(name), entries: &entries };
            gpu.device.create_bind_group_layout(&descriptor)
        });
        let pipeline_layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(name),
            bind_group_layouts: &layouts.each_ref().map(Some),
            immediate_size: 0,
        });
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(name),
            source: wgpu::ShaderSource::Wgsl(wgsl.into()),
        });
        let pipeline = gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(name),
            layout: Some(&pipeline_layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some(vertex),
                compilation_options: Default::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: Some(wgpu::DepthStencilState {
                format: DEPTH,
                depth_write_enabled: Some(true),
                depth_compare: Some(wgpu::CompareFunction::Less),
                stencil: wgpu::StencilState::default(),
                bias: wgpu::DepthBiasState::default(),
            }),
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some(fragment),
                compilation_options: Default::default(),
                targets: &[Some(COLOR.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        Self { name, pipeline, bindings, layouts }
    }

    /// Draws so many vertices over a map that holds `far_depth` and 0, and returns the map's floats.
    ///
    /// # Panics
    ///
    /// When `shadow_depth` is no square map.
    pub fn run<'a>(
        &self,
        gpu: &Gpu,
        bytes_of: impl Fn(&str) -> &'a [u8],
        shadow_depth: &[f32],
        far_depth: f64,
        vertices: u32,
    ) -> Vec<f32> {
        let size = shadow_depth.len().isqrt() as u32;
        assert_eq!((size * size) as usize, shadow_depth.len(), "a map is square");
        let upload = |binding: &Binding| {
            let usage = match binding.kind {
                wgpu::BufferBindingType::Uniform => wgpu::BufferUsages::UNIFORM,
                wgpu::BufferBindingType::Storage { .. } => wgpu::BufferUsages::STORAGE,
            };
            gpu.upload(&binding.name, bytes_of(&binding.name), usage)
        };
        let buffers: Vec<_> = self.bindings.iter().map(upload).collect();
        let entries: Vec<_> = (self.bindings.iter().zip(&buffers))
            .map(|(binding, buffer)| wgpu::BindGroupEntry {
                binding: binding.index,
                resource: buffer.as_entire_binding(),
            })
            .collect();
        let group = |layout, entries: &[_]| {
            let descriptor = wgpu::BindGroupDescriptor { label: Some(self.name), layout, entries };
            gpu.device.create_bind_group(&descriptor)
        };
        let shadow = texture(gpu, size, wgpu::TextureFormat::R32Float);
        gpu.queue.write_texture(
            shadow.as_image_copy(),
            bytemuck::cast_slice(shadow_depth),
            wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * size), rows_per_image: None },
            shadow.size(),
        );
        let shadow = shadow.create_view(&Default::default());
        let groups = [
            group(&self.layouts[0], &entries),
            group(
                &self.layouts[1],
                &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&shadow) }],
            ),
        ];

        let [color, depth] = [COLOR, DEPTH].map(|format| texture(gpu, size, format));
        let [color_view, depth_view] = [&color, &depth].map(|texture| texture.create_view(&Default::default()));
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let clear = wgpu::Color { r: far_depth, g: 0.0, b: 0.0, a: 0.0 };
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(self.name),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &color_view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(clear), store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &depth_view,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Discard }),
                stencil_ops: None,
            }),
            ..Default::default()
        });
        pass.set_pipeline(&self.pipeline);
        for (index, group) in (0..).zip(&groups) {
            pass.set_bind_group(index, group, &[]);
        }
        pass.draw(0..vertices, 0..1);
        drop(pass);
        gpu.queue.submit([encoder.finish()]);
        read_floats(gpu, &color)
    }
}

fn texture(gpu: &Gpu, size: u32, format: wgpu::TextureFormat) -> wgpu::Texture {
    let usage = match format {
        wgpu::TextureFormat::R32Float => wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        _ => wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
    };
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("a map"),
        size: wgpu::Extent3d { width: size, height: size, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage,
        view_formats: &[],
    })
}
