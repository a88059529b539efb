//! The textures in which the light of a picture is added up.

use crate::Gpu;
use crate::targets::{DEPTH_FORMAT, RADIANCE_FORMAT, passing_depth, target_texture};

/// Alpha where no mesh is; as the shader of pictures has it.
const BACKGROUND_ALPHA: f64 = 0.5;

/// Radiance and depth, with as many samples a pixel as pictures have.
#[derive(Debug)]
pub(crate) struct LightTargets {
    pub size: [u32; 2],
    radiance_view: wgpu::TextureView,
    depth_view: wgpu::TextureView,
}

impl LightTargets {
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        let view = |label, format, usage| {
            let texture = target_texture(gpu, label, size, gpu.sample_count, format, usage);
            texture.create_view(&wgpu::TextureViewDescriptor::default())
        };
        Self {
            size,
            radiance_view: view("radiance", RADIANCE_FORMAT, wgpu::TextureUsages::TEXTURE_BINDING),
            depth_view: view("picture depth", DEPTH_FORMAT, wgpu::TextureUsages::empty()),
        }
    }

    /// The light, for the pass that makes a picture of it.
    pub fn radiance(&self) -> &wgpu::TextureView {
        &self.radiance_view
    }

    /// Begins a pass that clears them; the background is a linear colour of the picture.
    pub fn begin_pass<'encoder>(
        &self,
        encoder: &'encoder mut wgpu::CommandEncoder,
        background: wgpu::Color,
        timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) -> wgpu::RenderPass<'encoder> {
        let background = wgpu::Color { a: BACKGROUND_ALPHA, ..background };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("light"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &self.radiance_view,
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(background), store: wgpu::StoreOp::Store },
            })],
            depth_stencil_attachment: Some(passing_depth(&self.depth_view)),
            timestamp_writes,
            ..Default::default()
        })
    }
}
