//! The pass that finds the points on which shadow falls.

use glam::Vec3;

use super::receivers::{Receiver, Receivers};
use crate::Gpu;
use crate::frame_uniforms::{FrameBinding, FrameUniforms};
use crate::readback::{ReadError, read_texture};
use crate::scene_meshes::SceneMeshes;
use crate::scene_pipeline::{EntryPoints, FRAME_GROUP, ScenePipelines};
use crate::shaders::RECEIVERS;
use crate::surface::surface_layout;
use crate::targets::{DEPTH_FORMAT, passing_depth, target_texture};

/// Bits of a position, and a number that is 0 where there is no receiver.
const POINT_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Uint;

const NORMAL_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba32Float;

const BYTES_PER_TEXEL: u32 = 16;

/// The pass and its bindings; needed once a scene.
#[derive(Debug)]
pub(super) struct ReceiverPass {
    pipelines: ScenePipelines,
    surface_layout: wgpu::BindGroupLayout,
    frame: FrameBinding,
}

/// The points and normals of a picture.
#[derive(Debug)]
pub(super) struct ReceiverTarget {
    points: wgpu::Texture,
    normals: wgpu::Texture,
    /// Both, for shaders that read them.
    pub layout: wgpu::BindGroupLayout,
    pub bind_group: wgpu::BindGroup,
}

impl ReceiverPass {
    pub fn new(gpu: &Gpu, has_cuts: bool) -> Self {
        let frame = FrameBinding::new(gpu, 0);
        let surface_layout = surface_layout(&gpu.device);
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("receivers"),
            source: wgpu::ShaderSource::Wgsl(RECEIVERS.into()),
        });
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("receivers"),
            bind_group_layouts: &[Some(&frame.layout), Some(&surface_layout)],
            immediate_size: 0,
        });
        let entry_points = EntryPoints { vertex: "vertex_receivers", fragment: "fragment_receivers" };
        let how = (wgpu::CompareFunction::GreaterEqual, has_cuts);
        let formats = [POINT_FORMAT, NORMAL_FORMAT];
        let pipelines = ScenePipelines::new(gpu, (&layout, &module), entry_points, &formats, how);
        Self { pipelines, surface_layout, frame }
    }

    pub fn surface_layout(&self) -> &wgpu::BindGroupLayout {
        &self.surface_layout
    }

    /// Draws meshes whose faces share no corners.
    pub fn draw(&self, gpu: &Gpu, size: [u32; 2], meshes: &SceneMeshes, uniforms: &FrameUniforms) -> ReceiverTarget {
        self.frame.write(gpu, 0, uniforms);
        let usage = wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_SRC;
        let points = target_texture(gpu, "receiver points", size, 1, POINT_FORMAT, usage);
        let normals = target_texture(gpu, "receiver normals", size, 1, NORMAL_FORMAT, usage);
        let depth = target_texture(gpu, "receiver depth", size, 1, DEPTH_FORMAT, wgpu::TextureUsages::empty());
        let [points_view, normals_view, depth_view] = [&points, &normals, &depth].map(whole_view);

        let attachment = |view| {
            Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations {
                    load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT),
                    store: wgpu::StoreOp::Store,
                },
            })
        };
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("receivers"),
                color_attachments: &[attachment(&points_view), attachment(&normals_view)],
                depth_stencil_attachment: Some(passing_depth(&depth_view)),
                ..Default::default()
            });
            self.frame.bind(&mut pass, FRAME_GROUP, 0);
            self.pipelines.draw(&mut pass, meshes);
        }
        gpu.queue.submit([encoder.finish()]);

        let layout = target_layout(gpu);
        let bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("receivers"),
            layout: &layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(&points_view) },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(&normals_view) },
            ],
        });
        ReceiverTarget { points, normals, layout, bind_group }
    }
}

impl ReceiverTarget {
    pub fn size(&self) -> [u32; 2] {
        [self.points.width(), self.points.height()]
    }

    pub fn read(&self, gpu: &Gpu, first_faces: &[u32]) -> Result<Receivers, ReadError> {
        let points: Vec<[u32; 4]> = bytemuck::pod_collect_to_vec(&read_texture(gpu, &self.points, BYTES_PER_TEXEL)?);
        let normals: Vec<[f32; 4]> = bytemuck::pod_collect_to_vec(&read_texture(gpu, &self.normals, BYTES_PER_TEXEL)?);
        let receiver = |([x, y, z, number], [across, up, out, _]): ([u32; 4], [f32; 4])| {
            let face_id = number.checked_sub(1)?;
            let position = Vec3::from([x, y, z].map(f32::from_bits));
            Some(Receiver { position, normal: Vec3::new(across, up, out), face_id })
        };
        let points = points.into_iter().zip(normals).map(receiver).collect();
        Ok(Receivers { size: self.size(), points, first_faces: first_faces.to_vec() })
    }
}

fn target_layout(gpu: &Gpu) -> wgpu::BindGroupLayout {
    let entry = |binding, sample_type| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: wgpu::BindingType::Texture {
            sample_type,
            view_dimension: wgpu::TextureViewDimension::D2,
            multisampled: false,
        },
        count: None,
    };
    gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("receivers"),
        entries: &[
            entry(0, wgpu::TextureSampleType::Uint),
            entry(1, wgpu::TextureSampleType::Float { filterable: false }),
        ],
    })
}

fn whole_view(texture: &wgpu::Texture) -> wgpu::TextureView {
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}
