//! Textures and buffers back on the CPU, with a wait: for pictures and tools, not for frames.

use image::RgbaImage;

use crate::gpu::{DeviceFault, Gpu};

/// Why nothing came back.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The device failed.
    #[error(transparent)]
    Device(#[from] DeviceFault),
    /// The bytes cannot be mapped.
    #[error("cannot map what the graphics device wrote; it may be out of memory: use a smaller picture")]
    Map(#[from] wgpu::BufferAsyncError),
    /// The mapped bytes cannot be read.
    #[error("cannot read what the graphics device wrote")]
    Range(#[from] wgpu::MapRangeError),
}

/// Records a copy of a buffer, to be read when the commands have run: for lists that later commands fill anew.
pub fn copied_buffer(gpu: &Gpu, encoder: &mut wgpu::CommandEncoder, part: wgpu::BufferSlice<'_>) -> wgpu::Buffer {
    let copy = gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("copied list"),
        size: part.size(),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    encoder.copy_buffer_to_buffer(part.buffer(), part.offset(), &copy, 0, part.size());
    copy
}

/// Reads the first `size` bytes of a part of a buffer.
///
/// # Errors
///
/// [`ReadError`] when the device fails.
pub fn read_buffer(gpu: &Gpu, part: wgpu::BufferSlice<'_>, size: u64) -> Result<Vec<u8>, ReadError> {
    if size == 0 {
        return Ok(Vec::new());
    }
    let staging = staging_buffer(gpu, size);
    let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
    encoder.copy_buffer_to_buffer(part.buffer(), part.offset(), &staging, 0, size);
    gpu.queue.submit([encoder.finish()]);
    read_staging(gpu, &staging)
}

/// Reads one plane of a texture: rows from the top, without padding. `bytes_per_texel` is that of its format.
///
/// # Errors
///
/// [`ReadError`] when the device fails.
pub fn read_texture(gpu: &Gpu, texture: &wgpu::Texture, bytes_per_texel: u32) -> Result<Vec<u8>, ReadError> {
    let mut bytes = Vec::new();
    read_rows(gpu, texture, [0, 0], bytes_per_texel, |row| bytes.extend_from_slice(row))?;
    Ok(bytes)
}

/// What is copied at once where a texture may be copied in parts. Unit: bytes.
const PART_MAX: u32 = 1 << 26;

/// Hands out the rows of a layer and a level of a texture one by one, as [`read_texture`] has them, so that no whole copy is held but
/// of depth.
///
/// # Errors
///
/// [`ReadError`] when the device fails.
pub fn read_rows(
    gpu: &Gpu,
    texture: &wgpu::Texture,
    [layer, mip_level]: [u32; 2],
    bytes_per_texel: u32,
    mut take: impl FnMut(&[u8]),
) -> Result<(), ReadError> {
    let [width, height] = [texture.width(), texture.height()].map(|side| (side >> mip_level).max(1));
    let row = width * bytes_per_texel;
    let padded_row = row.next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
    // WebGPU copies depth as a whole.
    let rows_at_once =
        if texture.format().has_depth_aspect() { height } else { (PART_MAX / padded_row).clamp(1, height) };
    for begin in (0..height).step_by(rows_at_once as usize) {
        let rows = rows_at_once.min(height - begin);
        let staging = staging_buffer(gpu, u64::from(padded_row) * u64::from(rows));
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        encoder.copy_texture_to_buffer(
            wgpu::TexelCopyTextureInfo {
                mip_level,
                origin: wgpu::Origin3d { x: 0, y: begin, z: layer },
                ..texture.as_image_copy()
            },
            wgpu::TexelCopyBufferInfo {
                buffer: &staging,
                layout: wgpu::TexelCopyBufferLayout {
                    offset: 0,
                    bytes_per_row: Some(padded_row),
                    rows_per_image: None,
                },
            },
            wgpu::Extent3d { width, height: rows, depth_or_array_layers: 1 },
        );
        gpu.queue.submit([encoder.finish()]);
        let padded = read_staging(gpu, &staging)?;
        padded.chunks_exact(padded_row as usize).for_each(|padded| take(&padded[..row as usize]));
    }
    Ok(())
}

/// Reads a texture of four bytes a texel as a picture.
pub(crate) fn read_picture(gpu: &Gpu, texture: &wgpu::Texture) -> Result<RgbaImage, ReadError> {
    let texels = read_texture(gpu, texture, 4)?;
    // The sizes agree by construction, so an empty picture never comes out of here.
    Ok(RgbaImage::from_raw(texture.width(), texture.height(), texels).unwrap_or_default())
}

fn staging_buffer(gpu: &Gpu, size: u64) -> wgpu::Buffer {
    gpu.device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("read back"),
        size,
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    })
}

fn read_staging(gpu: &Gpu, staging: &wgpu::Buffer) -> Result<Vec<u8>, ReadError> {
    gpu.check()?;
    let (sender, receiver) = std::sync::mpsc::channel();
    // The receiver outlives the wait below.
    staging.map_async(wgpu::MapMode::Read, .., move |result| sender.send(result).unwrap_or_default());
    gpu.wait(None)?;
    receiver.try_recv().unwrap_or(Err(wgpu::BufferAsyncError))?;
    Ok(staging.get_mapped_range(..)?.to_vec())
}
