//! OBJ files as literal text.
#![cfg(feature = "obj")]

use std::path::Path;

use contrejour_mesh::{LoadError, MeshFile, TriangleMesh, load, load_obj};

fn load_text(text: &str) -> Result<MeshFile, LoadError> {
    load_obj(text.as_bytes(), Path::new("literal.obj"))
}

fn mesh(text: &str) -> TriangleMesh {
    let file = load_text(text).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(file.meshes.len(), 1);
    file.meshes.into_iter().next().expect("has one mesh")
}

/// Triangles by vertex number.
fn numbered(mesh: &TriangleMesh) -> Vec<[u32; 3]> {
    let number = |vertex: u32| mesh.vertex_numbers[vertex as usize];
    mesh.triangles.iter().map(|triangle| triangle.map(number)).collect()
}

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

#[test]
fn lines_join_at_backslashes_also_before_windows_line_ends() {
    for text in ["f 1 2 \\\n3 4\n", "f 1 \\\r\n2 3 \\\r\n4\r\n"] {
        let mesh = mesh(&format!("{SQUARE}{text}"));
        assert_eq!(numbered(&mesh), [[0, 1, 2], [0, 2, 3]]);
    }
}

#[test]
fn negative_indices_count_back_from_their_line() {
    let mesh = mesh("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf -3 -2 -1\n");
    assert_eq!(numbered(&mesh), [[0, 1, 2], [3, 4, 5]]);
}

#[test]
fn groups_and_objects_are_one_mesh_in_file_order() {
    let text = format!("o first\n{SQUARE}f 1 2 3\ng second\nusemtl a\nf 1 3 4\no third\nf 4 3 1\n");
    let mesh = mesh(&text);
    assert_eq!(mesh.name, "first");
    assert_eq!(numbered(&mesh), [[0, 1, 2], [0, 2, 3], [3, 2, 0]]);
}

#[test]
fn polygons_are_fans_from_their_first_corner_even_concave_ones() {
    // The second corner would be the better start of this arrow head.
    let mesh = mesh("v 0 0 0\nv 2 -1 0\nv 1 0 0\nv 2 1 0\nv 1 3 0\nf 2 3 4 5 1\n");
    assert_eq!(numbered(&mesh), [[1, 2, 3], [1, 3, 4], [1, 4, 0]]);
}

#[test]
fn vertices_at_one_place_share_the_lowest_number() {
    let mesh = mesh("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv -0.0 0 0\nf 5 3 4\n");
    assert_eq!(numbered(&mesh), [[1, 2, 3]]);
    assert_eq!(mesh.unlisted_vertices, 2, "v lines 1 and 2 are in no face");
}

#[test]
fn lines_points_and_short_faces_are_counted_and_left_out() {
    let file = load_text(&format!("{SQUARE}l 1 2 3\np 1\nf 1 2\nf\nf 1 2 3\nnonsense 5\n"));
    let file = file.unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(file.triangle_count(), 1);
    assert_eq!(file.warnings.len(), 3, "{:?}", file.warnings);
    assert!(file.warnings[0].starts_with("2 line and point"), "{:?}", file.warnings);
    assert!(file.warnings[1].contains("line 7"), "{:?}", file.warnings);
    assert!(file.warnings[2].contains("line 10"), "{:?}", file.warnings);
}

#[test]
fn errors_name_the_line() {
    let cases = [
        ("v 0 0 0\nv 1 0 zero\n", "line 2"),
        ("v 0 0\n", "line 1"),
        ("\n\nv nan 0 0\n", "line 3"),
        ("v 1e39 0 0\n", "line 1"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\n# c\nf 1 2 4\n", "line 5"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 0 1 2\n", "line 4"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 -4\n", "line 4"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 x\n", "line 4"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//9223372036854775807\n", "line 5"),
        ("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/1/1/1 2 3\n", "line 4"),
    ];
    for (text, place) in cases {
        let error = load_text(text).expect_err(text).to_string();
        assert!(error.starts_with(&format!("literal.obj: {place}: ")), "{error}");
        assert!(!error.contains('\n'), "{error}");
    }
}

#[test]
fn normals_of_the_file_are_kept_and_broken_ones_computed() {
    let text = format!("{SQUARE}vn 0 3 4\nvn nan 0 0\nf 1//1 2//1 3//1 4//2\n");
    let mesh = mesh(&text);
    for (vertex, &number) in mesh.vertex_numbers.iter().enumerate() {
        let expected = if number == 3 { [0.0, 0.0, 1.0] } else { [0.0, 0.6, 0.8] };
        assert_eq!(mesh.normals[vertex], expected);
    }
}

#[test]
fn boxes_are_flat_and_fans_smooth() {
    let corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
    let sides = "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    let flat = mesh(&format!("{corners}{sides}"));
    assert_eq!(flat.positions.len(), 24, "each corner once for each side");
    assert!(flat.normals.iter().all(|normal| normal.iter().map(|x| x.abs()).sum::<f32>() == 1.0));

    // Two triangles that meet at 20 degrees.
    let smooth = mesh("v 0 0 0\nv 0 1 0\nv -1 0 0\nv 0.9396926 0 -0.3420201\nf 1 2 3\nf 2 1 4\n");
    assert_eq!(smooth.positions.len(), 4);
    let same_ends = smooth.normals[smooth.triangles[0][0] as usize];
    assert!((same_ends[2] - 10.0_f32.to_radians().cos()).abs() < 1e-6, "{same_ends:?}");
}

#[test]
fn faces_without_area_make_no_nan() {
    let mesh = mesh("v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nf 1 2 3\nf 1 1 2\nf 4 4 4\nf 1 2 4\n");
    assert_eq!(mesh.triangles.len(), 4);
    assert!(mesh.normals.as_flattened().iter().all(|x| x.is_finite()), "{:?}", mesh.normals);
}

#[test]
fn diffuse_colours_come_from_the_material_file() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let path = folder.path().join("Painted.OBJ");
    let text =
        format!("mtllib my paint.mtl\n{SQUARE}usemtl red\nf 1 2 3\nusemtl grey\nf 1 3 4\nusemtl none\nf 1 2 4\n");
    std::fs::write(&path, &text).expect("the folder is writable");

    let file = load(&path).unwrap_or_else(|error| panic!("{error}"));
    assert_eq!(file.warnings.len(), 2, "my and paint.mtl are missing: {:?}", file.warnings);
    assert!(file.warnings[0].contains("cannot be read"), "{:?}", file.warnings);
    assert!(file.meshes[0].colors.iter().all(|&color| color == TriangleMesh::DEFAULT_COLOR));

    let library = "newmtl red\nKd 1 0.5 0\nmap_Kd a.png\nnewmtl grey\n\tKd 0.25\n";
    std::fs::write(folder.path().join("my paint.mtl"), library).expect("the folder is writable");
    let file = load(&path).unwrap_or_else(|error| panic!("{error}"));
    let mesh = &file.meshes[0];
    let color = |triangle: usize| mesh.colors[mesh.triangles[triangle][0] as usize];
    assert_eq!([color(0), color(1), color(2)], [[1.0, 0.5, 0.0], [0.25; 3], TriangleMesh::DEFAULT_COLOR]);
    assert_eq!(file.warnings.len(), 2, "texture and material none: {:?}", file.warnings);
}

#[test]
fn no_faces_are_an_empty_mesh() {
    let mesh = mesh("# nothing\nv 1 2 3\n");
    assert_eq!((mesh.triangles.len(), mesh.unlisted_vertices), (0, 1));
}
