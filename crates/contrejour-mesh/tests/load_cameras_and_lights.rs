//! Cameras and lights of glTF files that the test writes itself.
#![cfg(feature = "gltf")]

mod gltf_file;

use contrejour_mesh::{FileCamera, FileLight, FileLightKind, LoadError, MeshFile};
use glam::DVec3;
use gltf_file::{Builder, square};
use serde_json::{Value, json};

/// A quarter turn about y: what looked along -z looks along -x.
fn turned() -> Value {
    json!([0.0, std::f64::consts::FRAC_1_SQRT_2, 0.0, std::f64::consts::FRAC_1_SQRT_2])
}

fn with_nodes(nodes: Value) -> Builder {
    square().set("/meshes/0/primitives/0/mode", json!(5)).set("/nodes", nodes)
}

fn with_camera(perspective: Value) -> Builder {
    with_nodes(json!([{"mesh": 0}, {"camera": 0, "translation": [1, 2, 3], "rotation": turned(), "name": "door"}]))
        .set("/cameras", json!([{"type": "perspective", "perspective": perspective, "name": "own"}]))
}

fn with_light(light: Value) -> Builder {
    let node =
        json!({"extensions": {"KHR_lights_punctual": {"light": 0}}, "translation": [1, 2, 3], "rotation": turned()});
    with_nodes(json!([{"mesh": 0}, node]))
        .set("/extensionsUsed", json!(["KHR_lights_punctual"]))
        .set("/extensions", json!({"KHR_lights_punctual": {"lights": [light]}}))
}

fn only<T: Clone>(items: &[T]) -> T {
    let [item] = items else { panic!("{} items", items.len()) };
    item.clone()
}

fn is_near(a: DVec3, b: DVec3) -> bool {
    a.distance(b) < 1e-6
}

#[test]
fn a_camera_stands_where_its_node_is() {
    let file = with_camera(json!({"yfov": 0.5, "znear": 0.25, "zfar": 100})).loaded();
    assert!(file.warnings.is_empty(), "{:?}", file.warnings);
    let FileCamera { name, node, eye, forward, up, fov_y, near, far } = only(&file.cameras);
    assert_eq!(node, 1);
    assert_eq!((name.as_str(), eye, fov_y, near, far), ("door", DVec3::new(1.0, 2.0, 3.0), 0.5, 0.25, Some(100.0)));
    assert!(is_near(forward, DVec3::NEG_X) && is_near(up, DVec3::Y), "{forward} {up}");
    assert_eq!(only(&with_camera(json!({"yfov": 0.5, "znear": 0.25})).loaded().cameras).far, None);
}

#[test]
fn an_orthographic_camera_is_left_out_with_a_warning() {
    let orthographic = json!({"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0.1, "zfar": 9}});
    let file = with_camera(json!({"yfov": 0.5, "znear": 0.25})).set("/cameras", json!([orthographic])).loaded();
    assert!(file.cameras.is_empty());
    assert!(only(&file.warnings).contains("1 orthographic"), "{:?}", file.warnings);
}

#[test]
fn lights_have_their_own_units() {
    let load = |light: Value| only(&with_light(light).loaded().lights);
    let sun = load(json!({"type": "directional", "name": "sun", "color": [1, 0.5, 0.25], "intensity": 1e5}));
    assert_eq!((sun.name.as_str(), sun.color, sun.intensity, sun.range), ("sun", [1.0, 0.5, 0.25], 1e5, None));
    assert!(matches!(sun.kind, FileLightKind::Directional { direction } if is_near(direction, DVec3::NEG_X)));

    let lamp = load(json!({"type": "point", "range": 8}));
    assert_eq!(
        lamp,
        FileLight {
            name: String::new(),
            node: 1,
            kind: FileLightKind::Point { position: DVec3::new(1.0, 2.0, 3.0) },
            color: [1.0; 3],
            intensity: 1.0,
            range: Some(8.0)
        }
    );
    let spot = load(json!({"type": "spot", "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}}));
    let FileLightKind::Spot { position, direction, inner_half_angle, outer_half_angle } = spot.kind else {
        panic!("{spot:?}")
    };
    assert!(is_near(position, DVec3::new(1.0, 2.0, 3.0)) && is_near(direction, DVec3::NEG_X), "{spot:?}");
    assert_eq!([inner_half_angle, outer_half_angle], [0.25, 0.5]);
    let plain = load(json!({"type": "spot", "spot": {}}));
    let is_default = matches!(plain.kind, FileLightKind::Spot { inner_half_angle: 0.0, outer_half_angle, .. }
        if (outer_half_angle - std::f64::consts::FRAC_PI_4).abs() < 1e-6);
    assert!(is_default, "{plain:?}");
}

#[test]
fn what_is_no_camera_or_light_is_refused() {
    let refused = |file: Builder| -> String {
        let result: Result<MeshFile, LoadError> = file.load();
        let error = result.expect_err("it is broken");
        assert!(matches!(error, LoadError::Malformed { .. }), "{error:?}");
        error.to_string()
    };
    for perspective in [
        json!({"yfov": 0, "znear": 0.1}),
        json!({"yfov": 3.13, "znear": 0.1}),
        json!({"yfov": 1, "znear": 0}),
        json!({"yfov": 1, "znear": 0.1, "zfar": 0.1}),
    ] {
        let told = refused(with_camera(perspective.clone()));
        assert!(told.contains("node 1 \"door\"") && told.contains("correct"), "{perspective}: {told}");
    }
    // Some readers of JSON refuse such a number themselves.
    assert!(refused(with_camera(json!({"yfov": 1, "znear": 0.1, "zfar": 1e300}))).contains("correct"));
    let flat = with_camera(json!({"yfov": 1, "znear": 0.1})).set("/nodes/1/scale", json!([1, 1, 0]));
    assert!(refused(flat).contains("no direction"));
    let far = with_camera(json!({"yfov": 1, "znear": 0.1})).set("/nodes/1/translation", json!([1e16, 0, 0]));
    assert!(refused(far).contains("nearer"));
    refused(with_camera(json!({"yfov": 1, "znear": 0.1})).set("/nodes/1/camera", json!(1)));
    refused(with_camera(json!({"yfov": 1, "znear": 0.1})).set("/cameras", json!([{"type": "perspective"}])));
    for light in [
        json!({"type": "point", "intensity": -1}),
        json!({"type": "point", "intensity": 1e300}),
        json!({"type": "point", "color": [1, -1, 1]}),
        json!({"type": "point", "range": 0}),
        json!({"type": "spot", "spot": {"innerConeAngle": 0.5, "outerConeAngle": 0.5}}),
        json!({"type": "spot", "spot": {"outerConeAngle": 1.6}}),
        json!({"type": "spot"}),
        json!({"type": "lamp"}),
    ] {
        let told = refused(with_light(light.clone()));
        assert!(!told.contains('\n'), "{light}: {told}");
    }
    refused(with_light(json!({"type": "point"})).set("/nodes/1/extensions/KHR_lights_punctual/light", json!(1)));
}
