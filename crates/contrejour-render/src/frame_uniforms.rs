//! What the picture's shader needs of the camera, and of each light.

use contrejour_scene::{Camera, Scene};
use glam::{DMat4, DVec4};

use crate::Gpu;
use crate::surface_light::SurfaceLight;

/// `Frame` in `shaders/shared/surface.wgsl`, which says what the fields mean.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct FrameUniforms {
    pub eye_clip_from_local: [f32; 16],
    pub eye_local: [f32; 4],
    pub ambient: [f32; 4],
    pub light: SurfaceLight,
}

impl FrameUniforms {
    /// The scene's from a camera in local space.
    pub fn new(scene: &Scene, camera_local: &Camera) -> Self {
        let ambient = [scene.ambient[0], scene.ambient[1], scene.ambient[2], 0.0];
        Self { ambient, ..Self::default() }.seen_from(camera_local, scene.aspect())
    }

    /// The same from another camera, in local space; `aspect` is width over height.
    pub fn seen_from(&self, camera_local: &Camera, aspect: f64) -> Self {
        Self {
            eye_clip_from_local: eye_clip_from_local(camera_local, aspect).as_mat4().to_cols_array(),
            eye_local: camera_local.eye.extend(1.0).as_vec4().to_array(),
            ..*self
        }
    }
}

/// The uniforms on the device, bound: a record for each light. Camera and light are one record, since Mesa's lavapipe 22.3
/// crashes in draws of four uniform buffers, which a light's own would make.
#[derive(Debug)]
pub(crate) struct FrameBinding {
    buffer: wgpu::Buffer,
    stride: u32,
    pub layout: wgpu::BindGroupLayout,
    bind_group: wgpu::BindGroup,
    /// What [`upload`](Self::upload) left in the buffer.
    uploaded: Vec<Option<FrameUniforms>>,
}

impl FrameBinding {
    /// With room for some lights.
    pub fn new(gpu: &Gpu, light_count: usize) -> Self {
        let alignment = gpu.device.limits().min_uniform_buffer_offset_alignment as usize;
        let stride = size_of::<FrameUniforms>().next_multiple_of(alignment) as u32;
        // Without a light there still is a camera.
        let record_count = light_count.max(1);
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("frame"),
            size: record_count as u64 * u64::from(stride),
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let record_size = wgpu::BufferSize::new(size_of::<FrameUniforms>() as u64);
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("frame"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: true,
                    min_binding_size: record_size,
                },
                count: None,
            }],
        });
        let record = wgpu::BufferBinding { buffer: &buffer, offset: 0, size: record_size };
        let bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("frame"),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::Buffer(record) }],
        });
        Self { buffer, stride, layout, bind_group, uploaded: vec![None; record_count] }
    }

    /// Uploads what changed of camera and lights; returns the number of bytes.
    pub fn upload(&mut self, gpu: &Gpu, uniforms: &FrameUniforms, lights: &[SurfaceLight]) -> u64 {
        let mut bytes = 0;
        for index in 0..self.uploaded.len() {
            let light = lights.get(index).copied().unwrap_or_default();
            let record = FrameUniforms { light, ..*uniforms };
            if self.uploaded[index].replace(record) != Some(record) {
                bytes += self.write(gpu, index, &record);
            }
        }
        bytes
    }

    /// Uploads a record, whatever was there; returns the number of bytes.
    pub fn write(&self, gpu: &Gpu, index: usize, record: &FrameUniforms) -> u64 {
        gpu.queue.write_buffer(&self.buffer, index as u64 * u64::from(self.stride), bytemuck::bytes_of(record));
        size_of::<FrameUniforms>() as u64
    }

    /// Binds the camera with one of the lights.
    pub fn bind(&self, pass: &mut wgpu::RenderPass<'_>, group: u32, light: usize) {
        pass.set_bind_group(group, &self.bind_group, &[light as u32 * self.stride]);
    }
}

/// Clip space with reversed depth, 1 at the near plane and 0 at the far one: `f32` is densest where distances are
/// largest.
fn eye_clip_from_local(camera_local: &Camera, aspect: f64) -> DMat4 {
    let reversed_from_clip = DMat4::from_cols(DVec4::X, DVec4::Y, -DVec4::Z, DVec4::new(0.0, 0.0, 1.0, 1.0));
    reversed_from_clip * camera_local.clip_from_world(aspect)
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;

    #[test]
    fn depth_is_reversed() {
        let camera = Camera { eye: DVec3::ZERO, target: -DVec3::Z, up: DVec3::Y, fov_y: 1.0, near: 0.5, far: 8.0 };
        let clip_from_local = eye_clip_from_local(&camera, 1.5);
        let depth = |distance: f64| clip_from_local.project_point3(DVec3::new(0.0, 0.0, -distance)).z;
        assert!((depth(0.5) - 1.0).abs() < 1e-12);
        assert!(depth(8.0).abs() < 1e-12);
        assert!(depth(1.0) > depth(2.0));
    }
}
