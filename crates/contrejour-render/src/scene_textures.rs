//! Textures of the scene's meshes on the device.

use std::collections::HashMap;
use std::sync::Arc;

use contrejour_mesh::{EncodedImage, MaskLevel, Texture, TextureFilter, TextureWrap};
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
    /// By picture, and by the cutoff that its alpha is for.
    images: HashMap<(*const EncodedImage, Option<u32>), wgpu::TextureView>,
    /// And whether alpha cuts what they look up.
    samplers: HashMap<([TextureWrap; 2], TextureFilter, bool), wgpu::Sampler>,
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
            white: (upload(gpu, white, None), gpu.device.create_sampler(&wgpu::SamplerDescriptor::default())),
        }
    }

    /// A texture's picture, decoded and uploaded where it is new, and its sampler. Smaller levels keep the share of texels
    /// that a cutoff leaves.
    pub fn get(
        &mut self,
        gpu: &Gpu,
        texture: &Texture,
        cutoff: Option<f32>,
    ) -> Result<(wgpu::TextureView, wgpu::Sampler), TextureError> {
        let key = (Arc::as_ptr(&texture.image), cutoff.map(f32::to_bits));
        let view = match self.images.get(&key) {
            Some(view) => view.clone(),
            None => {
                let view = upload(gpu, self.reader.read(&texture.image)?, cutoff);
                self.images.insert(key, view.clone());
                view
            }
        };
        let sampler = self.samplers.entry((texture.wrap, texture.filter, cutoff.is_some()));
        let sampler = sampler.or_insert_with(|| new_sampler(gpu, texture, cutoff.is_some()));
        Ok((view, sampler.clone()))
    }
}

fn upload(gpu: &Gpu, picture: RgbaImage, cutoff: Option<f32>) -> wgpu::TextureView {
    let (width, height) = picture.dimensions();
    // Where alpha cuts, levels have that of the mask which casts, and end where its levels do.
    let alphas = cutoff.map(|cutoff| alpha_level(&picture).with_smaller(cutoff));
    let texture = gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("base colour"),
        size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
        mip_level_count: alphas.as_ref().map_or(width.max(height).ilog2() + 1, |levels| levels.len() as u32),
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[],
    });
    let mut alphas = alphas.unwrap_or_default().into_iter();
    let mut next = Some(picture);
    for level in 0..texture.mip_level_count() {
        let Some(mut texels) = next else { break };
        let smaller = next_level(&texels);
        if let Some(level) = alphas.next() {
            texels.pixels_mut().zip(level.alphas).for_each(|(texel, alpha)| texel.0[3] = alpha);
        }
        let (width, height) = texels.dimensions();
        let target = wgpu::TexelCopyTextureInfo { mip_level: level, ..texture.as_image_copy() };
        let rows = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * width), rows_per_image: None };
        let size = wgpu::Extent3d { width, height, depth_or_array_layers: 1 };
        gpu.queue.write_texture(target, &texels, rows, size);
        next = smaller;
    }
    texture.create_view(&wgpu::TextureViewDescriptor::default())
}

/// Alpha alone.
fn alpha_level(picture: &RgbaImage) -> MaskLevel {
    let (width, height) = picture.dimensions();
    MaskLevel { size: [width, height], alphas: picture.pixels().map(|texel| texel.0[3]).collect() }
}

fn new_sampler(gpu: &Gpu, texture: &Texture, cuts: bool) -> wgpu::Sampler {
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
        // The mean of two levels has another coverage than either.
        mipmap_filter: if cuts { wgpu::MipmapFilterMode::Nearest } else { wgpu::MipmapFilterMode::Linear },
        // Not anisotropic: lavapipe then has black texels beside the edges of triangles.
        ..Default::default()
    })
}
