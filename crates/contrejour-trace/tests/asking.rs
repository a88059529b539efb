//! What the tracer promises about its answers, and what it says to bad questions.

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use contrejour_trace::{
    Facing, Holes, LightShape, OccluderError, OccluderMesh, Occluders, Receiver, TraceError, TraceOptions, Visibility,
    trace,
};
use glam::{DMat4, DVec3};

const FLOOR: [[f32; 3]; 3] = [[-9.0, 0.0, -9.0], [0.0, 0.0, 18.0], [9.0, 0.0, -9.0]];
const FACE: [[u32; 3]; 1] = [[0, 1, 2]];
const LAMP: LightShape = LightShape::Disk { center: DVec3::new(0.0, 4.0, 0.0), normal: DVec3::Y, radius: 1.0 };

/// The floor, a small copy of it above the middle, and a face without area.
fn scene() -> Occluders {
    let small = DMat4::from_translation(DVec3::Y * 2.0) * DMat4::from_scale(DVec3::splat(0.1));
    Occluders::new(&[
        OccluderMesh::new(&FLOOR, &FACE, DMat4::IDENTITY),
        OccluderMesh::new(&FLOOR, &FACE, small),
        OccluderMesh::new(&FLOOR, &[[0, 1, 1]], DMat4::IDENTITY),
    ])
    .expect("the scene is finite")
}

fn on_floor(x: f64, z: f64) -> Receiver {
    Receiver { position: DVec3::new(x, 0.0, z), face: 0, seen_from: DVec3::Y }
}

fn ask(light: &LightShape, receivers: &[Receiver]) -> Result<Vec<Visibility>, TraceError> {
    trace(&scene(), light, receivers, &TraceOptions::default(), &|_| ())
}

#[test]
fn faces_are_numbered_mesh_after_mesh() {
    let occluders = scene();
    assert_eq!([0, 1, 2, 3].map(|mesh| occluders.first_face(mesh)), [Some(0), Some(1), Some(2), None]);
    assert_eq!(occluders.face_count(), 3);
    assert_eq!(occluders.faces_without_area(), 1);
    assert_eq!([0, 1, 2, 3].map(|face| occluders.has_area(face)), [true, true, false, false]);
}

#[test]
fn the_same_question_has_the_same_answer() {
    let receivers: Vec<Receiver> =
        (0..900).map(|i| on_floor(f64::from(i % 30) / 10.0 - 1.5, f64::from(i / 30) / 10.0 - 1.5)).collect();
    let with_threads = |threads, receivers: &[Receiver]| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads can be had");
        pool.install(|| ask(&LAMP, receivers)).expect("the question is good")
    };
    let answers = with_threads(1, &receivers);
    assert!(answers.iter().any(|answer| answer.samples > 128 && answer.mean > 0.1 && answer.mean < 0.9));
    assert_eq!(with_threads(3, &receivers), answers, "on any number of threads");
    assert_eq!(with_threads(3, &receivers[..300]), answers[..300], "whoever else asks");

    let other = TraceOptions { seed: 1, ..Default::default() };
    let others = trace(&scene(), &LAMP, &receivers, &other, &|_| ()).expect("the question is good");
    assert_ne!(others, answers, "but not for another seed");
}

#[test]
fn progress_counts_each_receiver_once() {
    let done = AtomicUsize::new(0);
    let receivers = vec![on_floor(0.0, 0.0); 1000];
    let count = |more| {
        done.fetch_add(more, Relaxed);
    };
    trace(&scene(), &LAMP, &receivers, &TraceOptions::default(), &count).expect("the question is good");
    assert_eq!(done.into_inner(), receivers.len());
}

#[test]
fn lights_without_size_have_hard_shadows() {
    let center = DVec3::new(0.0, 4.0, 0.0);
    let lights = [
        LightShape::Disk { center, normal: DVec3::Y, radius: 0.0 },
        LightShape::Sphere { center, radius: 0.0 },
        LightShape::Rectangle { center, half_u: DVec3::ZERO, half_v: DVec3::ZERO },
        LightShape::Sun { towards_light: DVec3::Y, angular_radius: 0.0 },
    ];
    for light in lights {
        let answers = ask(&light, &[on_floor(0.0, 0.0), on_floor(3.0, -3.0)]).expect("the question is good");
        assert_eq!(answers.iter().map(|answer| answer.mean).collect::<Vec<_>>(), [0.0, 1.0], "{light:?}");
        assert!(answers.iter().all(|answer| answer.standard_error == 0.0 && answer.samples <= 1), "{light:?}");
    }
}

#[test]
fn a_face_hides_what_is_below_its_plane() {
    let seen = |light, seen_from| {
        let receiver = Receiver { seen_from, ..on_floor(5.0, -5.0) };
        ask(&light, &[receiver]).expect("the question is good")[0]
    };
    let at = |height| LightShape::Rectangle {
        center: DVec3::new(-3.0, height, -5.0),
        half_u: DVec3::Y,
        half_v: DVec3::new(0.0, 0.0, 0.2),
    };
    let cases = [
        (2.0, Facing::Towards, 1.0),
        (0.5, Facing::MostlyTowards, 0.75),
        (-0.5, Facing::MostlyAverted, 0.25),
        (-2.0, Facing::Averted, 0.0),
    ];
    for (height, facing, part) in cases {
        let front = seen(at(height), DVec3::Y);
        assert_eq!(front.facing, facing, "{height}");
        assert!((front.mean - part).abs() < 0.01, "{height}: {front:?}");
        let back = seen(at(-height), -DVec3::Y);
        assert_eq!(back.facing, facing, "{height}, from below");
        assert!((back.mean - part).abs() < 0.01, "{height}, from below: {back:?}");
    }
}

#[test]
fn inside_a_sphere_of_light_all_is_lit() {
    let light = LightShape::Sphere { center: DVec3::Y, radius: 3.0 };
    let answer = ask(&light, &[on_floor(0.0, 0.0)]).expect("the question is good")[0];
    assert_eq!((answer.mean, answer.standard_error), (1.0, 0.0));
}

#[test]
fn what_does_not_cast_only_receives() {
    let small = DMat4::from_translation(DVec3::Y * 2.0) * DMat4::from_scale(DVec3::splat(0.1));
    let floor = OccluderMesh::new(&FLOOR, &FACE, DMat4::IDENTITY);
    let ghost = OccluderMesh { casts: false, ..OccluderMesh::new(&FLOOR, &FACE, small) };
    let occluders = Occluders::new(&[floor, ghost]).expect("the scene is finite");
    let on_ghost = Receiver { position: DVec3::Y * 2.0, face: 1, seen_from: DVec3::Y * 9.0 };
    let receivers = [on_floor(0.0, 0.0), on_ghost];
    let answers = trace(&occluders, &LAMP, &receivers, &TraceOptions::default(), &|_| ()).expect("all is good");
    assert!(answers.iter().all(|answer| answer.mean == 1.0), "{answers:?}");
}

/// A sheet with a hole throws the shadow of what is left of it; the mesh before it keeps its faces whole.
#[test]
fn light_passes_through_holes() {
    let sheet = [[-2.0, 2.0, -2.0], [2.0, 2.0, -2.0], [2.0, 2.0, 2.0], [-2.0, 2.0, 2.0]];
    let half = [[-2.0, 2.0, -2.0], [0.0, 2.0, -2.0], [0.0, 2.0, 2.0], [-2.0, 2.0, 2.0]];
    let triangles = [[0, 1, 2], [0, 2, 3]];
    // Where x is above 0, of corners that are at -2 or 2.
    let holes = Holes::new(move |triangle, weights: [f64; 3]| {
        let along = triangles[triangle]
            .iter()
            .zip(weights)
            .map(|(&corner, weight)| f64::from(sheet[corner as usize][0]) * weight);
        along.sum::<f64>() > 0.0
    });
    let floor = OccluderMesh::new(&FLOOR, &FACE, DMat4::IDENTITY);
    let whole = OccluderMesh::new(&sheet, &triangles, DMat4::IDENTITY);
    let cut = OccluderMesh { holes: Some(holes), ..whole.clone() };
    let left = OccluderMesh::new(&half, &triangles, DMat4::IDENTITY);
    let receivers: Vec<Receiver> = (-10..=10).map(|step| on_floor(0.2 * f64::from(step), 0.1)).collect();
    let [whole, cut, left] = [whole, cut, left].map(|sheet| {
        let occluders = Occluders::new(&[floor.clone(), sheet]).expect("the scene is finite");
        let answers = trace(&occluders, &LAMP, &receivers, &TraceOptions::default(), &|_| ()).expect("all is good");
        answers.iter().map(|answer| answer.mean).collect::<Vec<_>>()
    });
    assert_ne!(whole, left);
    for ((cut, left), receiver) in cut.iter().zip(&left).zip(&receivers) {
        // The rays are those of another number of samples where a point needs fewer.
        assert!((cut - left).abs() < 0.02, "{}: {cut} through a hole, {left} beside a sheet", receiver.position);
    }
}

#[test]
fn coincident_faces_neither_shadow_each_other_nor_break_the_tree() {
    let floors = vec![OccluderMesh::new(&FLOOR, &FACE, DMat4::IDENTITY); 20_000];
    let occluders = Occluders::new(&floors).expect("copies are faces too");
    let receiver = on_floor(0.0, 0.0);
    let answer = trace(&occluders, &LAMP, &[receiver], &TraceOptions::default(), &|_| ()).expect("all is good")[0];
    assert_eq!(answer.mean, 1.0);
}

#[test]
fn without_faces_there_is_nothing_to_ask() {
    let occluders = Occluders::new(&[]).expect("an empty scene is a scene");
    let nothing = trace(&occluders, &LAMP, &[], &TraceOptions::default(), &|_| ());
    assert_eq!(nothing, Ok(vec![]));
    let error = trace(&occluders, &LAMP, &[on_floor(0.0, 0.0)], &TraceOptions::default(), &|_| ());
    assert_eq!(error, Err(TraceError::NoSuchFace { receiver: 0, face: 0, faces: 0 }));
}

#[test]
fn bad_meshes_have_their_errors() {
    let build = |positions: &[[f32; 3]], triangles: &[[u32; 3]], world_from_object| {
        let good = OccluderMesh::new(&FLOOR, &FACE, DMat4::IDENTITY);
        Occluders::new(&[good, OccluderMesh::new(positions, triangles, world_from_object)]).err()
    };
    let no_vertex = OccluderError::NoSuchVertex { mesh: 1, triangle: 1, vertex: 3, vertices: 3 };
    assert_eq!(build(&FLOOR, &[[0, 1, 2], [0, 1, 3]], DMat4::IDENTITY), Some(no_vertex));

    let mut hole = FLOOR;
    hole[1][2] = f32::NAN;
    let found = build(&hole, &FACE, DMat4::IDENTITY);
    assert!(matches!(found, Some(OccluderError::NotFinite { mesh: 1, vertex: 1, .. })), "{found:?}");
    let found = build(&FLOOR, &FACE, DMat4::from_translation(DVec3::X * f64::INFINITY));
    assert!(matches!(found, Some(OccluderError::NotFinite { mesh: 1, vertex: 0, .. })), "{found:?}");
    assert_eq!(build(&hole, &[[0, 2, 0]], DMat4::IDENTITY), None, "a vertex that no face names does no harm");
}

#[test]
fn bad_receivers_have_their_errors() {
    let good = on_floor(0.0, 0.0);
    let error = |receiver| ask(&LAMP, &[good, receiver]).err();
    assert_eq!(error(good), None);
    let no_face = Receiver { face: 3, ..good };
    assert_eq!(error(no_face), Some(TraceError::NoSuchFace { receiver: 1, face: 3, faces: 3 }));
    let flat = Receiver { face: 2, ..good };
    assert_eq!(error(flat), Some(TraceError::FaceWithoutArea { receiver: 1, face: 2 }));
    let lost = Receiver { position: DVec3::new(0.0, f64::NAN, 0.0), ..good };
    assert!(matches!(error(lost), Some(TraceError::ReceiverNotFinite { receiver: 1, .. })));
    // On the other mesh by its number, on the floor by its position.
    let other = Receiver { face: 1, ..good };
    assert!(matches!(error(other), Some(TraceError::OffFace { receiver: 1, face: 1, distance, .. }) if distance > 1.9));
}

/// A raster pass that sees a face from its edge may show a point a little past it.
#[test]
fn receivers_may_lie_a_little_past_their_edge() {
    let at = |past: f64| ask(&LAMP, &[on_floor(0.0, -9.0 - past)]);
    assert!(at(0.3).is_ok());
    assert!(matches!(at(2.0), Err(TraceError::OffFace { .. })));
    let above = Receiver { position: DVec3::Y * 0.3, ..on_floor(0.0, 0.0) };
    assert!(matches!(ask(&LAMP, &[above]), Err(TraceError::OffFace { .. })));
}

#[test]
fn bad_lights_and_options_have_their_errors() {
    let light = LightShape::Sphere { center: DVec3::Y, radius: -1.0 };
    assert!(matches!(ask(&light, &[]), Err(TraceError::Light { field: "radius", .. })));
    let options = TraceOptions { replicates: 1, ..Default::default() };
    let answer = trace(&scene(), &LAMP, &[], &options, &|_| ());
    assert!(matches!(answer, Err(TraceError::Options { field: "replicates", .. })));
}
