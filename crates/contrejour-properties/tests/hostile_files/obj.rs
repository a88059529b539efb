//! OBJ files.

use contrejour_mesh::LoadError;
use contrejour_properties::Format::Obj;

use super::{loads, refusal, turn};

const CORNERS: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

#[test]
fn vertices_that_are_only_named() {
    let _turn = turn();
    for index in ["4", "4294967296", "4294967297", "9223372036854775807", "-4", "-9223372036854775808", "0"] {
        let file = format!("{CORNERS}f 1 2 {index}\n");
        let error = refusal(index, Obj, file.as_bytes());
        assert!(matches!(error, LoadError::IndexOutOfRange { what: "vertex", count: 3, .. }), "{index}: {error}");
    }
    let error = refusal("beyond 64 bits", Obj, format!("{CORNERS}f 1 2 9223372036854775808\n").as_bytes());
    assert!(matches!(error, LoadError::Malformed { .. }), "{error}");
}

#[test]
fn numbers_of_a_million_digits() {
    let _turn = turn();
    let digits = "3".repeat(1_000_000);
    assert!(loads("a share", Obj, format!("{CORNERS}v 0.{digits} 0 0\nf 1 2 4\n").as_bytes()));
    let huge = refusal("a large number", Obj, format!("v {digits} 0 0\n").as_bytes());
    assert!(matches!(huge, LoadError::NotFinite { .. }), "{huge}");
    let index = refusal("an index", Obj, format!("{CORNERS}f 1 2 {digits}\n").as_bytes());
    assert!(matches!(index, LoadError::Malformed { .. }), "{index}");
}

#[test]
fn a_line_of_a_hundred_million_characters() {
    let _turn = turn();
    let mut file = format!("{CORNERS}f 1 2 3\n# ").into_bytes();
    file.resize(100_000_000, b'x');
    assert!(loads("one long comment", Obj, &file));
}

#[test]
fn a_face_of_a_million_corners() {
    let _turn = turn();
    assert!(loads("one long face", Obj, format!("{CORNERS}f{}\n", " 1 2 3".repeat(300_000)).as_bytes()));
}

#[test]
fn a_line_that_goes_on_a_million_times() {
    let _turn = turn();
    assert!(loads("joined lines", Obj, format!("{CORNERS}f 1 2 3 {}", "\\\n".repeat(1_000_000)).as_bytes()));
}

#[test]
fn no_text() {
    let _turn = turn();
    let zero = refusal("a zero byte", Obj, b"v 0 0 0\n\0");
    assert!(matches!(zero, LoadError::Malformed { .. }), "{zero}");
    assert!(loads("no UTF-8", Obj, &[CORNERS.as_bytes(), b"\xff\xfe \xc0\nf 1 2 3\n"].concat()));
}

#[test]
fn a_material_for_each_of_many_faces() {
    let _turn = turn();
    let of_face = |nth: usize| format!("newmtl {nth}\nusemtl {nth}\nf 1 2 3\n");
    let faces: String = (0..60_000).map(of_face).collect();
    assert!(loads("materials", Obj, format!("mtllib this\n{CORNERS}{faces}").as_bytes()));
}

#[test]
fn one_library_named_again_and_again() {
    let _turn = turn();
    let libraries = "mtllib a\nmtllib a b\n".repeat(20_000);
    assert!(loads("libraries", Obj, format!("{CORNERS}f 1 2 3\n{libraries}").as_bytes()));
}
