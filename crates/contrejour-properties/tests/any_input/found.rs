//! What fuzzing found, kept.

use contrejour_mesh::Motion;
use contrejour_properties::{Caster, Format, Lens, check_mesh_file, check_silhouette};
use glam::DVec3;

/// A light's nearest depth was no normal 32-bit number.
#[test]
fn a_mesh_of_subnormal_size_has_a_scene() {
    let text = "solid\nfacet\nvertex 0 0 0\nvertex 7e-45 0 0\nvertex 0 7e-42 0\nendfacet\n";
    assert!(check_mesh_file(Format::Stl, text.as_bytes()).is_some());
}

/// The gltf crate's validation followed the index of positions without a look.
#[test]
fn positions_of_no_accessor_are_refused() {
    let text =
        r#"{"asset":{"version":"2.0"},"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],"nodes":[{"mesh":0}]}"#;
    assert_eq!(check_mesh_file(Format::Gltf, text.as_bytes()), None);
}

/// Clamping kept what is no number.
#[test]
fn colours_that_are_no_numbers_are_refused() {
    let ply = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n\
        property float red\nproperty float green\nproperty float blue\nend_header\n0 0 0 0 nan 0\n";
    assert_eq!(check_mesh_file(Format::Ply, ply.as_bytes()), None);
    assert_eq!(check_mesh_file(Format::Obj, b"v 0 0 0 1 1 nan\nv 1 0 0 1 1 1\nv 0 1 0 1 1 1\nf 1 2 3\n"), None);
    // No numbers at all, and an infinite factor times zero.
    let gltf = |factor: &str, color: &str| {
        let text = [
            r#"{"asset":{"version":"2.0"},"nodes":[{"mesh":0}],"#,
            r#""meshes":[{"primitives":[{"attributes":{"POSITION":0,"COLOR_0":1},"material":0}]}],"#,
            r#""materials":[{"pbrMetallicRoughness":{"baseColorFactor":["#,
            factor,
            r#",0,0,1]}}],"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":1},"#,
            r#"{"bufferView":1,"componentType":5126,"type":"VEC3","count":1}],"#,
            r#""bufferViews":[{"buffer":0,"byteLength":12},{"buffer":0,"byteOffset":12,"byteLength":12}],"#,
            r#""buffers":[{"byteLength":24,"uri":"data:,"#,
            &"%00".repeat(12),
            &color.repeat(3),
            r#""}]}"#,
        ];
        check_mesh_file(Format::Gltf, text.concat().as_bytes())
    };
    assert_eq!(gltf("1", "%00%00%C0%7F"), None);
    // Refused or infinite, as serde_json's features read it.
    gltf("1e39", "%00%00%00%00");
}

/// A light that no 32-bit number can place: refused when a frame is prepared, loaded before.
#[test]
fn a_mesh_of_the_largest_numbers_loads() {
    let text = "v -3e38 0 0\nv 3e38 0 0\nv 0 3e38 0\nf 1 2 3\n";
    assert!(check_mesh_file(Format::Obj, text.as_bytes()).is_some());
}

/// The sign of a face without area that leads into a ring of such faces hung on the order of the faces.
#[test]
fn faces_without_area_beside_a_ring_of_their_kind() {
    let positions = vec![[0.0; 3], [0.0, 1.0, 0.0], [0.0, 2.0, 0.0], [0.0, 3.0, 0.0], [0.0, 4.0, 0.0]];
    let [ring, ring_too, beside] = [[0, 4, 3], [1, 0, 4], [2, 3, 0]];
    for triangles in [vec![ring, ring_too, beside], vec![beside, ring, ring_too], vec![ring, beside, ring_too]] {
        check_silhouette(&Caster {
            positions: positions.clone(),
            triangles,
            light: [0.3, 0.2, 1.0, 0.0],
            mirrored: false,
            motion: Motion::Rigid,
            weld_distance: None,
            lens: Lens { target: DVec3::ZERO, cone_angle: 1.0, near: 0.1, far: 10.0, radius: 0.1 },
        });
    }
}
