//! glTF files that the test writes itself: JSON with its buffer as a data URI.
#![cfg(feature = "gltf")]

mod gltf_file;

use contrejour_mesh::{LoadError, load};
use glam::DVec3;
use gltf_file::{Builder, F32, I16, U8, U16, f32_bytes, square, u16_bytes};
use serde_json::{Value, json};

#[test]
fn lists_strips_and_fans_with_and_without_indices() {
    let indexed = |mode: u32, indices: &[u16]| {
        let file = square()
            .accessor(U16, "SCALAR", indices.len(), &u16_bytes(indices))
            .set("/meshes/0/primitives/0/indices", json!(1))
            .set("/meshes/0/primitives/0/mode", json!(mode))
            .loaded();
        let mesh = &file.meshes[0];
        // By number, because vertices are repeated where faces of a strip fold back on each other.
        let numbered = |triangle: &[u32; 3]| triangle.map(|vertex| mesh.vertex_numbers[vertex as usize]);
        let triangles: Vec<[u32; 3]> = mesh.triangles.iter().map(numbered).collect();
        (triangles, file.warnings.len())
    };
    assert_eq!(indexed(4, &[0, 1, 2, 2, 1, 3]), (vec![[0, 1, 2], [2, 1, 3]], 0));
    assert_eq!(indexed(4, &[0, 1, 2, 2]), (vec![[0, 1, 2]], 1));
    assert_eq!(indexed(5, &[0, 1, 2, 3, 0]), (vec![[0, 1, 2], [1, 3, 2], [2, 3, 0]], 0));
    assert_eq!(indexed(6, &[0, 1, 3, 2]), (vec![[0, 1, 3], [0, 3, 2]], 0));
    assert_eq!(indexed(1, &[0, 1, 3, 2]), (vec![], 1));
    let file = square().set("/meshes/0/primitives/0/mode", json!(5)).loaded();
    assert_eq!(file.meshes[0].triangles, [[0, 1, 2], [1, 3, 2]]);
    assert!(file.meshes[0].normals.iter().all(|&normal| normal == [0.0, 0.0, 1.0]));
}

#[test]
fn nodes_stand_in_depth_first_order_and_number_on() {
    let file = square()
        .set(
            "/nodes",
            json!([
                {"mesh": 0, "name": "last"},
                {"children": [2, 3], "translation": [10, 0, 0], "scale": [2, 2, 2]},
                {"mesh": 0, "name": "first", "translation": [1, 0, 0]},
                {"mesh": 0, "name": "second"},
            ]),
        )
        .set("/meshes/0/primitives/0/mode", json!(5))
        .set("/scenes", json!([{"nodes": [1, 0]}]))
        .loaded();
    let names: Vec<&str> = file.meshes.iter().map(|mesh| mesh.name.as_str()).collect();
    assert_eq!(names, ["first", "second", "last"]);
    assert_eq!(file.meshes[2].vertex_numbers, [8, 9, 10, 11]);
    let origin = file.nodes[0].world_from_object.transform_point3(DVec3::ZERO);
    assert_eq!(origin, DVec3::new(12.0, 0.0, 0.0));
    assert_eq!(file.triangle_count(), 6);
    let bounds = file.bounds_world().expect("has triangles");
    assert_eq!(bounds, (DVec3::ZERO, DVec3::new(14.0, 2.0, 0.0)));
}

#[test]
fn colours_are_factor_times_attribute() {
    let file = square()
        .accessor(U8, "VEC4", 4, &[255, 51, 0, 255].repeat(4))
        .set("/meshes/0/primitives/0/attributes/COLOR_0", json!(1))
        .set("/materials", json!([{"pbrMetallicRoughness": {"baseColorFactor": [0.5, 0.5, 1, 1]}}]))
        .set("/meshes/0/primitives/0/material", json!(0))
        .loaded();
    assert_eq!(file.meshes[0].colors, [[0.5, 0.1, 0.0]; 4]);
}

#[test]
fn quantised_positions_with_and_without_normalisation() {
    let bytes: Vec<u8> = [0_i16, 0, 0, 32_767, 0, 0, 0, -32_768, 0].iter().flat_map(|x| x.to_le_bytes()).collect();
    let builder = || {
        let builder = Builder::new().accessor(I16, "VEC3", 3, &bytes);
        builder.set("/extensionsRequired", json!(["KHR_mesh_quantization"]))
    };
    let plain = builder().loaded();
    assert_eq!(plain.meshes[0].positions[1..], [[32_767.0, 0.0, 0.0], [0.0, -32_768.0, 0.0]]);
    let normalised = builder().set("/accessors/0/normalized", json!(true)).loaded();
    assert_eq!(normalised.meshes[0].positions[1..], [[1.0, 0.0, 0.0], [0.0, -1.0, 0.0]]);
}

#[test]
fn morph_targets_have_their_default_weights() {
    let moved = [[0.0, 0.0, 1.0]; 4];
    let builder = || {
        square()
            .positions(&moved)
            .set("/meshes/0/primitives/0/targets", json!([{"POSITION": 1}]))
            .set("/meshes/0/weights", json!([0.5]))
    };
    assert_eq!(builder().loaded().meshes[0].positions[3], [1.0, 1.0, 0.5]);
    let of_node = builder().set("/nodes/0/weights", json!([2])).loaded();
    assert_eq!(of_node.meshes[0].positions[3], [1.0, 1.0, 2.0]);
}

#[test]
fn joints_place_a_skinned_mesh_and_its_own_node_does_not() {
    let joints: Vec<u8> = [0, 1, 0, 0].repeat(4);
    let weights: Vec<f32> = [[1.0, 0.0, 0.0, 0.0], [0.5, 0.5, 0.0, 0.0], [0.0, 1.0, 0.0, 0.0], [0.0; 4]].concat();
    let mut inverse_bind = glam::Mat4::IDENTITY.to_cols_array().to_vec();
    inverse_bind.extend(glam::Mat4::from_translation(glam::Vec3::NEG_X).to_cols_array());
    let builder = |joint: u8| {
        let joints: Vec<u8> = joints.iter().map(|&of_skin| of_skin * joint).collect();
        square()
            .accessor(U8, "VEC4", 4, &joints)
            .accessor(F32, "VEC4", 4, &f32_bytes(&weights))
            .accessor(F32, "MAT4", 2, &f32_bytes(&inverse_bind))
            .set("/meshes/0/primitives/0/attributes", json!({"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}))
            .set(
                "/nodes",
                json!([
                    {"mesh": 0, "skin": 0, "translation": [100, 0, 0]},
                    {"children": [2], "translation": [0, 0, 4]},
                    {"translation": [0, 2, 0]},
                ]),
            )
            .set("/skins", json!([{"joints": [1, 2], "inverseBindMatrices": 3}]))
    };
    let file = builder(1).loaded();
    let expected = [[0.0, 0.0, 4.0], [0.5, 1.0, 4.0], [-1.0, 3.0, 4.0], [1.0, 1.0, 0.0]];
    assert_eq!(file.meshes[0].positions, expected);
    assert_eq!(file.nodes[0].world_from_object, glam::DMat4::IDENTITY);
    let error = builder(9).refused();
    assert!(matches!(error, LoadError::IndexOutOfRange { what: "joint", index: 9, .. }), "{error}");
}

#[test]
fn broken_files_are_refused_with_their_reason() {
    let far =
        square().accessor(U16, "SCALAR", 3, &u16_bytes(&[0, 1, 4])).set("/meshes/0/primitives/0/indices", json!(1));
    assert!(matches!(far.refused(), LoadError::IndexOutOfRange { what: "vertex", index: 4, count: 4, .. }));

    let lying_accessor = square().set("/accessors/0/count", json!(1_000_000_000_000_u64));
    assert!(matches!(lying_accessor.refused(), LoadError::BeyondData { .. }));
    let lying_view = square().set("/bufferViews/0/byteLength", json!(1_000_000));
    assert!(matches!(lying_view.refused(), LoadError::BeyondData { .. }));
    let sparse = json!({"count": 1, "indices": {"bufferView": 0, "componentType": U8}, "values": {"bufferView": 0}});
    let zeros = json!({"componentType": F32, "type": "VEC3", "count": 1_u64 << 40, "sparse": sparse});
    let lying_zeros = square().set("/accessors/0", zeros);
    let error = lying_zeros.refused();
    assert!(matches!(error, LoadError::TooManyNumbers { .. }), "{error}");

    for extension in ["KHR_draco_mesh_compression", "EXT_meshopt_compression"] {
        let error = square().set("/extensionsRequired", json!([extension])).refused();
        assert!(
            matches!(&error, LoadError::UnsupportedExtension { extension: name, .. } if name == extension),
            "{error}"
        );
    }

    let ring = square().set("/nodes", json!([{"mesh": 0, "children": [1]}, {"children": [0]}]));
    assert!(matches!(ring.refused(), LoadError::NodeReachedTwice { .. }));
    let two_parents = square().set("/nodes", json!([{"children": [2]}, {"children": [2]}, {"mesh": 0}]));
    assert!(matches!(two_parents.refused(), LoadError::NodeReachedTwice { node: 2, .. }));

    let infinite = Builder::new().positions(&[[0.0; 3], [0.0, f32::NAN, 0.0], [1.0; 3]]).refused();
    let message = infinite.to_string();
    assert!(message.contains("node 0 \"body\", mesh 0, primitive 0, vertex 1"), "{message}");

    let missing_node = square().set("/scenes", json!([{"nodes": [7]}])).refused();
    assert!(matches!(missing_node, LoadError::Malformed { .. }), "{missing_node}");
}

#[test]
fn very_deep_nodes_do_not_overflow_the_stack() {
    const DEPTH: usize = 100_000;
    let mut nodes: Vec<Value> = (1..DEPTH).map(|child| json!({"children": [child]})).collect();
    nodes.push(json!({"mesh": 0}));
    assert_eq!(square().set("/nodes", json!(nodes)).loaded().nodes.len(), 1);
}

#[test]
fn a_buffer_beside_the_file_may_have_spaces_in_its_name() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let mut builder = square();
    builder.root["buffers"] = json!([{"byteLength": 48, "uri": "my%20buffer.bin"}]);
    let path = folder.path().join("square.gltf");
    std::fs::write(&path, builder.root.to_string()).expect("the folder is writable");
    let error = load(&path).expect_err("its buffer is missing");
    assert!(error.to_string().contains("my buffer.bin"), "{error}");
    let buffer = folder.path().join("my buffer.bin");
    std::fs::write(&buffer, &builder.buffer[..40]).expect("the folder is writable");
    assert!(matches!(load(&path), Err(LoadError::BeyondData { needed: 48, available: 40, .. })));
    std::fs::write(&buffer, &builder.buffer).expect("the folder is writable");
    assert_eq!(load(&path).map(|file| file.triangle_count()).ok(), Some(1));
}
