//! Texels of a map on the CPU.

use contrejour_gpu::{LightHandle, Shadows};

use crate::gpu::Gpu;

/// All channels of a texture of 32-bit floats, row by row, layer after layer.
pub fn read_floats(gpu: &Gpu, texture: &wgpu::Texture) -> Vec<f32> {
    bytemuck::pod_collect_to_vec(&read_bytes(gpu, texture, wgpu::TextureAspect::All))
}

/// A depth buffer of 32-bit floats, row by row, layer after layer.
pub fn read_depth(gpu: &Gpu, texture: &wgpu::Texture) -> Vec<f32> {
    bytemuck::pod_collect_to_vec(&read_bytes(gpu, texture, wgpu::TextureAspect::DepthOnly))
}

/// All channels of a texture of 16-bit floats, row by row, layer after layer.
pub fn read_half_floats(gpu: &Gpu, texture: &wgpu::Texture) -> Vec<f32> {
    let bytes = read_bytes(gpu, texture, wgpu::TextureAspect::All);
    bytes.chunks_exact(2).map(|half| float_of_half(u16::from_le_bytes([half[0], half[1]]))).collect()
}

/// The bytes of a map, layer by layer and row by row.
pub fn read_layers(gpu: &Gpu, texture: &wgpu::Texture) -> Vec<u8> {
    let has_depth = texture.format().has_depth_aspect();
    read_bytes(gpu, texture, if has_depth { wgpu::TextureAspect::DepthOnly } else { wgpu::TextureAspect::All })
}

/// All texels of all maps of a light that receivers look up.
///
/// # Errors
///
/// The light was not prepared, or has no maps.
pub fn read_maps(gpu: &Gpu, shadows: &Shadows, light: LightHandle) -> Result<Vec<u8>, String> {
    let plan = shadows.plan(light).ok_or("the light was prepared")?;
    let maps = shadows.maps(light);
    let mut bytes = Vec::new();
    for kind in plan.visibility.ok_or("the light has maps")?.textures() {
        bytes.extend(read_layers(gpu, maps.of(*kind).ok_or("a listed map is there")?));
    }
    if bytes.is_empty() { Err("the light has no texel".into()) } else { Ok(bytes) }
}

fn read_bytes(gpu: &Gpu, texture: &wgpu::Texture, aspect: wgpu::TextureAspect) -> Vec<u8> {
    let bytes_per_texel = texture.format().block_copy_size(Some(aspect)).expect("the maps are plain textures");
    let row = texture.width() * bytes_per_texel;
    let padded_row = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    let readable = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("read back a texture"),
        size: u64::from(padded_row) * u64::from(texture.height()) * u64::from(texture.depth_or_array_layers()),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    encoder.copy_texture_to_buffer(
        wgpu::TexelCopyTextureInfo { texture, mip_level: 0, origin: wgpu::Origin3d::ZERO, aspect },
        wgpu::TexelCopyBufferInfo {
            buffer: &readable,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(padded_row),
                rows_per_image: Some(texture.height()),
            },
        },
        texture.size(),
    );
    gpu.queue.submit([encoder.finish()]);
    gpu.map(&readable).chunks(padded_row as usize).flat_map(|padded| &padded[..row as usize]).copied().collect()
}

/// IEEE 754 binary16.
fn float_of_half(half: u16) -> f32 {
    let sign = if half >> 15 == 1 { -1.0 } else { 1.0 };
    let fraction = f32::from(half & 0x3ff);
    match i32::from(half >> 10 & 0x1f) {
        0 => sign * fraction * 2.0_f32.powi(-24),
        31 if fraction == 0.0 => sign * f32::INFINITY,
        31 => f32::NAN,
        exponent => sign * (1.0 + fraction / 1024.0) * 2.0_f32.powi(exponent - 15),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halves_become_floats() {
        let floats = [0x0000, 0x3c00, 0xc000, 0x3555, 0x0001, 0x7bff, 0xfc00].map(float_of_half);
        assert_eq!(floats, [0.0, 1.0, -2.0, 0.333_251_95, 5.960_464_5e-8, 65504.0, f32::NEG_INFINITY]);
        assert!(float_of_half(0x7e00).is_nan());
    }
}
