//! Bytes as a mesh file: refused in one line, or a mesh that all that follows can rely on.

use std::io;
use std::path::Path;

use contrejour_mesh::{
    BuildOptions, MaterialPart, MeshFile, ReadFileError, TopologyAwareMesh, TriangleMesh, load_bytes,
};
use contrejour_scene::{Bounds, Scene};

use crate::scene_text::check_scene;

/// The formats of mesh files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Wavefront OBJ with its material library.
    Obj,
    /// glTF and GLB, which the first bytes tell apart.
    Gltf,
    /// PLY, text and binary.
    Ply,
    /// STL, text and binary.
    Stl,
}

impl Format {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Obj, Self::Gltf, Self::Ply, Self::Stl];

    fn path(self) -> &'static Path {
        Path::new(match self {
            Self::Obj => "any.obj",
            Self::Gltf => "any.gltf",
            Self::Ply => "any.ply",
            Self::Stl => "any.stl",
        })
    }
}

/// Coordinates beyond this leave no room in `f32` for a light and a camera around the mesh: such a scene is refused when
/// its frame is prepared. It is the largest number of scene files too.
const REACH: f64 = 1e15;

/// What a file held.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Loaded {
    /// Vertices of all meshes.
    pub vertices: usize,
    /// Triangles of all meshes.
    pub triangles: usize,
}

/// Loads bytes as a mesh file, builds the topology of its meshes and puts them into a scene; `None` where the file is
/// refused. No file is opened: each file beside this one is this one again, but for those whose name has `missing`.
///
/// # Panics
///
/// When a refusal or a warning has more or less than one line, when a mesh is not as its type says, or when it has no
/// topology or no scene.
pub fn check_mesh_file(format: Format, bytes: &[u8]) -> Option<Loaded> {
    let read_beside = |path: &Path| match path.to_string_lossy().contains("missing") {
        true => Err(ReadFileError::System { path: path.into(), source: io::ErrorKind::NotFound.into() }.into()),
        false => Ok(bytes.to_vec()),
    };
    let file = match load_bytes(bytes, format.path(), &read_beside) {
        Ok(file) => file,
        Err(error) => {
            assert_one_line(&error.to_string());
            return None;
        }
    };
    Some(check_loaded(file))
}

fn check_loaded(file: MeshFile) -> Loaded {
    file.warnings.iter().for_each(|warning| assert_one_line(warning));
    for node in &file.nodes {
        assert!(node.mesh < file.meshes.len(), "a node has mesh {} of {}", node.mesh, file.meshes.len());
        assert!(node.world_from_object.is_finite(), "a node stands nowhere");
    }
    let mut loaded = Loaded::default();
    for mesh in &file.meshes {
        check_mesh(mesh);
        loaded.vertices += mesh.positions.len();
        loaded.triangles += mesh.triangles.len();
        let topology = TopologyAwareMesh::build(&mesh.positions, &mesh.triangles, &BuildOptions::default());
        let topology = topology.unwrap_or_else(|error| panic!("a loaded mesh has no topology: {error}"));
        assert_eq!(topology.faces.len(), mesh.triangles.len());
    }
    let scene = Scene::around(file);
    let Bounds { min, max } = scene.bounds();
    if min.abs().max(max.abs()).max_element() < REACH {
        check_scene(&scene);
    }
    loaded
}

fn check_mesh(mesh: &TriangleMesh) {
    let count = mesh.positions.len();
    assert_eq!([mesh.normals.len(), mesh.colors.len(), mesh.vertex_numbers.len()], [count; 3]);
    let is_finite = |vector: &[f32; 3]| vector.iter().all(|number| number.is_finite());
    assert!(mesh.positions.iter().all(is_finite), "a position is not finite");
    let is_unit = |normal: &[f32; 3]| (glam::Vec3::from(*normal).length() - 1.0).abs() < 1e-3;
    assert!(mesh.normals.iter().all(is_unit), "a normal is not of unit length");
    let is_color = |color: &[f32; 3]| color.iter().all(|channel| (0.0..=1.0).contains(channel));
    assert!(mesh.colors.iter().all(is_color), "a colour is out of its range");
    let is_there = |&vertex: &u32| (vertex as usize) < count;
    assert!(mesh.triangles.as_flattened().iter().all(is_there), "a triangle names a vertex that is not there");
    check_textures(mesh);
}

fn check_textures(mesh: &TriangleMesh) {
    let coordinates = &mesh.texture_coordinates;
    let count = |is_there: bool| if is_there { mesh.positions.len() } else { 0 };
    assert_eq!(coordinates.len(), count(mesh.parts.iter().any(|part| part.texture.is_some())), "texture coordinates");
    assert_eq!(mesh.alphas.len(), count(mesh.cut_parts().next().is_some()), "alphas");
    assert!(mesh.alphas.iter().all(|alpha| (0.0..=1.0).contains(alpha)), "an alpha is out of its range");
    assert!(coordinates.as_flattened().iter().all(|number| number.is_finite()), "a texture coordinate is not finite");
    let mut next = 0;
    for MaterialPart { triangles, alpha_cutoff, .. } in &mesh.parts {
        let is_in_order = next <= triangles.start && triangles.start <= triangles.end;
        assert!(is_in_order && triangles.end as usize <= mesh.triangles.len(), "a part is out of order");
        assert!(alpha_cutoff.is_none_or(|cutoff| cutoff.is_finite() && cutoff > 0.0), "a cutoff is out of its range");
        next = triangles.end;
    }
}

/// What is said to the user is one line, and not empty.
pub(crate) fn assert_one_line(message: &str) {
    assert!(!message.is_empty() && !message.contains(['\n', '\r']), "{message:?}");
}

#[cfg(test)]
mod tests {
    use super::*;
    use contrejour_mesh::{EncodedImage, Texture};

    use crate::planted::{Planted, assert_found};

    #[test]
    fn a_wrong_mesh_is_found() {
        let good = || {
            let stl = b"solid\nfacet\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\n";
            load_bytes(stl, Path::new("any.stl"), &|_| unreachable!("it is alone")).expect("a good file")
        };
        assert_eq!(check_loaded(good()), Loaded { vertices: 3, triangles: 1 });
        let faults: [Planted<MeshFile>; 14] = [
            ("a position", |file| file.meshes[0].positions[1][2] = f32::NAN),
            ("a normal", |file| file.meshes[0].normals[2] = [0.0; 3]),
            ("a colour", |file| file.meshes[0].colors[0][1] = 1.5),
            ("a colour", |file| file.meshes[0].colors[0][1] = f32::NAN),
            ("a triangle names", |file| file.meshes[0].triangles[0][0] = 3),
            ("left == right", |file| file.meshes[0].colors.truncate(2)),
            ("texture coordinates", |file| file.meshes[0].texture_coordinates.push([0.5; 2])),
            ("a part is", |file| {
                let image = EncodedImage { place: String::new(), bytes: Vec::new() };
                let texture = Texture { image: image.into(), wrap: Default::default(), filter: Default::default() };
                file.meshes[0].texture_coordinates = vec![[0.5; 2]; 3];
                let texture = Some(texture.into());
                file.meshes[0].parts.push(MaterialPart { triangles: 0..2, texture, alpha_cutoff: None });
            }),
            ("alphas", |file| file.meshes[0].alphas = vec![1.0; 3]),
            ("an alpha", |file| {
                file.meshes[0].alphas = vec![1.0, f32::NAN, 1.0];
                file.meshes[0].parts.push(MaterialPart { triangles: 0..1, texture: None, alpha_cutoff: Some(0.5) });
            }),
            ("a cutoff", |file| {
                file.meshes[0].alphas = vec![1.0; 3];
                file.meshes[0].parts.push(MaterialPart { triangles: 0..1, texture: None, alpha_cutoff: Some(-0.5) });
            }),
            ("a node has mesh", |file| file.nodes[0].mesh = 1),
            ("a node stands", |file| file.nodes[0].world_from_object.w_axis.x = f64::INFINITY),
            ("two\\nlines", |file| file.warnings.push("two\nlines".to_owned())),
        ];
        for (told, fault) in faults {
            let mut file = good();
            fault(&mut file);
            assert_found(told, || {
                check_loaded(file);
            });
        }
    }
}
