//! The textures that pictures are drawn into.

use crate::Gpu;

/// Format of pictures.
pub(crate) const COLOR_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

/// Format in which light is added up before it becomes a picture.
pub(crate) const RADIANCE_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba16Float;

/// Format of the depth buffer; depth is reversed: 1 at the near plane, 0 where nothing was drawn.
pub(crate) const DEPTH_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Depth32Float;

/// Colour, its samples and depth, for what is drawn as it is shown.
#[derive(Debug)]
pub(crate) struct Targets {
    /// The resolved picture.
    pub picture: wgpu::Texture,
    picture_view: wgpu::TextureView,
    /// Present where a pixel has several samples.
    samples_view: Option<wgpu::TextureView>,
    depth_view: wgpu::TextureView,
}

/// A picture is larger than the device's textures, or has no pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "a picture of {width}x{height} cannot be made, the graphics device allows 1 to {limit} pixels a side; choose another size"
)]
pub struct SizeTooLarge {
    /// Width in pixels.
    pub width: u32,
    /// Height in pixels.
    pub height: u32,
    /// Most pixels a side.
    pub limit: u32,
}

/// Checks that the device can hold a picture.
pub(crate) fn check_size(gpu: &Gpu, [width, height]: [u32; 2]) -> Result<(), SizeTooLarge> {
    let limit = gpu.device.limits().max_texture_dimension_2d;
    if width.max(height) > limit || width.min(height) == 0 {
        Err(SizeTooLarge { width, height, limit })
    } else {
        Ok(())
    }
}

/// A texture of one level that passes draw into.
pub(crate) fn target_texture(
    gpu: &Gpu,
    label: &str,
    size: [u32; 2],
    sample_count: u32,
    format: wgpu::TextureFormat,
    other_usage: wgpu::TextureUsages,
) -> wgpu::Texture {
    gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some(label),
        size: wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | other_usage,
        view_formats: &[],
    })
}

/// A depth buffer that is cleared to the farthest and forgotten after its pass.
pub(crate) fn passing_depth(view: &wgpu::TextureView) -> wgpu::RenderPassDepthStencilAttachment<'_> {
    wgpu::RenderPassDepthStencilAttachment {
        view,
        depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
        stencil_ops: None,
    }
}

impl Targets {
    pub fn new(gpu: &Gpu, size: [u32; 2]) -> Self {
        Self::of_format(gpu, size, COLOR_FORMAT)
    }

    /// Of another format than pictures.
    pub fn of_format(gpu: &Gpu, size: [u32; 2], format: wgpu::TextureFormat) -> Self {
        let texture =
            |label, format, sample_count, usage| target_texture(gpu, label, size, sample_count, format, usage);
        let view = |texture: &wgpu::Texture| texture.create_view(&wgpu::TextureViewDescriptor::default());
        let none = wgpu::TextureUsages::empty();
        let picture = texture("picture", format, 1, wgpu::TextureUsages::COPY_SRC);
        let samples = (gpu.sample_count > 1).then(|| texture("picture samples", format, gpu.sample_count, none));
        let depth = texture("picture depth", DEPTH_FORMAT, gpu.sample_count, none);
        Self {
            picture_view: view(&picture),
            samples_view: samples.as_ref().map(view),
            depth_view: view(&depth),
            picture,
        }
    }

    /// Begins a pass that clears the picture.
    pub fn begin_pass<'encoder>(
        &self,
        encoder: &'encoder mut wgpu::CommandEncoder,
        background: wgpu::Color,
        timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) -> wgpu::RenderPass<'encoder> {
        let (view, resolve_target, store) = match &self.samples_view {
            Some(samples) => (samples, Some(&self.picture_view), wgpu::StoreOp::Discard),
            None => (&self.picture_view, None, wgpu::StoreOp::Store),
        };
        encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("picture"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view,
                depth_slice: None,
                resolve_target,
                ops: wgpu::Operations { load: wgpu::LoadOp::Clear(background), store },
            })],
            depth_stencil_attachment: Some(passing_depth(&self.depth_view)),
            timestamp_writes,
            ..Default::default()
        })
    }
}
