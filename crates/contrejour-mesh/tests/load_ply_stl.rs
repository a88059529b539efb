//! PLY and STL files as literal bytes, and what all formats share.
#![cfg(all(feature = "ply", feature = "stl"))]

use std::path::Path;

use contrejour_mesh::{LoadError, ReadFileError, TriangleMesh, load, load_ply, load_stl};

fn ply(bytes: &[u8]) -> TriangleMesh {
    let file = load_ply(bytes, Path::new("literal.ply")).unwrap_or_else(|error| panic!("{error}"));
    file.meshes.into_iter().next().expect("has one mesh")
}

fn ply_error(bytes: &[u8]) -> String {
    load_ply(bytes, Path::new("literal.ply")).expect_err("is refused").to_string()
}

const ASCII: &str = "ply\r\nformat ascii 1.0\r\ncomment x\r\nelement vertex 4\r\nproperty float x\r\nproperty double y\r\n\
    property int z\r\nproperty uchar red\r\nproperty uchar green\r\nproperty uchar blue\r\nelement face 1\r\n\
    property list uchar int vertex_indices\r\nend_header\r\n";

#[test]
fn ascii_ply_with_colours_and_a_polygon() {
    let mesh =
        ply(format!("{ASCII}0 0 0 255 0 0\n1. 0 0 255 0 0\n1 1 0 0 255 0\n.0 1 0 0 0 255\n4 0 1 2 3\n").as_bytes());
    assert_eq!(mesh.triangles, [[0, 1, 2], [0, 2, 3]]);
    assert_eq!(mesh.vertex_numbers, [0, 1, 2, 3]);
    assert_eq!(mesh.colors[2], [0.0, 1.0, 0.0]);
    assert_eq!(mesh.normals[0], [0.0, 0.0, 1.0]);
}

#[test]
fn broken_ply_files_name_the_place() {
    let rows = "0 0 0 1 1 1\n1 0 0 1 1 1\n1 1 0 1 1 1\n0 1 0 1 1 1\n";
    let cases = [
        (format!("{ASCII}0 0 0 1 1 1\n1 0 nine 1 1 1\n{rows}"), "line 15: a word"),
        (format!("{ASCII}0 0 0 1 1 1\ninf 0 0 1 1 1\n{rows}"), "line 15: a coordinate"),
        (format!("{ASCII}{rows}3 0 1 4\n"), "triangle 0: names vertex 4"),
        (format!("{ASCII}{rows}3 0 1 -1\n"), "line 18: names vertex -1"),
        (format!("{ASCII}{rows}3 0 1\n"), "line 19: the file ends"),
        (ASCII.replace("element vertex 4", "element vertex 4000000000000"), "element vertex: needs"),
        ("plx\n".to_owned(), "line 1"),
        ("ply\nformat ascii 1.0\n".to_owned(), "line 3"),
    ];
    for (text, expected) in cases {
        let error = ply_error(text.as_bytes());
        assert!(error.starts_with(&format!("literal.ply: {expected}")), "{error}");
    }
}

#[test]
fn binary_ply_in_both_byte_orders() {
    let header = |order: &str| {
        format!(
            "ply\nformat binary_{order}_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
             property double z\nelement face 2\nproperty uchar flags\nproperty list uint ushort vertex_index\nend_header\n"
        )
    };
    let corners = [[0.0_f32, 0.0, 0.0], [1.5, 0.0, 0.0], [0.0, 1.0, -2.0]];
    let mut little = header("little").into_bytes();
    let mut big = header("big").into_bytes();
    for [x, y, z] in corners {
        little.extend([x.to_le_bytes(), y.to_le_bytes()].as_flattened());
        little.extend(f64::from(z).to_le_bytes());
        big.extend([x.to_be_bytes(), y.to_be_bytes()].as_flattened());
        big.extend(f64::from(z).to_be_bytes());
    }
    for face in [&[0_u16, 1, 2][..], &[0, 1]] {
        little.push(7);
        big.push(7);
        little.extend((face.len() as u32).to_le_bytes());
        big.extend((face.len() as u32).to_be_bytes());
        for corner in face {
            little.extend(corner.to_le_bytes());
            big.extend(corner.to_be_bytes());
        }
    }
    for bytes in [little, big] {
        let mesh = ply(&bytes);
        assert_eq!(mesh.positions, corners);
        assert_eq!(mesh.triangles, [[0, 1, 2]], "the face of two corners is left out");
        for length in 0..bytes.len() {
            let _refused = ply_error(&bytes[..length]);
        }
    }
}

fn binary_stl(header: &[u8], facets: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = header.to_vec();
    bytes.resize(80, b' ');
    bytes.extend((facets.len() as u32).to_le_bytes());
    for facet in facets {
        bytes.extend([0; 12]);
        bytes.extend(facet.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

const FACETS: [[[f32; 3]; 3]; 2] =
    [[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], [[0.0, 1.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0]]];

#[test]
fn stl_vertices_are_never_merged() {
    let text = "solid a name\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n\
        FACET NORMAL 0 0 0\n OUTER LOOP\n VERTEX 0 1 0\n VERTEX 1 0 0\n VERTEX 1 1e0 0\n ENDLOOP\n ENDFACET\nendsolid\n";
    let solid = binary_stl(b"solid and yet binary", &FACETS);
    let plain = binary_stl(b"x", &FACETS);
    for bytes in [text.as_bytes(), &solid, &plain] {
        let file = load_stl(bytes, Path::new("literal.stl")).unwrap_or_else(|error| panic!("{error}"));
        let mesh = &file.meshes[0];
        assert_eq!(mesh.positions, FACETS.as_flattened());
        assert_eq!(mesh.triangles, [[0, 1, 2], [3, 4, 5]]);
        assert_eq!(mesh.vertex_numbers, [0, 1, 2, 3, 4, 5]);
        assert!(mesh.normals.iter().all(|&normal| normal == [0.0, 0.0, 1.0]));
    }
}

#[test]
fn broken_stl_files_name_the_place() {
    let mut infinite = FACETS;
    infinite[1][2][0] = f32::INFINITY;
    let cut_off = &binary_stl(b"x", &FACETS)[..180];
    let infinite = binary_stl(b"x", &infinite);
    let six_corners = format!("solid\nfacet\n{}endfacet\n", "vertex 0 0 0\n".repeat(6));
    let cases: [(&[u8], &str); 7] = [
        (cut_off, "binary STL: needs 184 bytes"),
        (b"too short", "binary STL: needs 84 bytes"),
        (&infinite, "facet 1: a coordinate"),
        (b"solid\nfacet\nvertex 0 0\n", "line 3: a vertex"),
        (b"solid\nvertex 0 0 0\nvertex 1 0 0\nendfacet\n", "line 4: a facet"),
        (six_corners.as_bytes(), "line 9: a facet"),
        (b"solid\nvertex 0 0 0\n", "line 2: the file ends"),
    ];
    for (bytes, expected) in cases {
        let error = load_stl(bytes, Path::new("a.stl")).expect_err(expected).to_string();
        assert!(error.starts_with(&format!("a.stl: {expected}")), "{error}");
    }
}

#[test]
fn what_is_no_mesh_file_is_refused_with_a_remedy() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let inside = |name: &str| folder.path().join(name);
    std::fs::write(inside("empty.stl"), b"").expect("the folder is writable");
    std::fs::write(inside("text.txt"), b"x").expect("the folder is writable");
    std::fs::create_dir(inside("folder.ply")).expect("the folder is writable");
    let error = |name: &str| load(&inside(name)).expect_err(name);
    assert!(matches!(error("empty.stl"), LoadError::Empty { .. }));
    assert!(matches!(error("text.txt"), LoadError::UnknownFormat { .. }));
    assert!(matches!(error("folder.ply"), LoadError::File(ReadFileError::Directory { .. })));
    assert!(matches!(error("missing.obj"), LoadError::File(ReadFileError::System { .. })));
    assert!(matches!(load(folder.path()), Err(LoadError::File(ReadFileError::Directory { .. }))));
}
