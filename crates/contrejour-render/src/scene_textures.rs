//! Textures of the scene's meshes on the device.

use std::collections::HashMap;
use std::sync::Arc;

use contrejour_mesh::{EncodedImage, Texture, TextureFilter, TextureWrap};
use contrejour_scene::{TextureError, TextureReader};
use image::{Rgba, RgbaImage};

use crate::Gpu;
use crate::texture_levels::next_level;

/// Colours are decoded before they are filtered.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

/// Views and samplers, each once however often the scene names it.
#[derive(Debug)]
pub(crate) struct SceneTextures {
    reader: TextureReader,
    images: HashMap<*const EncodedImage, wgpu::TextureView>,
    samplers: HashMap<([TextureWrap; 2], TextureFilter), wgpu::Sampler>,
    /// What stands where a surface has no texture: white.
    pub white: (wgpu::TextureView, wgpu::Sampler),
}

impl SceneTextures {
    pub fn new(gpu: &Gpu) -> Self {
        let white = RgbaImage::from_pixel(1, 1, Rgba([255; 4]));
        Self {
            reader: TextureReader::default(),
            images: HashMap::new(),
            samplers: HashMap::new(),
            white: (upload(gpu, white), gpu.device.create_sampler(&wgpu::SamplerDescriptor::default())),
        }
    }

    /// A texture's picture, decoded and uploaded where it is new, and its sampler.
    pub fn get(&mut self, gpu: &Gpu, texture: &Texture) -> Result<(wgpu::TextureView, wgpu::Sampler), TextureError> {
        let address = Arc::as_ptr(&texture.image);
        let view = match self.images.get(&address) {
            Some(view) => view.clone(),
            None => {
                let view = upload(gpu, self.reader.read(&texture.image)?);
                self.images.insert(address, view.clone());
                view
            }
        };
        let sampler = self.samplers.entry((texture.wrap, texture.filter)).or_insert_with(|| sampler(gpu, texture));
        Ok((view, sampler.clone()))
    }
}

fn upload(gpu: &Gpu, picture: RgbaImage) -> wgpu::TextureView {
    let (width, height) = picture.dimensions();
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("base colour"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: width.max(height).ilog2() + 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let mut next = Some(picture);
    for level in 0..texture.mip_level_count() {
        let Some(texels) = next else { break };
        let (width, height) = texels.dimensions();
        let target = wgpu::TexelCopyTextureInfo { mip_level: level, ..texture.as_image_copy() };
        let rows = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * width), rows_per_image: None };
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        gpu.queue.write_texture(target, &texels, rows, size);
        next = next_level(&texels);
    }
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

fn sampler(gpu: &Gpu, texture: &Texture) -> wgpu::Sampler {
    let [across, down] = texture.wrap.map(|wrap| match wrap {
        TextureWrap::Repeat => wgpu::AddressMode::Repeat,
        TextureWrap::Mirror => wgpu::AddressMode::MirrorRepeat,
        TextureWrap::Clamp => wgpu::AddressMode::ClampToEdge,
    });
    let magnified = match texture.filter {
        TextureFilter::Linear => wgpu::FilterMode::Linear,
        TextureFilter::Nearest => wgpu::FilterMode::Nearest,
    };
    gpu.device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("base colour"),
        address_mode_u: across,
        address_mode_v: down,
        mag_filter: magnified,
        min_filter: wgpu::FilterMode::Linear,
        mipmap_filter: wgpu::MipmapFilterMode::Linear,
        // Not anisotropic: lavapipe then has black texels beside the edges of triangles.
        ..Default::default()
    })
}
