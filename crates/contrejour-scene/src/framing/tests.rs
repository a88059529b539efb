use std::path::PathBuf;

use contrejour_mesh::{MeshFile, MeshNode, TriangleMesh};
use contrejour_plan::LightKind;
use glam::{DMat4, DVec3};

use crate::shapes::Shape;
use crate::{BUILT_IN_SCENES, Bounds, Scene, SceneMesh, orbit};

fn placed(shape: Shape, world_from_object: DMat4) -> MeshFile {
    let mesh = shape.generate().unwrap_or_else(|error| panic!("{error}"));
    MeshFile { meshes: vec![mesh], nodes: vec![MeshNode { mesh: 0, world_from_object }], ..MeshFile::default() }
}

/// What the scene is about: all but its floor and walls, which are named so in every scene.
fn subject(scene: &Scene) -> Bounds {
    let is_subject = |mesh: &&SceneMesh| mesh.name != "floor" && !mesh.name.ends_with(" wall");
    scene.meshes.iter().filter(is_subject).map(SceneMesh::bounds).fold(Bounds::EMPTY, Bounds::union)
}

fn assert_in_picture(scene: &Scene, points: &[DVec3], what: &str) {
    let clip_from_world = scene.camera.clip_from_world(scene.aspect());
    for &point in points {
        let clip = clip_from_world * point.extend(1.0);
        let ndc = clip.truncate() / clip.w;
        assert!(clip.w > 0.0 && ndc.x.abs() < 1.0 && ndc.y.abs() < 1.0, "{what}: {point} is out of the picture: {ndc}");
        assert!((0.0..=1.0).contains(&ndc.z), "{what}: {point} is out of the camera's depths: {ndc}");
    }
}

/// The points lie in the cone and the depths of the light, on every frame of an orbit of `frames`.
fn assert_in_light(scene: &Scene, points: &[DVec3], frames: u32, what: &str) {
    for frame in 0..frames {
        let LightKind::Spot { position, target, cone_angle, near, far, .. } =
            orbit(&scene.lights[0].light, frame, frames).kind
        else {
            panic!("{what}: a spot was asked for")
        };
        let axis = (target - position).normalize();
        for &point in points {
            let angle = (point - position).angle_between(axis);
            assert!(angle <= 0.5 * cone_angle, "{what}, frame {frame}: {point} is out of the cone");
            let depth = (point - position).dot(axis);
            assert!(near <= depth && depth <= far, "{what}, frame {frame}: {point} is out of the light's depths");
        }
    }
}

/// Where the shadows of points fall on the height `floor_y`.
fn shadows(scene: &Scene, points: &[DVec3], floor_y: f64) -> Vec<DVec3> {
    let LightKind::Spot { position, .. } = scene.lights[0].light.kind else { panic!("a spot was asked for") };
    let shadow = |point: &DVec3| position + (*point - position) * ((position.y - floor_y) / (position.y - point.y));
    points.iter().map(shadow).collect()
}

#[test]
fn built_in_scenes_show_and_light_what_they_have() {
    for built_in in BUILT_IN_SCENES {
        let scene = built_in.load().unwrap_or_else(|error| panic!("{error}"));
        let corners = subject(&scene).corners();
        assert_in_picture(&scene, &corners, built_in.name);
        // Suns and lamps reach around all meshes; where there are several lights no single one need.
        if scene.lights.len() > 1 || !matches!(scene.lights[0].light.kind, LightKind::Spot { .. }) {
            continue;
        }
        assert_in_light(&scene, &scene.bounds().corners(), 1, built_in.name);
        assert_in_light(&scene, &corners, 12, built_in.name);
        let floor = scene.bounds();
        for shadow in shadows(&scene, &corners, 0.0) {
            let inside = shadow.cmpge(floor.min - 1e-6).all() && shadow.cmple(floor.max + 1e-6).all();
            assert!(inside, "{}: the shadow {shadow} falls off the floor", built_in.name);
        }
    }
}

#[test]
fn a_mesh_alone_and_its_shadow_are_seen_and_lit_at_any_size_and_place() {
    let shapes = [
        Shape::Box { size: [1.0; 3] },
        Shape::Box { size: [0.02, 9.0, 0.02] },
        Shape::Box { size: [9.0, 0.02, 5.0] },
        Shape::Plane { size: [1.0, 1.0], segments: 1 },
        Shape::Torus { radius: 1.0, tube_radius: 0.3, segments: 24, sides: 12 },
    ];
    for shape in shapes {
        for scale in [1e-6, 1.0, 1e6] {
            for offset in [DVec3::ZERO, DVec3::new(2e4, -300.0, 1e3) * scale, DVec3::new(-1e3, 1e3, 0.0)] {
                let what = format!("{shape:?} times {scale} at {offset}");
                let matrix = DMat4::from_translation(offset) * DMat4::from_scale(DVec3::splat(scale));
                let scene = Scene::around(placed(shape, matrix));
                let corners = subject(&scene).corners();
                let floor = scene.meshes.last().expect("a floor was added");
                let floor_y = floor.bounds().max.y;
                assert!(floor.casts && floor.receives && floor_y < subject(&scene).min.y, "{what}: no floor below");
                let shadows = shadows(&scene, &corners, floor_y);
                assert_in_picture(&scene, &corners, &what);
                assert_in_picture(&scene, &shadows, &what);
                assert_in_light(&scene, &corners, 12, &what);
                assert_in_light(&scene, &shadows, 1, &what);
                for shadow in shadows {
                    let out = (shadow - floor.bounds().center()).with_y(0.0).length();
                    assert!(out <= 0.5 * floor.bounds().size().x, "{what}: the shadow falls off the floor");
                }
            }
        }
    }
}

#[test]
fn a_flat_sheet_hangs_above_its_floor() {
    let scene = Scene::around(placed(Shape::Plane { size: [2.0, 2.0], segments: 4 }, DMat4::IDENTITY));
    let floor_y = scene.meshes.last().expect("a floor was added").bounds().max.y;
    assert!(floor_y < -0.3, "{floor_y}");
}

#[test]
fn nothing_and_a_point_have_a_scene_too() {
    let point = TriangleMesh {
        positions: vec![[5.0, 6.0, 7.0]; 3],
        normals: vec![[0.0, 1.0, 0.0]; 3],
        colors: vec![[0.5; 3]; 3],
        triangles: vec![[0, 1, 2]],
        vertex_numbers: vec![0, 1, 2],
        ..TriangleMesh::default()
    };
    let node = MeshNode { mesh: 0, world_from_object: DMat4::IDENTITY };
    let files = [
        MeshFile::default(),
        MeshFile { meshes: vec![TriangleMesh::default()], nodes: vec![node], ..MeshFile::default() },
        MeshFile { meshes: vec![point], nodes: vec![node], ..MeshFile::default() },
    ];
    for file in files {
        let scene = Scene::around(file);
        assert!(scene.camera.clip_from_world(scene.aspect()).is_finite());
        assert!(scene.camera.near > 0.0 && scene.camera.near < scene.camera.far);
    }
}

#[test]
fn meshes_that_nobody_here_made_have_a_scene() {
    let folder = std::env::var_os("CONTREJOUR_MESHES")
        .map_or_else(|| PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../../shared/meshes"), PathBuf::from);
    let mut opened = 0;
    for name in ["closed/spot.obj", "open/mountain.obj", "open/cloth.obj", "nasty/moebius.obj", "nasty/Offset1.obj"] {
        let path = folder.join(name);
        if !path.exists() {
            println!("{} is missing: only the project's own meshes are tested", path.display());
            continue;
        }
        let scene = Scene::open(&path).unwrap_or_else(|error| panic!("{error}"));
        let corners = subject(&scene).corners();
        assert_in_picture(&scene, &corners, name);
        assert_in_light(&scene, &corners, 12, name);
        opened += 1;
    }
    println!("{opened} meshes from files");
}

#[test]
fn a_narrower_picture_keeps_the_sides() {
    let mut scene = Scene::around(placed(Shape::Box { size: [4.0, 1.0, 4.0] }, DMat4::IDENTITY));
    scene.resize([300, 900]);
    assert_in_picture(&scene, &subject(&scene).corners(), "a narrow picture");
}

#[test]
fn a_room_has_walls_around_and_something_within() {
    let inward = |size: f64| DMat4::from_scale(DVec3::new(-size, size, size));
    let shell = Shape::Box { size: [1.0; 3] }.generate().expect("a unit box");
    let mut turned = shell.clone();
    turned.triangles.iter_mut().for_each(|triangle| triangle.swap(1, 2));
    let file =
        |nodes: Vec<MeshNode>| MeshFile { meshes: vec![shell.clone(), turned.clone()], nodes, ..MeshFile::default() };
    let has_floor = |file| Scene::around(file).meshes.iter().any(|mesh| mesh.name == "floor");

    let hull = || MeshNode { mesh: 1, world_from_object: DMat4::from_scale(DVec3::splat(8.0)) };
    let body = || MeshNode { mesh: 0, world_from_object: DMat4::from_translation(DVec3::new(1.0, 0.0, 1.0)) };
    let room = Scene::around(file(vec![hull(), body()]));
    let inside = |point: DVec3| point.cmpgt(room.bounds().min).all() && point.cmplt(room.bounds().max).all();
    let LightKind::Spot { position, .. } = room.lights[0].light.kind else { panic!("a lamp was asked for") };
    assert!(inside(room.camera.eye) && inside(position));

    assert!(!has_floor(file(vec![hull(), body()])), "a room with a box in it");
    assert!(has_floor(file(vec![hull()])), "a body whose faces are wound inward");
    assert!(has_floor(file(vec![body()])), "a body");
    let mirrored = MeshNode { mesh: 0, world_from_object: inward(8.0) };
    assert!(has_floor(file(vec![mirrored, body()])), "a mirrored body stays a body");
}
