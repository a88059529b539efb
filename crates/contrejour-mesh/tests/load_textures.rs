//! Base colour textures of glTF files that the test writes itself.
#![cfg(feature = "gltf")]

mod gltf_file;

use std::path::Path;
use std::sync::Arc;

use contrejour_mesh::{
    LoadError, MaterialPart, MeshFile, ReadFileError, Texture, TextureFilter, TextureWrap, TriangleMesh, load_bytes,
};
use gltf_file::{Builder, F32, U8, f32_bytes, square};
use serde_json::{Value, json};

/// A square whose texture is image 0, with coordinates that go from 0 to 1.
fn textured(image: &Value) -> Builder {
    square()
        .accessor(F32, "VEC2", 4, &f32_bytes(&[0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0]))
        .set("/meshes/0/primitives/0/mode", json!(5))
        .set("/meshes/0/primitives/0/attributes/TEXCOORD_0", json!(1))
        .set("/meshes/0/primitives/0/material", json!(0))
        .set("/materials", json!([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]))
        .set("/textures", json!([{"source": 0}]))
        .set("/images", json!([image]))
}

fn mesh(builder: Builder) -> TriangleMesh {
    let file = builder.loaded();
    assert!(file.warnings.is_empty(), "{:?}", file.warnings);
    file.meshes.into_iter().next().expect("has a mesh")
}

fn data_uri() -> Value {
    json!({"uri": "data:image/png;base64,iVBORw=="})
}

/// The texture of a part.
fn texture(part: &MaterialPart) -> &Arc<Texture> {
    part.texture.as_ref().expect("it has one")
}

/// Loads with one file beside, `leaf 1.png`.
fn with_leaf_beside(builder: Builder) -> MeshFile {
    let read_beside = |path: &Path| match path.to_str() {
        Some("folder/leaf 1.png") => Ok(b"leaf".to_vec()),
        _ => Err(ReadFileError::NotAFile { path: path.into() }.into()),
    };
    load_bytes(builder.text().as_bytes(), Path::new("folder/literal.gltf"), &read_beside)
        .unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn pictures_come_as_the_file_has_them() {
    let from_uri = mesh(textured(&data_uri()));
    let [part] = &from_uri.parts[..] else { panic!("one part has a texture") };
    assert_eq!((part.triangles.clone(), &texture(part).image.bytes[..]), (0..2, &b"\x89PNG"[..]));
    assert_eq!(texture(part).image.place, "literal.gltf: image 0");
    assert_eq!(from_uri.texture_coordinates, [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]]);
    assert_eq!((texture(part).wrap, texture(part).filter), ([TextureWrap::Repeat; 2], TextureFilter::Linear));

    let in_buffer = textured(&json!({"bufferView": 2, "mimeType": "image/jpeg"})).accessor(U8, "SCALAR", 4, b"JFIF");
    assert_eq!(texture(&mesh(in_buffer).parts[0]).image.bytes, b"JFIF");

    let beside = with_leaf_beside(textured(&json!({"uri": "leaf%201.png"})));
    assert_eq!(beside.warnings, [""; 0]);
    let image = &texture(&beside.meshes[0].parts[0]).image;
    assert_eq!((image.place.as_str(), &image.bytes[..]), ("folder/leaf 1.png", &b"leaf"[..]));
}

#[test]
fn pictures_that_do_not_say_what_they_are() {
    let untyped = textured(&json!({"bufferView": 2})).accessor(U8, "SCALAR", 4, b"JFIF");
    assert_eq!(texture(&mesh(untyped).parts[0]).image.bytes, b"JFIF");
    let error = textured(&json!({"mimeType": "image/png"})).load().expect_err("it is nowhere");
    let told = error.to_string();
    assert!(matches!(error, LoadError::Malformed { .. }) && told.contains("image 0: has neither"), "{told}");
}

#[test]
fn a_picture_that_is_missing_is_a_warning() {
    for (uri, told) in [("no.png", "folder/no.png"), ("https://a/b.png", "network"), ("a%0Ab.png", "control character")]
    {
        let file = with_leaf_beside(textured(&json!({"uri": uri})));
        assert!(file.meshes[0].parts.is_empty() && file.meshes[0].texture_coordinates.is_empty());
        let [warning] = &file.warnings[..] else { panic!("{:?}", file.warnings) };
        assert!(warning.starts_with("image 0: texture not read") && warning.contains(told), "{warning}");
    }
}

#[test]
fn alpha_that_is_not_read_is_a_warning() {
    for (mode, warnings, cutoff) in [("OPAQUE", 0, None), ("MASK", 0, Some(0.5)), ("BLEND", 1, None)] {
        let file = textured(&data_uri()).set("/materials/0/alphaMode", json!(mode)).loaded();
        let [part] = &file.meshes[0].parts[..] else { panic!("it has one part") };
        assert_eq!((file.warnings.len(), part.alpha_cutoff), (warnings, cutoff), "{:?}", file.warnings);
    }
}

#[test]
fn masks_come_with_the_alpha_of_their_vertices() {
    let cut = |cutoff: f32| json!({"alphaMode": "MASK", "alphaCutoff": cutoff, "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]}});
    let alphas = f32_bytes(&[1.0, 1.0, 1.0, 0.25, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 0.0]);
    let primitives = json!([
        {"attributes": {"POSITION": 0}, "mode": 5},
        {"attributes": {"POSITION": 0, "COLOR_0": 1}, "mode": 5, "material": 0},
    ]);
    let builder = || {
        square()
            .accessor(F32, "VEC4", 4, &alphas)
            .set("/meshes/0/primitives", primitives.clone())
            .set("/materials", json!([cut(0.3)]))
    };
    let mesh = mesh(builder());
    let [part] = &mesh.parts[..] else { panic!("{:?}", mesh.parts) };
    assert_eq!((part.triangles.clone(), part.alpha_cutoff, part.texture.is_none()), (2..4, Some(0.3), true));
    assert_eq!(mesh.uncut_triangles()[..], mesh.triangles[..2]);
    for (vertex, number) in mesh.vertex_numbers.iter().enumerate() {
        assert_eq!(mesh.alphas[vertex], [1.0, 1.0, 1.0, 1.0, 0.125, 0.5, 0.5, 0.0][*number as usize]);
    }
    let error = builder().set("/materials", json!([cut(-1.0)])).load().expect_err("it is negative");
    assert!(error.to_string().contains("alphaCutoff"), "{error}");
}

#[test]
fn samplers_say_what_is_beyond_and_between() {
    let sampler = json!([{"magFilter": 9728, "wrapS": 33648, "wrapT": 33071}]);
    let mesh = mesh(textured(&data_uri()).set("/samplers", sampler).set("/textures/0/sampler", json!(0)));
    let texture = texture(&mesh.parts[0]);
    assert_eq!((texture.wrap, texture.filter), ([TextureWrap::Mirror, TextureWrap::Clamp], TextureFilter::Nearest));
}

#[test]
fn coordinates_are_transformed() {
    let transformed = |transform: Value| {
        let info = json!({"index": 0, "extensions": {"KHR_texture_transform": transform}});
        let builder = textured(&data_uri()).set("/materials/0/pbrMetallicRoughness/baseColorTexture", info);
        mesh(builder).texture_coordinates
    };
    let moved = transformed(json!({"scale": [2, 4], "offset": [0.5, -1]}));
    assert_eq!(moved, [[0.5, -1.0], [2.5, -1.0], [0.5, 3.0], [2.5, 3.0]]);
    // Counter-clockwise as one looks at a picture whose second coordinate goes down.
    let turned = transformed(json!({"rotation": std::f64::consts::FRAC_PI_2, "scale": [2, 1]}));
    for (found, expected) in turned.iter().zip([[0.0, 0.0], [0.0, -2.0], [1.0, 0.0], [1.0, -2.0]]) {
        let difference = (found[0] - expected[0]).abs().max((found[1] - expected[1]).abs());
        assert!(difference < 1e-6, "{turned:?}");
    }
}

#[test]
fn parts_share_pictures_and_know_their_triangles() {
    let primitive =
        |material: Value| json!({"attributes": {"POSITION": 0, "TEXCOORD_0": 1}, "mode": 5, "material": material});
    let plain = json!({"attributes": {"POSITION": 0}, "mode": 5});
    let mesh = mesh(
        textured(&data_uri())
            .set("/textures", json!([{"source": 0}, {"source": 0, "sampler": 0}]))
            .set("/samplers", json!([{"wrapS": 33071}]))
            .set(
                "/materials",
                json!([
                    {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}},
                    {"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}, "baseColorFactor": [1, 0.5, 0, 1]}},
                ]),
            )
            .set("/meshes/0/primitives", json!([plain, primitive(json!(0)), plain, primitive(json!(1))])),
    );
    let [first, second] = &mesh.parts[..] else { panic!("{:?}", mesh.parts) };
    assert_eq!([&first.triangles, &second.triangles], [&(2..4), &(6..8)]);
    assert!(Arc::ptr_eq(&texture(first).image, &texture(second).image) && first.texture != second.texture);
    assert_eq!(mesh.texture_coordinates.len(), mesh.positions.len());
    // Vertices are repeated where faces fold back on each other.
    for (vertex, number) in mesh.vertex_numbers.iter().enumerate() {
        let (nth_primitive, corner) = (number / 4, number % 4);
        let coordinates = [(corner % 2) as f32, (corner / 2) as f32];
        let expected = if nth_primitive % 2 == 1 { coordinates } else { [0.0; 2] };
        assert_eq!(mesh.texture_coordinates[vertex], expected, "vertex {number}");
        assert_eq!(mesh.colors[vertex], if nth_primitive == 3 { [1.0, 0.5, 0.0] } else { [1.0; 3] });
    }
}

#[test]
fn coordinates_that_are_missing_or_no_numbers() {
    let info = json!({"index": 0, "texCoord": 3});
    let file = textured(&data_uri()).set("/materials/0/pbrMetallicRoughness/baseColorTexture", info).loaded();
    assert!(file.meshes[0].parts.is_empty());
    assert!(matches!(&file.warnings[..], [warning] if warning.contains("texture coordinates")), "{:?}", file.warnings);

    let bad = f32_bytes(&[0.0, f32::NAN, 1.0, 0.0, 0.0, 1.0, 1.0, 1.0]);
    let builder = textured(&data_uri()).accessor(F32, "VEC2", 4, &bad);
    let error = builder.set("/meshes/0/primitives/0/attributes/TEXCOORD_0", json!(2)).load().expect_err("is no number");
    assert!(matches!(error, LoadError::Malformed { .. }) && error.to_string().contains("accessor 2"), "{error}");
}

#[test]
fn pictures_stay_within_the_file() {
    let beyond = textured(&json!({"bufferView": 2, "mimeType": "image/png"})).accessor(U8, "SCALAR", 4, b"JFIF");
    let error = beyond.set("/bufferViews/2/byteLength", json!(5)).load().expect_err("there are four");
    assert!(matches!(error, LoadError::BeyondData { .. }), "{error}");

    // Views of a few bytes that all name the same large part of the buffer.
    let count = 20_000;
    let mut builder = textured(&json!({"bufferView": 2, "mimeType": "image/png"})).accessor(
        U8,
        "SCALAR",
        4_000_000,
        &vec![7; 4_000_000],
    );
    let images: Vec<Value> = (0..count).map(|_| json!({"bufferView": 2, "mimeType": "image/png"})).collect();
    let textures: Vec<Value> = (0..count).map(|source| json!({"source": source})).collect();
    let material = |index| json!({"pbrMetallicRoughness": {"baseColorTexture": {"index": index}}});
    let materials: Vec<Value> = (0..count).map(material).collect();
    let attributes = json!({"POSITION": 0, "TEXCOORD_0": 1});
    let primitives: Vec<Value> =
        (0..count).map(|index| json!({"attributes": attributes, "mode": 5, "material": index})).collect();
    for (list, items) in [("images", images), ("textures", textures), ("materials", materials)]
        .map(|(name, items)| (format!("/{name}"), items))
    {
        builder = builder.set(&list, json!(items));
    }
    let error = builder.set("/meshes/0/primitives", json!(primitives)).load().expect_err("80 GB of pictures");
    assert!(matches!(error, LoadError::TooManyNumbers { .. }), "{error}");
}
