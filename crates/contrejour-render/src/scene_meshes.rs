//! The scene's meshes on the device, for the picture.

use std::collections::HashMap;
use std::mem::size_of;
use std::ops::Range;
use std::sync::Arc;

use contrejour_gpu::Positions;
use contrejour_mesh::{MaterialPart, PartPose, Texture, TriangleMesh};
use contrejour_scene::{Scene, SceneMesh, TextureError};
use glam::{DMat4, DVec3};

use crate::scene_textures::SceneTextures;
use crate::surface::Surface;
use crate::{Gpu, LocalSpace};

/// Vertex and index buffers, and where each mesh of the scene stands.
#[derive(Debug)]
pub(crate) struct SceneMeshes {
    buffers: Vec<MeshBuffers>,
    /// For each visible mesh of the scene, its buffers.
    draws: Vec<usize>,
    /// For each mesh of the scene, its index in `draws`, where it is visible.
    draw_of_mesh: Vec<Option<usize>>,
    /// What is in the buffer of `surfaces`, a record for each visible mesh.
    surface_records: Vec<Surface>,
    surface_buffer: wgpu::Buffer,
    /// One for each texture, and the first for none.
    surfaces: Vec<wgpu::BindGroup>,
    surface_stride: u32,
}

#[derive(Debug)]
struct MeshBuffers {
    /// Positions, and where the first one lies, in bytes.
    positions: (wgpu::Buffer, u64),
    attributes: wgpu::Buffer,
    indices: wgpu::Buffer,
    parts: Vec<DrawnPart>,
    /// The mesh's object space from the space of its vertex buffer.
    object_from_vertex: DMat4,
}

/// Which indices are drawn with which bind group of `surfaces`.
#[derive(Clone, Debug, PartialEq)]
struct DrawnPart {
    indices: Range<u32>,
    group: usize,
    is_cut: bool,
}

/// What to draw of the meshes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Parts {
    All,
    /// What no alpha cuts.
    Uncut,
    /// What alpha cuts.
    Cut,
}

/// Whether alpha cuts anything in a scene.
pub(crate) fn has_cuts(scene: &Scene) -> bool {
    scene.meshes.iter().any(|placed| placed.mesh.cut_parts().next().is_some())
}

#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct VertexAttributes {
    normal: [f32; 3],
    /// And alpha, relative to the cutoff where it cuts.
    color: [f32; 4],
    texture_coordinates: [f32; 2],
}

/// The vertex buffers, as the shader sees them: positions alone, which a compute stage may have written, then the others.
pub(crate) const VERTEX_LAYOUTS: [wgpu::VertexBufferLayout<'static>; 2] = [
    wgpu::VertexBufferLayout {
        array_stride: size_of::<[f32; 3]>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &wgpu::vertex_attr_array![0 => Float32x3],
    },
    wgpu::VertexBufferLayout {
        array_stride: size_of::<VertexAttributes>() as u64,
        step_mode: wgpu::VertexStepMode::Vertex,
        attributes: &wgpu::vertex_attr_array![1 => Float32x3, 2 => Float32x4, 3 => Float32x2],
    },
];

/// A mesh in motion.
pub(crate) struct PosedDraw<'a> {
    /// The mesh at rest, for its colours and textures.
    pub mesh: &'a TriangleMesh,
    pub pose: &'a PartPose,
    pub local: &'a LocalSpace,
    /// Where the positions of a mesh that deforms are, in object space, and its normals.
    pub deformed: Option<(Positions, Vec<[f32; 3]>)>,
}

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

/// Why the meshes of a scene are not brought to the device.
#[derive(Debug, thiserror::Error)]
pub enum UploadMeshesError {
    /// A mesh does not fit.
    #[error(transparent)]
    TooLarge(#[from] MeshTooLarge),
    /// A texture is not decoded.
    #[error(transparent)]
    Texture(#[from] TextureError),
}

impl SceneMeshes {
    /// Uploads each mesh once, however often it stands in the scene.
    pub fn new(
        gpu: &Gpu,
        scene: &Scene,
        local: &LocalSpace,
        layout: &wgpu::BindGroupLayout,
    ) -> Result<Self, UploadMeshesError> {
        let mut buffers = Vec::new();
        let mut textures = TextureList::default();
        let mut buffers_of_mesh = HashMap::new();
        let mut draws = Vec::new();
        let mut draw_of_mesh = vec![None; scene.meshes.len()];
        let mut surface_bytes = Vec::new();
        let mut surface_records = Vec::new();
        let mut first_face = 0u32;
        let alignment = gpu.device.limits().min_uniform_buffer_offset_alignment as usize;
        let surface_stride = size_of::<Surface>().next_multiple_of(alignment);
        let visible = |(_, placed): &(usize, &SceneMesh)| !placed.mesh.triangles.is_empty();
        for (mesh, placed) in scene.meshes.iter().enumerate().filter(visible) {
            let index = match buffers_of_mesh.get(&Arc::as_ptr(&placed.mesh)) {
                Some(&index) => index,
                None => {
                    buffers.push(MeshBuffers::new(gpu, &placed.mesh, &placed.name, &mut textures)?);
                    buffers_of_mesh.insert(Arc::as_ptr(&placed.mesh), buffers.len() - 1);
                    buffers.len() - 1
                }
            };
            let surface = Surface::new(placed, local, &buffers[index].object_from_vertex, first_face);
            // Whoever asks for face ids checks beforehand that they fit.
            first_face = first_face.saturating_add(placed.mesh.triangles.len() as u32);
            surface_records.push(surface);
            surface_bytes.extend_from_slice(bytemuck::bytes_of(&surface));
            surface_bytes.resize(surface_bytes.len().next_multiple_of(surface_stride), 0);
            draw_of_mesh[mesh] = Some(draws.len());
            draws.push(index);
        }

        // A buffer must not be empty, also where nothing is drawn.
        surface_bytes.resize(surface_bytes.len().max(surface_stride), 0);
        let surface_buffer = gpu.upload("surfaces", &surface_bytes, wgpu::BufferUsages::UNIFORM);
        let bind = |(view, sampler): &(wgpu::TextureView, wgpu::Sampler)| {
            let surface = wgpu::BufferBinding {
                buffer: &surface_buffer,
                offset: 0,
                size: wgpu::BufferSize::new(size_of::<Surface>() as u64),
            };
            gpu.device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some("surfaces"),
                layout,
                entries: &[
                    wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::Buffer(surface) },
                    wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(view) },
                    wgpu::BindGroupEntry { binding: 2, resource: wgpu::BindingResource::Sampler(sampler) },
                ],
            })
        };
        let mut on_device = SceneTextures::new(gpu);
        let mut surfaces = vec![bind(&on_device.white)];
        for (texture, cutoff) in textures.textures {
            surfaces.push(bind(&on_device.get(gpu, texture, cutoff)?));
        }
        let surface_stride = surface_stride as u32;
        Ok(Self { buffers, draws, draw_of_mesh, surface_records, surface_buffer, surfaces, surface_stride })
    }

    /// Moves a visible mesh, counted from the scene's first, and returns the bytes that it uploads. Its buffers must be its
    /// own.
    pub fn pose(&mut self, gpu: &Gpu, draw: usize, posed: &PosedDraw<'_>) -> u64 {
        let mut bytes = 0;
        let buffers = &mut self.buffers[self.draws[draw]];
        if let Some((Positions::InBuffer { buffer, offset, .. }, normals)) = &posed.deformed {
            buffers.positions = (buffer.clone(), *offset);
            buffers.object_from_vertex = DMat4::IDENTITY;
            let attributes = attributes(normals, posed.mesh);
            gpu.queue.write_buffer(&buffers.attributes, 0, bytemuck::cast_slice(&attributes));
            bytes += size_of_val(&attributes[..]);
        }
        bytes += self.place_draw(gpu, draw, posed.local, &posed.pose.world_from_object);
        bytes as u64
    }

    /// Moves a mesh of the scene, and returns the bytes that it uploads.
    pub fn place(&mut self, gpu: &Gpu, mesh: usize, local: &LocalSpace, world_from_object: &DMat4) -> u64 {
        let draw = self.draw_of_mesh.get(mesh).copied().flatten();
        draw.map_or(0, |draw| self.place_draw(gpu, draw, local, world_from_object) as u64)
    }

    fn place_draw(&mut self, gpu: &Gpu, draw: usize, local: &LocalSpace, world_from_object: &DMat4) -> usize {
        let object_from_vertex = self.buffers[self.draws[draw]].object_from_vertex;
        let surface = &mut self.surface_records[draw];
        surface.place(local, world_from_object, &object_from_vertex);
        let offset = draw as u64 * u64::from(self.surface_stride);
        gpu.queue.write_buffer(&self.surface_buffer, offset, bytemuck::bytes_of(surface));
        size_of::<Surface>()
    }

    /// Whether alpha cuts anything.
    pub fn has_cuts(&self) -> bool {
        self.buffers.iter().flat_map(|buffers| &buffers.parts).any(|part| part.is_cut)
    }

    /// Draws some parts of all meshes; the surfaces go to bind group `surface_group`.
    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>, surface_group: u32, parts: Parts) {
        let is_drawn = |part: &&DrawnPart| parts == Parts::All || part.is_cut == (parts == Parts::Cut);
        for (surface, &index) in (0u32..).zip(&self.draws) {
            let buffers = &self.buffers[index];
            if !buffers.parts.iter().any(|part| is_drawn(&part)) {
                continue;
            }
            pass.set_vertex_buffer(0, buffers.positions.0.slice(buffers.positions.1..));
            pass.set_vertex_buffer(1, buffers.attributes.slice(..));
            pass.set_index_buffer(buffers.indices.slice(..), wgpu::IndexFormat::Uint32);
            for part in buffers.parts.iter().filter(is_drawn) {
                pass.set_bind_group(surface_group, &self.surfaces[part.group], &[surface * self.surface_stride]);
                pass.draw_indexed(part.indices.clone(), 0, 0..1);
            }
        }
    }
}

impl MeshBuffers {
    fn new<'a>(
        gpu: &Gpu,
        mesh: &'a TriangleMesh,
        name: &str,
        textures: &mut TextureList<'a>,
    ) -> Result<Self, MeshTooLarge> {
        let vertex_bytes = (mesh.positions.len() * size_of::<VertexAttributes>()) as u64;
        let bytes = vertex_bytes.max((mesh.triangles.len() * size_of::<[u32; 3]>()) as u64);
        let limit = gpu.device.limits().max_buffer_size;
        if bytes > limit {
            return Err(MeshTooLarge { name: name.into(), bytes, limit });
        }

        let (center, object_per_vertex) = extent(mesh);
        let near_one = |position: &[f32; 3]| {
            let position = (DVec3::from(position.map(f64::from)) - center) / object_per_vertex;
            position.as_vec3().to_array()
        };
        let positions: Vec<[f32; 3]> = mesh.positions.iter().map(near_one).collect();
        let attributes = attributes(&mesh.normals, mesh);
        let upload = |name, bytes| gpu.upload(name, bytes, wgpu::BufferUsages::VERTEX);
        Ok(Self {
            positions: (upload("positions", bytemuck::cast_slice(&positions)), 0),
            attributes: upload("vertex attributes", bytemuck::cast_slice(&attributes)),
            indices: gpu.upload("indices", bytemuck::cast_slice(&mesh.triangles), wgpu::BufferUsages::INDEX),
            parts: drawn_parts(mesh, textures),
            object_from_vertex: DMat4::from_translation(center) * DMat4::from_scale(DVec3::splat(object_per_vertex)),
        })
    }
}

/// Textures in the order in which meshes name them, each once; with the cutoff that smaller levels keep their coverage by.
#[derive(Default)]
struct TextureList<'a> {
    textures: Vec<(&'a Texture, Option<f32>)>,
    groups: HashMap<(*const Texture, Option<u32>), usize>,
}

impl<'a> TextureList<'a> {
    /// The bind group of a part's texture; the first is that of none.
    fn group(&mut self, part: &'a MaterialPart, largest_alpha: f32) -> usize {
        let Some(texture) = &part.texture else { return 0 };
        let cutoff = part.alpha_cutoff.map(|cutoff| cutoff / largest_alpha);
        *self.groups.entry((Arc::as_ptr(texture), cutoff.map(f32::to_bits))).or_insert_with(|| {
            self.textures.push((texture, cutoff));
            self.textures.len()
        })
    }
}

/// The indices of all triangles, in order, and what each range is drawn with.
fn drawn_parts<'a>(mesh: &'a TriangleMesh, textures: &mut TextureList<'a>) -> Vec<DrawnPart> {
    let largest_alpha = |part: &MaterialPart| {
        let corners = mesh.triangles_of(part).as_flattened().iter();
        corners.map(|&vertex| mesh.alpha(vertex)).fold(0.0, f32::max)
    };
    let mut parts = Vec::new();
    let mut push = |triangles: Range<u32>, group, is_cut| {
        if !triangles.is_empty() {
            parts.push(DrawnPart { indices: 3 * triangles.start..3 * triangles.end, group, is_cut });
        }
    };
    let mut next = 0;
    for part in &mesh.parts {
        push(next..part.triangles.start, 0, false);
        push(part.triangles.clone(), textures.group(part, largest_alpha(part)), part.alpha_cutoff.is_some());
        next = part.triangles.end;
    }
    push(next..mesh.triangles.len() as u32, 0, false);
    parts
}

fn attributes(normals: &[[f32; 3]], mesh: &TriangleMesh) -> Vec<VertexAttributes> {
    let coordinates = mesh.texture_coordinates.iter().copied().chain(std::iter::repeat([0.0; 2]));
    let mut alphas = vec![1.0; mesh.colors.len()];
    for (part, cutoff) in mesh.cut_parts() {
        for &vertex in mesh.triangles_of(part).as_flattened() {
            alphas[vertex as usize] = mesh.alpha(vertex) / cutoff;
        }
    }
    let attributes = normals.iter().zip(&mesh.colors).zip(alphas).zip(coordinates);
    attributes
        .map(|(((&normal, &[red, green, blue]), alpha), texture_coordinates)| VertexAttributes {
            normal,
            color: [red, green, blue, alpha],
            texture_coordinates,
        })
        .collect()
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

#[cfg(test)]
mod tests {
    use super::*;
    use contrejour_mesh::EncodedImage;

    #[test]
    fn every_index_is_drawn_once() {
        let image = EncodedImage { place: String::new(), bytes: Vec::new() };
        let texture = Texture { image: image.into(), wrap: Default::default(), filter: Default::default() };
        let textures = [Arc::new(texture.clone()), Arc::new(texture)];
        let part = |triangles, texture: usize, alpha_cutoff| {
            let texture = textures.get(texture).map(Arc::clone);
            MaterialPart { triangles, texture, alpha_cutoff }
        };
        let drawn = |parts| {
            let mesh = TriangleMesh { triangles: vec![[0; 3]; 9], alphas: vec![1.0], parts, ..TriangleMesh::default() };
            let drawn = drawn_parts(&mesh, &mut TextureList::default());
            drawn.into_iter().map(|part| (part.indices, part.group, part.is_cut)).collect::<Vec<_>>()
        };
        assert_eq!(drawn(vec![]), [(0..27, 0, false)]);
        assert_eq!(drawn(vec![part(0..9, 0, None)]), [(0..27, 1, false)]);
        let between = drawn(vec![part(1..3, 1, None), part(3..4, 0, Some(0.5)), part(6..8, 1, None)]);
        let expected = [
            (0..3, 0, false),
            (3..9, 1, false),
            (9..12, 2, true),
            (12..18, 0, false),
            (18..24, 1, false),
            (24..27, 0, false),
        ];
        assert_eq!(between, expected);
        // One texture with two cutoffs has levels for each.
        let cut = drawn(vec![part(0..3, 0, Some(0.5)), part(3..6, 0, Some(0.25)), part(6..9, 2, Some(0.5))]);
        assert_eq!(cut, [(0..9, 1, true), (9..18, 2, true), (18..27, 0, true)]);
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
