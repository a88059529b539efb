//! Rigs of glTF files: what moves, and where it is at a time.
#![cfg(feature = "gltf")]

mod gltf_file;

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4};
use std::path::{Path, PathBuf};

use contrejour_mesh::{AnimatedModel, BuildOptions, LoadError, TopologyAwareMesh, load, load_animated};
use glam::{DMat4, DVec3};
use gltf_file::{Builder, F32, U8, f32_bytes, square};
use serde_json::{Value, json};

/// The square, its right side on a second joint, which an animation moves by channels.
fn jointed_square() -> Builder {
    let weights: Vec<f32> =
        [[1.0, 0.0, 0.0, 0.0], [0.0, 2.0, 0.0, 0.0], [0.5, 0.5, 0.0, 0.0], [0.0; 4]].as_flattened().to_vec();
    let inverse_binds = [DMat4::IDENTITY, DMat4::from_translation(DVec3::NEG_X)];
    let inverse_binds: Vec<f32> = inverse_binds.iter().flat_map(|m| m.as_mat4().to_cols_array()).collect();
    let turn = |angle: f64| glam::DQuat::from_rotation_z(angle).as_quat().to_array();
    square()
        .accessor(U8, "VEC4", 4, &[0, 1, 0, 0].repeat(4))
        .accessor(F32, "VEC4", 4, &f32_bytes(&weights))
        .accessor(F32, "MAT4", 2, &f32_bytes(&inverse_binds))
        .accessor(F32, "SCALAR", 2, &f32_bytes(&[1.0, 3.0]))
        .accessor(F32, "VEC4", 2, &f32_bytes([turn(0.0), turn(FRAC_PI_2)].as_flattened()))
        .accessor(F32, "VEC3", 2, &f32_bytes(&[1.0, 0.0, 0.0, 1.0, 0.0, 8.0]))
        .accessor(F32, "VEC3", 6, &f32_bytes(&[[0.0; 9], [0.0; 9]].as_flattened()[..18]))
        .set("/meshes/0/primitives/0/attributes", json!({"POSITION": 0, "JOINTS_0": 1, "WEIGHTS_0": 2}))
        .set(
            "/nodes",
            json!([
                {"mesh": 0, "skin": 0, "translation": [100, 0, 0]},
                {"children": [2]},
                {"translation": [1, 0, 0]},
            ]),
        )
        .set("/skins", json!([{"joints": [1, 2], "inverseBindMatrices": 3}]))
        .set("/animations", json!([{"name": "bend", "samplers": [], "channels": []}]))
}

fn channel(node: u32, path: &str, output: u32, interpolation: &str) -> Value {
    json!({
        "name": "bend",
        "samplers": [{"input": 4, "output": output, "interpolation": interpolation}],
        "channels": [{"sampler": 0, "target": {"node": node, "path": path}}],
    })
}

fn positions(model: &AnimatedModel, time: f64) -> Vec<DVec3> {
    let rig = &model.rig;
    let pose = rig.pose(rig.animations.first(), time).expect("its numbers are small");
    let deforming = rig.parts[0].deforming.as_ref().expect("it has a skin");
    deforming.posed(&rig.part_pose(&rig.parts[0], &pose))
}

fn assert_near(found: &[DVec3], expected: &[[f64; 3]]) {
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(expected) {
        assert!(found.abs_diff_eq(DVec3::from(*expected), 1e-6), "{found} for {expected:?}");
    }
}

#[test]
fn a_joint_turns_what_hangs_on_it() {
    let bend = channel(2, "rotation", 5, "LINEAR");
    let model = jointed_square().set("/animations/0", bend).load_animated().expect("it is well formed");
    let rig = &model.rig;
    assert_eq!(rig.parts[0].skin, Some(0));
    assert_eq!((rig.animations[0].name.as_str(), rig.animations[0].duration), ("bend", 3.0));
    let rest = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0]];
    for time in [-1.0, 0.0, 1.0] {
        assert_near(&positions(&model, time), &rest);
    }
    // The third vertex is half with the joint at (1, 0), the last one with none.
    let c = FRAC_PI_4.cos();
    let half_way = [rest[0], rest[1], [0.5 * (1.0 - 2.0 * c), 0.5, 0.0], rest[3]];
    assert_near(&positions(&model, 2.0), &half_way);
    let at_end = [rest[0], rest[1], [0.0, 0.0, 0.0], rest[3]];
    for time in [3.0, 1e9] {
        assert_near(&positions(&model, time), &at_end);
    }
    let error = rig.animation("Bend").expect_err("names are compared exactly").to_string();
    assert!(error.contains(r#""Bend""#) && error.contains(r#""bend""#), "{error}");
}

#[test]
fn steps_hold_and_splines_are_smooth() {
    let step = jointed_square().set("/animations/0", channel(2, "translation", 6, "STEP"));
    let model = step.load_animated().expect("it is well formed");
    assert_near(&positions(&model, 2.9)[1..2], &[[1.0, 0.0, 0.0]]);
    assert_near(&positions(&model, 3.0)[1..2], &[[1.0, 0.0, 8.0]]);
    let spline = jointed_square().set("/animations/0", channel(2, "translation", 7, "CUBICSPLINE"));
    let model = spline.load_animated().expect("it is well formed");
    assert_near(&positions(&model, 2.0)[1..2], &[[0.0, 0.0, 0.0]]);
}

#[test]
fn weights_of_morph_targets_move() {
    let up: Vec<f32> = [[0.0, 0.0, 1.0]; 4].as_flattened().to_vec();
    let side: Vec<f32> = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0; 3], [0.0; 3]].as_flattened().to_vec();
    let model = square()
        .accessor(F32, "VEC3", 4, &f32_bytes(&up))
        .accessor(F32, "VEC3", 4, &f32_bytes(&side))
        .accessor(F32, "SCALAR", 2, &f32_bytes(&[0.0, 1.0]))
        .accessor(F32, "SCALAR", 4, &f32_bytes(&[1.0, 0.0, 0.0, 1.0]))
        .set("/meshes/0/primitives/0/targets", json!([{"POSITION": 1}, {"POSITION": 2}]))
        .set("/meshes/0/weights", json!([0.5, 0.0]))
        .set("/nodes/0/translation", json!([0, 0, 7]))
        .set(
            "/animations",
            json!([{
                "samplers": [{"input": 3, "output": 4}],
                "channels": [{"sampler": 0, "target": {"node": 0, "path": "weights"}}],
            }]),
        )
        .load_animated()
        .expect("it is well formed");
    assert_eq!(model.rig.animations[0].name, "0");
    assert_eq!(model.file.meshes[0].positions[1], [1.0, 0.0, 0.5]);
    assert_near(&positions(&model, 0.25)[..2], &[[0.0, 0.0, 0.75], [1.5, 0.0, 0.75]]);
    let pose = model.rig.pose(None, 0.0).expect("its numbers are small");
    let part_pose = model.rig.part_pose(&model.rig.parts[0], &pose);
    assert_eq!(part_pose.world_from_object, DMat4::from_translation(DVec3::new(0.0, 0.0, 7.0)));
    assert_eq!(part_pose.morph_weights, [0.5, 0.0]);
}

#[test]
fn a_rigid_mesh_moves_with_its_node_alone() {
    let model = square()
        .accessor(F32, "SCALAR", 2, &f32_bytes(&[1.0, 3.0]))
        .accessor(F32, "VEC3", 2, &f32_bytes(&[1.0, 0.0, 0.0, 1.0, 0.0, 8.0]))
        .set("/nodes", json!([{"mesh": 0, "scale": [2, 2, 2]}, {"children": [0]}]))
        .set(
            "/animations",
            json!([{
                "samplers": [{"input": 1, "output": 2}],
                "channels": [{"sampler": 0, "target": {"node": 1, "path": "translation"}}],
            }]),
        )
        .load_animated()
        .expect("it is well formed");
    let rig = &model.rig;
    assert!(rig.parts[0].deforming.is_none());
    let pose = rig.pose(rig.animations.first(), 2.0).expect("its numbers are small");
    let part_pose = rig.part_pose(&rig.parts[0], &pose);
    let moved = DMat4::from_translation(DVec3::new(1.0, 0.0, 4.0)) * DMat4::from_scale(DVec3::splat(2.0));
    assert_eq!(part_pose.world_from_object, moved);
}

#[test]
fn animations_that_do_not_fit_are_refused() {
    let refused = |builder: Builder| builder.load_animated().expect_err("it is refused").to_string();
    let text = refused(jointed_square().set("/animations/0", channel(2, "rotation", 6, "LINEAR")));
    assert!(text.contains("animation 0, channel 0") && text.contains("node 2 needs 4"), "{text}");
    let text = refused(jointed_square().set("/animations/0", channel(2, "translation", 6, "CUBICSPLINE")));
    assert!(text.contains("keys are of 1 numbers where node 2 needs 3"), "{text}");
    let matrix = json!({"matrix": DMat4::IDENTITY.to_cols_array()});
    let text = refused(jointed_square().set("/nodes/2", matrix).set("/animations/0", channel(2, "scale", 6, "STEP")));
    assert!(text.contains("which has a matrix"), "{text}");
    let text = refused(jointed_square().set("/skins/0/joints", json!([1])));
    assert!(text.contains("vertex 1: names joint 1"), "{text}");
}

#[test]
fn other_formats_have_no_rig() {
    let folder = tempfile::tempdir().expect("a temporary folder can be made");
    let path = folder.path().join("face.obj");
    std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").expect("it can be written");
    let model = load_animated(&path).expect("it is a mesh");
    assert_eq!(model.file, load(&path).expect("it is a mesh"));
    assert!(model.rig.animations.is_empty() && model.rig.parts.is_empty());
    assert!(matches!(load_animated(Path::new("no.such")), Err(LoadError::UnknownFormat { .. })));
}

/// Files of others, where they are.
fn animated_files() -> Vec<PathBuf> {
    let beside_workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/meshes");
    let folder = std::env::var_os("CONTREJOUR_MESHES").map_or(beside_workspace, PathBuf::from).join("animated");
    let names = ["AnimatedMorphSphere.glb", "CesiumMan.glb", "Fox.glb", "MorphStressTest/MorphStressTest.gltf"];
    let others = ["RiggedFigure.glb", "RiggedSimple.glb", "SimpleSkin/SimpleSkin.gltf", "robot.glb"];
    let paths: Vec<_> = names.iter().chain(&others).map(|name| folder.join(name)).collect();
    if !folder.is_dir() {
        println!("no meshes at {}: this test checks nothing", folder.display());
        return Vec::new();
    }
    paths
}

#[test]
fn at_rest_the_rig_and_the_plain_loader_agree() {
    for path in animated_files() {
        let plain = load(&path).unwrap_or_else(|error| panic!("{error}"));
        let model = load_animated(&path).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(plain.nodes, model.file.nodes);
        assert_eq!(model.rig.parts.len(), plain.nodes.len());
        assert!(!model.rig.animations.is_empty(), "{}", path.display());
        for ((part, plain), mesh) in model.rig.parts.iter().zip(&plain.meshes).zip(&model.file.meshes) {
            assert_eq!((&plain.triangles, &plain.vertex_numbers), (&mesh.triangles, &mesh.vertex_numbers));
            let size = plain.positions.as_flattened().iter().fold(0.0, |most: f32, x| most.max(x.abs()));
            for (plain, rig) in plain.positions.as_flattened().iter().zip(mesh.positions.as_flattened()) {
                assert!((plain - rig).abs() <= 1e-6 * size, "{}: {plain} and {rig}", path.display());
            }
            let Some(deforming) = &part.deforming else { continue };
            let topology = deforming
                .topology(&mesh.positions, &mesh.triangles)
                .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            assert_eq!(topology.candidate_edge_count as usize, topology.edges.len());
            let rigid = TopologyAwareMesh::build(&plain.positions, &plain.triangles, &BuildOptions::default())
                .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
            // What moves alike is at one place, but not the other way round.
            assert!(topology.report.welded_vertices <= rigid.report.welded_vertices, "{}", path.display());
            let borders = |topology: &TopologyAwareMesh| topology.report.border_edges.count;
            println!("{}: {} borders, {} at rest", path.display(), borders(&topology), borders(&rigid));
        }
    }
}
