//! What the picture's shader needs of a mesh beside its vertices.

use std::mem::size_of;

use contrejour_scene::SceneMesh;
use glam::{DMat3, DMat4};

use crate::LocalSpace;

/// `Surface` in `shaders/shared/surface.wgsl`, which says what the fields mean.
#[repr(C)]
#[derive(Clone, Copy, Debug, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct Surface {
    local_from_vertex: [f32; 16],
    local_normal_from_object: [[f32; 4]; 3],
    base_color: [f32; 4],
    receives_shadow: u32,
    first_face: u32,
    padding: [u32; 2],
}

/// The layout of a surface's bind group.
pub(crate) fn surface_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("surface"),
        entries: &[
            wgpu::BindGroupLayoutEntry {
                binding: 0,
                visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
                ty: wgpu::BindingType::Buffer {
                    ty: wgpu::BufferBindingType::Uniform,
                    has_dynamic_offset: true,
                    min_binding_size: wgpu::BufferSize::new(size_of::<Surface>() as u64),
                },
                count: None,
            },
            wgpu::BindGroupLayoutEntry {
                binding: 1,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty: wgpu::BindingType::Texture {
                    sample_type: wgpu::TextureSampleType::Float { filterable: true },
                    view_dimension: wgpu::TextureViewDimension::D2,
                    multisampled: false,
                },
                count: None,
            },
            wgpu::BindGroupLayoutEntry {
                binding: 2,
                visibility: wgpu::ShaderStages::FRAGMENT,
                ty: wgpu::BindingType::Sampler(wgpu::SamplerBindingType::Filtering),
                count: None,
            },
        ],
    })
}

impl Surface {
    pub fn new(placed: &SceneMesh, local: &LocalSpace, object_from_vertex: &DMat4, first_face: u32) -> Self {
        let (base_color, replaces) = match placed.material.base_color {
            Some(color) => (color, 1.0),
            None => ([0.0; 3], 0.0),
        };
        let mut surface = Self {
            local_from_vertex: [0.0; 16],
            local_normal_from_object: [[0.0; 4]; 3],
            base_color: [base_color[0], base_color[1], base_color[2], replaces],
            receives_shadow: u32::from(placed.receives),
            first_face,
            padding: [0; 2],
        };
        surface.place(local, &placed.world_from_object, object_from_vertex);
        surface
    }

    /// Moves the mesh.
    pub fn place(&mut self, local: &LocalSpace, world_from_object: &DMat4, object_from_vertex: &DMat4) {
        let local_from_vertex = local.local_from_world() * world_from_object * object_from_vertex;
        let normal_matrix = normal_matrix(DMat3::from_mat4(*world_from_object)).as_mat3();
        let column = |axis: glam::Vec3| axis.extend(0.0).to_array();
        self.local_from_vertex = local_from_vertex.as_mat4().to_cols_array();
        self.local_normal_from_object = [normal_matrix.x_axis, normal_matrix.y_axis, normal_matrix.z_axis].map(column);
    }
}

/// Turns normals as `matrix` turns planes, up to length and sign; works where `matrix` has no inverse.
fn normal_matrix(matrix: DMat3) -> DMat3 {
    // The cofactors are the inverse transpose times the determinant.
    let unit = matrix * matrix.to_cols_array().iter().fold(0.0, |largest: f64, value| largest.max(value.abs())).recip();
    if !unit.is_finite() {
        return DMat3::ZERO;
    }
    DMat3::from_cols(unit.y_axis.cross(unit.z_axis), unit.z_axis.cross(unit.x_axis), unit.x_axis.cross(unit.y_axis))
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    #[test]
    fn normals_stay_across_their_planes() {
        for scale in [1e-30, 1.0, 1e30] {
            let matrix = scale * DMat3::from_cols(DVec3::new(2.0, 0.1, 0.0), DVec3::new(0.3, -5.0, 1.0), DVec3::Z);
            let normal = normal_matrix(matrix) * DVec3::new(1.0, 1.0, 0.0);
            for tangent in [DVec3::new(1.0, -1.0, 0.0), DVec3::Z] {
                let cosine = normal.normalize().dot((matrix * tangent).normalize());
                assert!(cosine.abs() < 1e-12, "{cosine}");
            }
        }
    }

    #[test]
    fn a_flattening_matrix_still_has_a_normal() {
        let flat = DMat3::from_diagonal(DVec3::new(1.0, 0.0, 1.0));
        assert_eq!(normal_matrix(flat) * DVec3::new(0.3, 1.0, 0.2), DVec3::Y);
        assert_eq!(normal_matrix(DMat3::ZERO), DMat3::ZERO);
    }
}
