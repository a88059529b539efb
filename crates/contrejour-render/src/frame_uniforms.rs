//! What the picture's shader needs of camera and light.

use contrejour_plan::{Light, LightKind};
use contrejour_scene::{Camera, Scene};
use glam::{DMat4, DVec3, DVec4};

use crate::Gpu;

/// `Frame` in `shaders/shared/surface.wgsl`, which says what the fields mean.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct FrameUniforms {
    pub eye_clip_from_local: [f32; 16],
    pub eye_local: [f32; 4],
    pub light_local: [f32; 4],
    pub light_axis_local: [f32; 4],
    pub light_color: [f32; 4],
    pub ambient: [f32; 4],
}

/// Stands for "no cone": below every cosine.
const NO_CONE: f64 = -2.0;

impl FrameUniforms {
    /// Everything but the light; the camera is in local space.
    ///
    /// # Exposure
    ///
    /// A white surface at a spot's target that faces the spot has the radiance `Light::color`, so has one that faces a point
    /// light at half its farthest depth, and one that faces a directional light has it anywhere; 1 is white in a picture.
    /// So a scene is equally bright at any size.
    pub fn new(scene: &Scene, camera_local: &Camera) -> Self {
        Self {
            eye_clip_from_local: eye_clip_from_local(camera_local, scene.aspect()).as_mat4().to_cols_array(),
            eye_local: extended(camera_local.eye, 1.0),
            ambient: [scene.ambient[0], scene.ambient[1], scene.ambient[2], 0.0],
            ..Self::default()
        }
    }

    /// The same with another light, in local space.
    pub fn with_light(&self, light_local: &Light) -> Self {
        let [red, green, blue] = light_local.color;
        match light_local.kind {
            LightKind::Spot { position, target, cone_angle, .. } => Self {
                light_local: extended(position, 1.0),
                light_axis_local: extended((target - position).normalize_or_zero(), (0.5 * cone_angle).cos()),
                light_color: [red, green, blue, position.distance_squared(target) as f32],
                ..*self
            },
            LightKind::Point { position, far, .. } => Self {
                light_local: extended(position, 1.0),
                light_axis_local: extended(DVec3::NEG_Y, NO_CONE),
                light_color: [red, green, blue, (0.5 * far).powi(2) as f32],
                ..*self
            },
            LightKind::Directional { towards_light, .. } | LightKind::Cascaded { towards_light, .. } => {
                let towards_light = unit(towards_light);
                Self {
                    light_local: extended(towards_light, 0.0),
                    light_axis_local: extended(-towards_light, NO_CONE),
                    light_color: [red, green, blue, 0.0],
                    ..*self
                }
            }
        }
    }
}

/// The uniforms on the device, bound.
#[derive(Debug)]
pub(crate) struct FrameBinding {
    buffer: wgpu::Buffer,
    pub layout: wgpu::BindGroupLayout,
    pub bind_group: wgpu::BindGroup,
}

impl FrameBinding {
    pub fn new(gpu: &Gpu) -> Self {
        let buffer = gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("frame"),
            size: size_of::<FrameUniforms>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: Some("frame"),
            entries: &[wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            }],
        });
        let bind_group = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("frame"),
            layout: &layout,
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: buffer.as_entire_binding() }],
        });
        Self { buffer, layout, bind_group }
    }

    /// Uploads camera and light; returns the number of bytes.
    pub fn upload(&self, gpu: &Gpu, uniforms: &FrameUniforms) -> u64 {
        gpu.queue.write_buffer(&self.buffer, 0, bytemuck::bytes_of(uniforms));
        self.buffer.size()
    }
}

/// Clip space with reversed depth, 1 at the near plane and 0 at the far one: `f32` is densest where distances are
/// largest.
fn eye_clip_from_local(camera_local: &Camera, aspect: f64) -> DMat4 {
    let reversed_from_clip = DMat4::from_cols(DVec4::X, DVec4::Y, -DVec4::Z, DVec4::new(0.0, 0.0, 1.0, 1.0));
    reversed_from_clip * camera_local.clip_from_world(aspect)
}

/// A direction of any length as a unit vector; its length may not fit a square.
fn unit(direction: DVec3) -> DVec3 {
    (direction / direction.abs().max_element()).normalize_or_zero()
}

fn extended(vector: DVec3, w: f64) -> [f32; 4] {
    vector.extend(w).as_vec4().to_array()
}

#[cfg(test)]
mod tests {
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

    #[test]
    fn a_direction_may_have_any_length() {
        assert!(unit(DVec3::new(0.0, 3e-200, 4e-200)).abs_diff_eq(DVec3::new(0.0, 0.6, 0.8), 1e-12));
    }
}
