//! The light's maps as numbers, whatever their format.

use half::f16;

use crate::Gpu;
use crate::readback::{ReadError, read_rows};

/// The first two channels of each texel of a layer of a map; 0 where it has one channel alone.
pub(crate) fn read_texels(gpu: &Gpu, map: &wgpu::Texture, layer: u32) -> Result<Vec<[f32; 2]>, ReadError> {
    let bytes_per_texel = map.format().block_copy_size(None).unwrap_or(4);
    let mut bytes = Vec::new();
    read_rows(gpu, map, [layer, 0], bytes_per_texel, |row| bytes.extend_from_slice(row))?;
    Ok(match map.format() {
        wgpu::TextureFormat::R16Float => pairs(&bytes, |[value]: [f16; 1]| [value.to_f32(), 0.0]),
        wgpu::TextureFormat::Rg16Float => pairs(&bytes, |texel: [f16; 2]| texel.map(f16::to_f32)),
        wgpu::TextureFormat::Rg32Float => pairs(&bytes, |texel: [f32; 2]| texel),
        // Linear or hardware depth in 32 bits.
        _ => pairs(&bytes, |[value]: [f32; 1]| [value, 0.0]),
    })
}

fn pairs<T: bytemuck::Pod>(bytes: &[u8], pair: impl Fn(T) -> [f32; 2]) -> Vec<[f32; 2]> {
    bytemuck::pod_collect_to_vec::<u8, T>(bytes).into_iter().map(pair).collect()
}
