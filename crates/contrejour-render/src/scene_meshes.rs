//! The scene's meshes on the device, for the picture.

use std::collections::HashMap;
use std::mem::size_of;
use std::sync::Arc;

use contrejour_mesh::TriangleMesh;
use contrejour_scene::{Scene, SceneMesh};
use glam::{DMat3, DMat4, DVec3};

use crate::{Gpu, LocalSpace};

/// Vertex and index buffers, and where each mesh of the scene stands.
#[derive(Debug)]
pub(crate) struct SceneMeshes {
    buffers: Vec<MeshBuffers>,
    /// For each visible mesh of the scene, its buffers.
    draws: Vec<usize>,
    surfaces: wgpu::BindGroup,
    surface_stride: u32,
}

#[derive(Debug)]
struct MeshBuffers {
    vertices: wgpu::Buffer,
    indices: wgpu::Buffer,
    index_count: u32,
    /// The mesh's object space from the space of its vertex buffer.
    object_from_vertex: DMat4,
}

#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct ShadeVertex {
    position: [f32; 3],
    normal: [f32; 3],
    color: [f32; 3],
}

/// `Surface` in `shaders/shared/surface.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct Surface {
    local_from_vertex: [f32; 16],
    local_normal_from_object: [[f32; 4]; 3],
    base_color: [f32; 4],
    receives_shadow: u32,
    first_face: u32,
    padding: [u32; 2],
}

/// The vertex buffer, as the shader sees it.
pub(crate) const VERTEX_LAYOUT: wgpu::VertexBufferLayout<'static> = wgpu::VertexBufferLayout {
    array_stride: size_of::<ShadeVertex>() as u64,
    step_mode: wgpu::VertexStepMode::Vertex,
    attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x3],
};

/// A mesh has more triangles or vertices than the device's buffers hold.
#[derive(Debug, thiserror::Error)]
#[error(
    "mesh {name:?} needs a buffer of {bytes} bytes and the graphics device allows {limit}; split or simplify the mesh"
)]
pub struct MeshTooLarge {
    /// Name of the mesh in the scene.
    pub name: String,
    /// Bytes of its largest buffer.
    pub bytes: u64,
    /// Bytes that a buffer may have.
    pub limit: u64,
}

/// The layout of a surface's bind group.
pub(crate) fn surface_layout(device: &wgpu::Device) -> wgpu::BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("surface"),
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: true,
                min_binding_size: wgpu::BufferSize::new(size_of::<Surface>() as u64),
            },
            count: None,
        }],
    })
}

impl SceneMeshes {
    /// Uploads each mesh once, however often it stands in the scene.
    pub fn new(
        gpu: &Gpu,
        scene: &Scene,
        local: &LocalSpace,
        layout: &wgpu::BindGroupLayout,
    ) -> Result<Self, MeshTooLarge> {
        let mut buffers = Vec::new();
        let mut buffers_of_mesh = HashMap::new();
        let mut draws = Vec::new();
        let mut surface_bytes = Vec::new();
        let mut first_face = 0u32;
        let alignment = gpu.device.limits().min_uniform_buffer_offset_alignment as usize;
        let surface_stride = size_of::<Surface>().next_multiple_of(alignment);
        for placed in scene.meshes.iter().filter(|placed| !placed.mesh.triangles.is_empty()) {
            let index = match buffers_of_mesh.get(&Arc::as_ptr(&placed.mesh)) {
                Some(&index) => index,
                None => {
                    buffers.push(MeshBuffers::new(gpu, &placed.mesh, &placed.name)?);
                    buffers_of_mesh.insert(Arc::as_ptr(&placed.mesh), buffers.len() - 1);
                    buffers.len() - 1
                }
            };
            let surface = Surface::new(placed, local, &buffers[index].object_from_vertex, first_face);
            // Whoever asks for face ids checks beforehand that they fit.
            first_face = first_face.saturating_add(placed.mesh.triangles.len() as u32);
            surface_bytes.extend_from_slice(bytemuck::bytes_of(&surface));
            surface_bytes.resize(surface_bytes.len().next_multiple_of(surface_stride), 0);
            draws.push(index);
        }

        // A buffer must not be empty, also where nothing is drawn.
        surface_bytes.resize(surface_bytes.len().max(surface_stride), 0);
        let surface_buffer = gpu.upload("surfaces", &surface_bytes, wgpu::BufferUsages::UNIFORM);
        let surfaces = gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("surfaces"),
            layout,
            entries: &[wgpu::BindGroupEntry {
                binding: 0,
                resource: wgpu::BindingResource::Buffer(wgpu::BufferBinding {
                    buffer: &surface_buffer,
                    offset: 0,
                    size: wgpu::BufferSize::new(size_of::<Surface>() as u64),
                }),
            }],
        });
        Ok(Self { buffers, draws, surfaces, surface_stride: surface_stride as u32 })
    }

    /// Draws everything; the surfaces go to bind group `surface_group`.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, surface_group: u32) {
        for (surface, &index) in (0u32..).zip(&self.draws) {
            let buffers = &self.buffers[index];
            pass.set_bind_group(surface_group, &self.surfaces, &[surface * self.surface_stride]);
            pass.set_vertex_buffer(0, buffers.vertices.slice(..));
            pass.set_index_buffer(buffers.indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed(0..buffers.index_count, 0, 0..1);
        }
    }
}

impl MeshBuffers {
    fn new(gpu: &Gpu, mesh: &TriangleMesh, name: &str) -> Result<Self, MeshTooLarge> {
        let vertex_bytes = (mesh.positions.len() * size_of::<ShadeVertex>()) as u64;
        let bytes = vertex_bytes.max((mesh.triangles.len() * size_of::<[u32; 3]>()) as u64);
        let limit = gpu.device.limits().max_buffer_size;
        if bytes > limit {
            return Err(MeshTooLarge { name: name.into(), bytes, limit });
        }

        let (center, object_per_vertex) = extent(mesh);
        let vertices: Vec<ShadeVertex> = (mesh.positions.iter().zip(&mesh.normals).zip(&mesh.colors))
            .map(|((&position, &normal), &color)| {
                let position = (DVec3::from(position.map(f64::from)) - center) / object_per_vertex;
                ShadeVertex { position: position.as_vec3().to_array(), normal, color }
            })
            .collect();
        Ok(Self {
            vertices: gpu.upload("vertices", bytemuck::cast_slice(&vertices), wgpu::BufferUsages::VERTEX),
            indices: gpu.upload("indices", bytemuck::cast_slice(&mesh.triangles), wgpu::BufferUsages::INDEX),
            index_count: 3 * mesh.triangles.len() as u32,
            object_from_vertex: DMat4::from_translation(center) * DMat4::from_scale(DVec3::splat(object_per_vertex)),
        })
    }
}

/// Middle of a mesh and the power of two next above its half size, so that its vertices lie in -1..1 and lose nothing
/// to the object's place.
fn extent(mesh: &TriangleMesh) -> (DVec3, f64) {
    let corners = || {
        mesh.triangles.as_flattened().iter().map(|&vertex| DVec3::from(mesh.positions[vertex as usize].map(f64::from)))
    };
    let low = corners().fold(DVec3::INFINITY, DVec3::min);
    let high = corners().fold(DVec3::NEG_INFINITY, DVec3::max);
    let half_size = 0.5 * (high - low).max_element();
    let object_per_vertex = if half_size > 0.0 { half_size.log2().ceil().exp2() } else { 1.0 };
    (0.5 * (low + high), object_per_vertex)
}

impl Surface {
    fn new(placed: &SceneMesh, local: &LocalSpace, object_from_vertex: &DMat4, first_face: u32) -> Self {
        let local_from_vertex = local.local_from_world() * placed.world_from_object * object_from_vertex;
        let normal_matrix = normal_matrix(DMat3::from_mat4(placed.world_from_object)).as_mat3();
        let column = |axis: glam::Vec3| axis.extend(0.0).to_array();
        let (base_color, replaces) = match placed.material.base_color {
            Some(color) => (color, 1.0),
            None => ([0.0; 3], 0.0),
        };
        Self {
            local_from_vertex: local_from_vertex.as_mat4().to_cols_array(),
            local_normal_from_object: [normal_matrix.x_axis, normal_matrix.y_axis, normal_matrix.z_axis].map(column),
            base_color: [base_color[0], base_color[1], base_color[2], replaces],
            receives_shadow: u32::from(placed.receives),
            first_face,
            padding: [0; 2],
        }
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

    #[test]
    fn vertices_far_from_the_origin_keep_their_shape() {
        let far = 2f32.powi(20);
        let mesh = TriangleMesh {
            positions: vec![[far, 0.0, 0.0], [far + 0.25, 0.0, 0.0], [far, 0.125, 0.0], [0.0; 3]],
            triangles: vec![[0, 1, 2]],
            ..TriangleMesh::default()
        };
        assert_eq!(extent(&mesh), (DVec3::new(f64::from(far) + 0.125, 0.0625, 0.0), 0.125));
    }
}
