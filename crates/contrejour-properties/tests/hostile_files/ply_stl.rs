//! PLY and STL files.

use contrejour_mesh::LoadError;
use contrejour_properties::Format::{Ply, Stl};

use super::{loads, refusal, turn};

fn ply(encoding: &str, vertices: &str, faces: &str, list: &str, body: &[u8]) -> Vec<u8> {
    let header = format!(
        "ply\nformat {encoding} 1.0\nelement vertex {vertices}\nproperty float x\nproperty float y\nproperty float z\n\
         element face {faces}\nproperty list {list} vertex_indices\nend_header\n"
    );
    [header.as_bytes(), body].concat()
}

#[test]
fn elements_that_are_only_announced() {
    let _turn = turn();
    for encoding in ["ascii", "binary_little_endian", "binary_big_endian"] {
        for count in ["4294967295", "18446744073709551615"] {
            for file in [ply(encoding, count, "0", "uchar int", b""), ply(encoding, "0", count, "uchar int", b"")] {
                let error = refusal("a count", Ply, &file);
                assert!(matches!(error, LoadError::BeyondData { .. }), "{encoding} {count}: {error}");
            }
        }
    }
}

#[test]
fn lists_that_promise_too_much() {
    let _turn = turn();
    let four_billion = [0xff; 8];
    for encoding in ["binary_little_endian", "binary_big_endian"] {
        let error = refusal("a length", Ply, &ply(encoding, "0", "1", "uint uchar", &four_billion));
        assert!(matches!(error, LoadError::Malformed { .. }), "{encoding}: {error}");
    }
    for length in ["4294967295", "1e18", "inf", "nan", "-1", "0.5"] {
        let body = format!("{length} 1 2 3");
        let error = refusal(length, Ply, &ply("ascii", "0", "1", "double int", body.as_bytes()));
        assert!(matches!(error, LoadError::Malformed { .. }), "{length}: {error}");
    }
}

#[test]
fn headers_that_do_not_end() {
    let _turn = turn();
    for header in
        ["ply\n".to_owned() + &"comment x\n".repeat(100_000), "ply\ncomment ".to_owned() + &"x".repeat(10_000_000)]
    {
        let error = refusal("a header", Ply, header.as_bytes());
        assert!(matches!(error, LoadError::Malformed { .. }), "{error}");
    }
}

#[test]
fn a_hundred_thousand_properties() {
    let _turn = turn();
    let properties: String = (0..100_000).map(|nth| format!("property char p{nth}\n")).collect();
    let header = format!("ply\nformat ascii 1.0\nelement vertex 1\n{properties}end_header\n");
    let error = refusal("properties", Ply, header.as_bytes());
    assert!(matches!(error, LoadError::BeyondData { .. }), "{error}");
}

#[test]
fn a_facet_count_that_lies() {
    let _turn = turn();
    let with_count = |count: u32, body: usize| {
        let mut file = vec![b' '; 80];
        file.extend(count.to_le_bytes());
        file.resize(84 + body, 0);
        file
    };
    for (count, body) in [(u32::MAX, 50), (2, 50), (1, 49)] {
        let error = refusal("a count", Stl, &with_count(count, body));
        assert!(matches!(error, LoadError::BeyondData { .. }), "{count}: {error}");
    }
    assert!(loads("more than counted", Stl, &with_count(1, 120)));
}

#[test]
fn numbers_of_a_million_digits() {
    let _turn = turn();
    let digits = "3".repeat(1_000_000);
    let facet = |x: &str| format!("solid\nfacet normal 0 0 1\nvertex {x} 0 0\nvertex 1 0 0\nvertex 0 1 0\nendfacet\n");
    assert!(loads("a share", Stl, facet(&format!("0.{digits}")).as_bytes()));
    let error = refusal("a large number", Stl, facet(&digits).as_bytes());
    assert!(matches!(error, LoadError::NotFinite { .. }), "{error}");
    let body = format!("0 0 0.{digits} 3 0 0 0");
    assert!(loads("a share", Ply, &ply("ascii", "1", "1", "uchar int", body.as_bytes())));
}

#[test]
fn a_vertex_of_a_million_numbers() {
    let _turn = turn();
    let file = format!("solid\nfacet normal 0 0 1\nvertex{}\n", " 1".repeat(1_000_000));
    let error = refusal("numbers", Stl, file.as_bytes());
    assert!(matches!(error, LoadError::Malformed { .. }), "{error}");
}
