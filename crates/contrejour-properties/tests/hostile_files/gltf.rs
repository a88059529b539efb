//! glTF and GLB files.

use contrejour_mesh::LoadError;
use contrejour_properties::Format::Gltf;

use super::{loads, refusal, turn};

/// A triangle from nine zeros, with other nodes and another accessor where they are given.
fn triangle(nodes: &str, accessor: &str) -> String {
    [
        r#"{"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":["#,
        nodes,
        r#"],"accessors":[{"componentType":5126,"type":"VEC3",""#,
        accessor,
        r#"}],"bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"data:,"#,
        &"%00".repeat(36),
        r#""}]}"#,
    ]
    .concat()
}

const THREE: &str = r#"bufferView":0,"count":3"#;

/// An accessor without a view: zeros, but for one that is zero too.
fn zeros(count: &str) -> String {
    let sparse = r#"{"count":1,"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":0}}"#;
    format!(r#"sparse":{sparse},"count":{count}"#)
}

fn glb(json: &str, [file_length, json_length, binary_length]: [u32; 3]) -> Vec<u8> {
    let mut glb = b"glTF\x02\0\0\0".to_vec();
    glb.extend(file_length.to_le_bytes());
    glb.extend(json_length.to_le_bytes());
    glb.extend(b"JSON");
    glb.extend(json.as_bytes());
    glb.extend(binary_length.to_le_bytes());
    glb.extend(b"BIN\0");
    glb.extend([0; 36]);
    glb
}

#[test]
fn lengths_that_lie() {
    let _turn = turn();
    let json = triangle(r#"{"mesh":0}"#, THREE);
    let true_json = json.len() as u32;
    let true_file = 28 + true_json + 36;
    assert!(loads("true lengths", Gltf, &glb(&json, [true_file, true_json, 36])));
    for lengths in [[u32::MAX, true_json, 36], [true_file + 1, true_json, 36]] {
        let error = refusal("a file's length", Gltf, &glb(&json, lengths));
        assert!(matches!(error, LoadError::BeyondData { .. }), "{lengths:?}: {error}");
    }
    for length in [0, 11] {
        let error = refusal("a file's length", Gltf, &glb(&json, [length, true_json, 36]));
        assert!(error.to_string().contains(&format!("{length} bytes, less than its header")), "{error}");
    }
    for lengths in [[true_file, u32::MAX, 36], [true_file, true_json, u32::MAX], [true_file, true_json - 1, 36]] {
        let error = refusal("a chunk's length", Gltf, &glb(&json, lengths));
        assert!(matches!(error, LoadError::Malformed { .. }), "{lengths:?}: {error}");
    }
}

#[test]
fn elements_that_are_only_counted() {
    let _turn = turn();
    for count in ["4000000000", "18446744073709551615"] {
        let of_view = triangle(r#"{"mesh":0}"#, &format!(r#"bufferView":0,"count":{count}"#));
        let error = refusal(count, Gltf, of_view.as_bytes());
        assert!(matches!(error, LoadError::BeyondData { .. }), "{error}");
        let of_nothing = triangle(r#"{"mesh":0}"#, &zeros(count));
        let error = refusal(count, Gltf, of_nothing.as_bytes());
        assert!(matches!(error, LoadError::TooManyNumbers { .. }), "{error}");
    }
}

#[test]
fn zeros_that_many_nodes_repeat() {
    let _turn = turn();
    // 3 * 5000 numbers a node, which has 11 bytes.
    let nodes = vec![r#"{"mesh":0}"#; 10_000].join(",");
    let error = refusal("zeros", Gltf, triangle(&nodes, &zeros("5000")).as_bytes());
    assert!(matches!(error, LoadError::TooManyNumbers { .. }), "{error}");
    let fewer = vec![r#"{"mesh":0}"#; 500].join(",");
    assert!(loads("a forest", Gltf, triangle(&fewer, THREE).as_bytes()));
}

#[test]
fn a_long_name_that_many_nodes_repeat() {
    let _turn = turn();
    let nodes = vec![r#"{"mesh":0}"#; 10_000].join(",");
    let name = format!(r#""meshes":[{{"name":"{}","#, "x".repeat(1_000_000));
    let file = triangle(&nodes, THREE).replace(r#""meshes":[{"#, &name);
    let error = refusal("a name", Gltf, file.as_bytes());
    assert!(matches!(error, LoadError::TooManyNumbers { .. }), "{error}");
}

#[test]
fn many_buffers_of_one_file() {
    let _turn = turn();
    let buffers = vec![r#"{"byteLength":36,"uri":"this"}"#; 10_000].join(",");
    let file = triangle(r#"{"mesh":0}"#, THREE).replace(r#""buffers":["#, &format!(r#""buffers":[{buffers},"#));
    assert!(loads("buffers", Gltf, file.as_bytes()));
}

#[test]
fn nodes_in_rings_and_in_chains() {
    let _turn = turn();
    for ring in [r#"{"mesh":0,"children":[0]}"#, r#"{"children":[1]},{"children":[2]},{"mesh":0,"children":[0]}"#] {
        let error = refusal(ring, Gltf, triangle(ring, THREE).as_bytes());
        assert!(matches!(error, LoadError::NodeReachedTwice { .. }), "{error}");
    }
    let chain: Vec<String> = (1..100_000).map(|child| format!(r#"{{"children":[{child}]}}"#)).collect();
    assert!(loads("a chain", Gltf, triangle(&(chain.join(",") + r#",{"mesh":0}"#), THREE).as_bytes()));
}

#[test]
fn json_that_is_nested_too_deep() {
    let _turn = turn();
    for (open, close) in [("[", "]"), (r#"{"a":"#, "}")] {
        let nested = open.repeat(100_000) + "0" + &close.repeat(100_000);
        for place in [r#"{"mesh":0,"extras":"#, r#"{"mesh":0,"extensions":{"x":"#, r#"{"mesh":0,"matrix":"#] {
            let end = if place.contains("extensions") { "}}" } else { "}" };
            loads(place, Gltf, triangle(&(place.to_owned() + &nested + end), THREE).as_bytes());
        }
        let error = refusal("nothing else", Gltf, nested.as_bytes());
        assert!(matches!(error, LoadError::Malformed { .. }), "{error}");
        loads("without an end", Gltf, open.repeat(1_000_000).as_bytes());
    }
}

#[test]
fn names_of_several_lines_stay_on_one() {
    let _turn = turn();
    let required = r#"{"extensionsRequired":["a\nb"],"asset""#;
    let error = refusal("an extension", Gltf, triangle("", THREE).replacen(r#"{"asset""#, required, 1).as_bytes());
    assert!(matches!(error, LoadError::UnsupportedExtension { .. }), "{error}");
}
