//! glTF 2.0 and GLB: one mesh for each node of the scene that has one.

mod accessor;
mod buffers;
mod document;
mod nodes;
mod primitive;
mod punctual;
mod rig;
mod skin;
mod textures;

use std::path::Path;

use glam::DMat4;
use gltf::material::AlphaMode;
use gltf::{Document, Node, Primitive};

use super::{ReadFile, is_finite, read_file};
use crate::{AnimatedModel, LoadError, MaterialPart, MeshFile, MeshNode, TriangleMesh};

use accessor::Data;
use primitive::LeftOut;
use textures::{TexturedVertices, Textures};

/// Loads a glTF or GLB file from its bytes; `path` is for messages and for the buffers beside it.
///
/// Each node of the default scene that has a mesh brings one [`TriangleMesh`] of all its primitives, in depth-first
/// order; strips and fans become triangles. Vertex numbers count all vertices of all primitives in that order.
/// Colours are base colour factors times `COLOR_0`. Base colour textures come with their pictures as the file has them,
/// and with coordinates after `KHR_texture_transform`; a picture that is missing is a warning, and so are primitives
/// without the coordinates that their texture asks for, or with the `alphaMode` `BLEND`. `MASK` comes as a
/// [`MaterialPart`] with its cutoff. Cameras in perspective and the lights of `KHR_lights_punctual` stand where their nodes are at rest. Morph targets have their
/// default weights. A skinned mesh stands as its joints place it at rest, in world space, whatever its own node says
/// (glTF 2.0, 3.7.3.3).
///
/// # Errors
///
/// [`LoadError`] with node, mesh, primitive, accessor or buffer.
pub fn load_gltf(bytes: &[u8], path: &Path) -> Result<MeshFile, LoadError> {
    load(bytes, path, &read_file)
}

/// [`load_gltf`] with the buffers beside the file from `read_beside`.
pub(super) fn load(bytes: &[u8], path: &Path, read_beside: &ReadFile) -> Result<MeshFile, LoadError> {
    load_with(bytes, path, read_beside, |_, _, _| Ok(())).map(|(file, ())| file)
}

/// [`load`] with what moves the meshes.
pub(super) fn load_animated(bytes: &[u8], path: &Path, read_beside: &ReadFile) -> Result<AnimatedModel, LoadError> {
    let (file, rig) = load_with(bytes, path, read_beside, rig::read_rig)?;
    Ok(AnimatedModel { file, rig })
}

/// The meshes, and what `read_more` finds in the same document and data.
fn load_with<T>(
    bytes: &[u8],
    path: &Path,
    read_beside: &ReadFile,
    read_more: impl FnOnce(&Document, &Data, &mut MeshFile) -> Result<T, LoadError>,
) -> Result<(MeshFile, T), LoadError> {
    let parsed = document::parse(bytes, path)?;
    let document = &parsed.document;
    let buffers = buffers::read_buffers(document, parsed.binary_chunk, path, read_beside)?;
    let data = Data::new(buffers, path, bytes.len());
    let world_from_nodes = nodes::world_from_nodes(document, path)?;
    let mut loader = Loader {
        data,
        world_from_nodes,
        next_number: 0,
        primitives_left_out: 0,
        left_out: LeftOut::default(),
        blended: 0,
        textures: Textures::new(path, read_beside),
    };
    let mut file = MeshFile::default();
    let mut orthographic = 0_usize;
    for node in nodes::scene_nodes(document, path)? {
        let world_from_node = &loader.world_from_nodes[node.index()];
        punctual::read_node(&node, world_from_node, path, &mut file, &mut orthographic)?;
        if let Some((mesh, world_from_object)) = loader.read_node(&node)? {
            file.nodes.push(MeshNode { mesh: file.meshes.len(), world_from_object });
            file.meshes.push(mesh);
        }
    }
    let more = read_more(document, &loader.data, &mut file)?;
    let mut warnings = loader.into_warnings();
    if orthographic > 0 {
        warnings.push(format!(
            "{orthographic} orthographic cameras are left out; give them a perspective to see through them"
        ));
    }
    let instancing = "EXT_mesh_gpu_instancing";
    if document.extensions_used().any(|name| name == instancing) {
        warnings.push(format!("{instancing} is not read; each of its nodes stands once"));
    }
    file.warnings.splice(0..0, warnings);
    Ok((file, more))
}

/// What `alphaCutoff` is where a file does not say it (glTF 2.0, 3.9.4).
const DEFAULT_ALPHA_CUTOFF: f32 = 0.5;

struct Loader<'a> {
    data: Data<'a>,
    world_from_nodes: Vec<DMat4>,
    next_number: u32,
    primitives_left_out: usize,
    left_out: LeftOut,
    /// Primitives whose alpha would blend them with what is behind.
    blended: usize,
    textures: Textures<'a>,
}

impl Loader<'_> {
    /// The mesh of a node, and world space from its object space.
    fn read_node(&mut self, node: &Node) -> Result<Option<(TriangleMesh, DMat4)>, LoadError> {
        let Some(source) = node.mesh() else {
            return Ok(None);
        };
        let name = node.name().or(source.name()).unwrap_or_default();
        // Each primitive takes time, also where it brings nothing.
        let number_count = name.len() as u64 + 16 * source.primitives().len() as u64;
        self.data.count_numbers(number_count, || nodes::node_place(node))?;
        let weights = node.weights().or(source.weights()).unwrap_or_default();
        let joint_matrices = match node.skin() {
            Some(skin) => Some(skin::joint_matrices(&skin, &self.world_from_nodes, &self.data)?),
            None => None,
        };
        let mut mesh = TriangleMesh { name: name.to_owned(), ..TriangleMesh::default() };
        for primitive in source.primitives() {
            let place =
                format!("{}, mesh {}, primitive {}", nodes::node_place(node), source.index(), primitive.index());
            if !primitive::has_triangles(&primitive) {
                self.primitives_left_out += 1;
                let vertex_count = primitive.get(&gltf::Semantic::Positions).map_or(0, |accessor| accessor.count());
                mesh.unlisted_vertices += self.numbers(vertex_count)?.count() as u32;
                continue;
            }
            let Some(mut vertices) = primitive::read_vertices(&primitive, weights, &self.data)? else {
                self.primitives_left_out += 1;
                continue;
            };
            if let Some(joint_matrices) = &joint_matrices {
                skin::apply(&mut vertices, &primitive, joint_matrices, &self.data, &place)?;
            }
            let first_vertex = mesh.positions.len() as u32;
            for (vertex, position) in vertices.positions.iter().enumerate() {
                let position = position.map(|coordinate| coordinate as f32);
                if !is_finite(position) {
                    return Err(LoadError::NotFinite {
                        path: self.data.path.into(),
                        place: format!("{place}, vertex {vertex}"),
                    });
                }
                mesh.positions.push(position);
            }
            let to_f32 = |normal: &[f64; 3]| normal.map(|coordinate| coordinate as f32);
            mesh.normals.extend(vertices.normals.iter().map(to_f32));
            mesh.normals.resize(mesh.positions.len(), [0.0; 3]);
            mesh.colors.extend(vertices.colors);
            let vertex_count = vertices.positions.len();
            mesh.vertex_numbers.extend(self.numbers(vertex_count)?);
            let triangles =
                primitive::read_triangles(&primitive, vertex_count, &self.data, &place, &mut self.left_out)?;
            let in_mesh = |triangle: [u32; 3]| triangle.map(|vertex| first_vertex + vertex);
            let first_triangle = mesh.triangles.len() as u32;
            mesh.triangles.extend(triangles.into_iter().map(in_mesh));
            let texture = match self.textures.of_primitive(&primitive, vertex_count, &self.data)? {
                Some(TexturedVertices { texture, coordinates }) => {
                    mesh.texture_coordinates.resize(first_vertex as usize, [0.0; 2]);
                    mesh.texture_coordinates.extend(coordinates);
                    Some(texture)
                }
                None => None,
            };
            let alpha_cutoff = self.alpha_cutoff(&primitive, &place)?;
            if alpha_cutoff.is_some() {
                mesh.alphas.resize(first_vertex as usize, 1.0);
                mesh.alphas.extend(vertices.alphas);
            }
            if texture.is_some() || alpha_cutoff.is_some() {
                let triangles = first_triangle..mesh.triangles.len() as u32;
                mesh.parts.push(MaterialPart { triangles, texture, alpha_cutoff });
            }
        }
        if !mesh.texture_coordinates.is_empty() {
            mesh.texture_coordinates.resize(mesh.positions.len(), [0.0; 2]);
        }
        if !mesh.alphas.is_empty() {
            mesh.alphas.resize(mesh.positions.len(), 1.0);
        }
        mesh.complete_normals();
        let world_from_object = match joint_matrices {
            Some(_) => DMat4::IDENTITY,
            None => self.world_from_nodes[node.index()],
        };
        Ok(Some((mesh, world_from_object)))
    }

    /// Alpha below which a primitive has nothing; none where its alpha cuts nothing.
    fn alpha_cutoff(&mut self, primitive: &Primitive, place: &str) -> Result<Option<f32>, LoadError> {
        let material = primitive.material();
        self.blended += usize::from(material.alpha_mode() == AlphaMode::Blend);
        if material.alpha_mode() != AlphaMode::Mask {
            return Ok(None);
        }
        let cutoff = material.alpha_cutoff().unwrap_or(DEFAULT_ALPHA_CUTOFF);
        if cutoff.is_finite() && cutoff >= 0.0 {
            // No alpha is below 0.
            return Ok(Some(cutoff).filter(|cutoff| *cutoff > 0.0));
        }
        Err(self.data.malformed(place.to_owned(), "has an alphaCutoff that is no number from 0 on; correct it"))
    }

    /// The next numbers of the file.
    fn numbers(&mut self, count: usize) -> Result<std::ops::Range<u32>, LoadError> {
        let first = self.next_number;
        let end = u32::try_from(count).ok().and_then(|count| first.checked_add(count));
        self.next_number = end.ok_or_else(|| LoadError::TooManyVertices { path: self.data.path.into() })?;
        Ok(first..self.next_number)
    }

    fn into_warnings(self) -> Vec<String> {
        let mut warnings = Vec::new();
        if self.primitives_left_out > 0 {
            warnings.push(format!(
                "{} primitives that are points or lines, or have no positions, are left out",
                self.primitives_left_out
            ));
        }
        if self.left_out.indices > 0 {
            warnings.push(format!(
                "{} indices after the last whole triangle of a primitive are left out",
                self.left_out.indices
            ));
        }
        if self.blended > 0 {
            warnings.push(format!(
                "{} primitives have alphaMode BLEND; their alpha is not read: they are seen, and cast, whole",
                self.blended
            ));
        }
        warnings.extend(self.textures.into_warnings());
        warnings
    }
}
