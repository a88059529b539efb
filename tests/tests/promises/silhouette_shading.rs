//! What the visibility function makes of silhouette maps is as geometry says: the edge of a disk's shadow, thin sheets,
//! shadows within each other, faces at their own silhouettes; and with a fault in its text it is not.

use contrejour_gpu::ShadowOptions;
use contrejour_plan::{EdgeProfile, Light, LightKind, ShadowSettings, SilhouetteMapSettings, Technique};
use contrejour_tests::ask::{Point, visibility_at};
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::meshes::TestMesh;
use contrejour_tests::pipeline::Pipeline;
use contrejour_tests::planted::Replaced;
use glam::DVec3;
use libtest_mimic::Trial;

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("silhouette_shading::soft_edges_are_those_of_a_disk", soft_edges_are_those_of_a_disk),
        gpu_trial("silhouette_shading::even_edges_go_evenly", even_edges_go_evenly),
        gpu_trial("silhouette_shading::a_thin_sheet_has_two_edges", a_thin_sheet_has_two_edges),
        gpu_trial("silhouette_shading::a_shadow_within_another_has_no_edge", a_shadow_within_another_has_no_edge),
        gpu_trial("silhouette_shading::a_lit_face_has_no_dark_rim", a_lit_face_has_no_dark_rim),
    ]
}

/// A lamp over a floor: its height and the radius of its disk.
const LAMP: f64 = 6.0;
const LAMP_RADIUS: f64 = 0.3;

/// Half the side of a sheet, and its height.
const SHEET: f64 = 0.6;
const SHEET_HEIGHT: f64 = 1.5;

/// Visibility differs by less from that of a disk behind a straight edge, looked up once.
const VISIBILITY_ERROR: f64 = 0.02;

/// The same, looked up at several places, whose disks together are not quite one.
const SAMPLED_VISIBILITY_ERROR: f64 = 0.04;

/// Visibility past a thin sheet differs by less.
const THIN_VISIBILITY_ERROR: f64 = 0.08;

const MAP_SIZE: u32 = 512;

fn lamp() -> Light {
    let kind = LightKind::Spot {
        position: LAMP * DVec3::Y,
        target: DVec3::ZERO,
        cone_angle: 0.9,
        radius: LAMP_RADIUS,
        near: 1.0,
        far: 8.0,
    };
    Light { kind, color: [1.0; 3] }
}

/// A sheet across the light's axis.
struct Sheet {
    /// Half its sides along x and z.
    half: [f64; 2],
    height: f64,
    /// Along x.
    middle: f64,
}

const SQUARE_SHEET: Sheet = Sheet { half: [SHEET; 2], height: SHEET_HEIGHT, middle: 0.0 };
const FLOOR: Sheet = Sheet { half: [2.5; 2], height: 0.0, middle: 0.0 };

/// Sheets; then a turned one, which the lamp sees from aside.
fn sheets(of: &[Sheet], turned: bool) -> TestMesh {
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    let mut push = |corners: [DVec3; 4]| {
        let first = positions.len() as u32;
        positions.extend(corners.map(|corner| corner.as_vec3().to_array()));
        triangles.extend([[0, 1, 2], [0, 2, 3]].map(|face| face.map(|vertex| first + vertex)));
    };
    let corners = |[x, z]: [f64; 2]| [[-x, -z], [-x, z], [x, z], [x, -z]];
    for &Sheet { half, height, middle } in of {
        push(corners(half).map(|[x, z]| DVec3::new(middle + x, height, z)));
    }
    if turned {
        push(corners([SHEET; 2]).map(|[x, z]| on_turned(x, z)));
    }
    TestMesh::generated("sheets", &positions, &triangles)
}

/// A point of the turned sheet.
fn on_turned(x: f64, z: f64) -> DVec3 {
    DVec3::new(x * TURN.cos(), SHEET_HEIGHT + x * TURN.sin(), z)
}

const TURN: f64 = 0.9;

/// What a light with a silhouette map says of points that it looks up at so many places, with a fault in its function where
/// one is given.
fn asked(
    gpu: &Gpu,
    mesh: &TestMesh,
    points: &[Point],
    samples: u32,
    fault: Option<Replaced>,
) -> Result<Vec<f64>, String> {
    asked_by(gpu, mesh, points, SilhouetteMapSettings { samples, ..Default::default() }, fault)
}

fn asked_by(
    gpu: &Gpu,
    mesh: &TestMesh,
    points: &[Point],
    tuned: SilhouetteMapSettings,
    fault: Option<Replaced>,
) -> Result<Vec<f64>, String> {
    let technique = Technique::SilhouetteMap(tuned);
    let settings = ShadowSettings { technique, map_size: MAP_SIZE, ..Default::default() };
    let mut pipeline = Pipeline::new(gpu, mesh, &ShadowOptions { settings, ..Default::default() })?;
    pipeline.complete_frame(&lamp())?;
    let found = visibility_at(gpu, &pipeline.shadows, pipeline.light(), points, fault);
    Ok(found.into_iter().map(f64::from).collect())
}

fn expect_near(found: &[f64], most: f64, expected: impl Fn(usize) -> f64) -> Outcome {
    for (index, found) in found.iter().enumerate() {
        let expected = expected(index);
        // Positive, so that NaN is far.
        if (found - expected).abs() <= most {
            continue;
        }
        return Err(format!("point {index}: {found}, and not {expected}"));
    }
    Ok(())
}

/// Half as wide as the penumbra of the sheet is on the floor.
const HALF_PENUMBRA: f64 = LAMP_RADIUS * SHEET_HEIGHT / (LAMP - SHEET_HEIGHT);

/// Where the lamp's middle casts a place of the sheet on the floor.
fn on_floor(along: f64) -> f64 {
    along * LAMP / (LAMP - SHEET_HEIGHT)
}

/// Points of the floor from the umbra to full light, and where they are across the penumbra: from -1 to 1.
fn across_penumbra() -> (Vec<Point>, Vec<f64>) {
    let place = |step: u32| f64::from(step % 61) / 20.0 - 1.5;
    let point = |step: u32| {
        let x = on_floor(SHEET) + HALF_PENUMBRA * place(step);
        Point { position: DVec3::new(x, 0.0, 0.1 * f64::from(step / 61) - 0.2), normal: DVec3::Y }
    };
    (0..61 * 5).map(|step| (point(step), place(step))).unzip()
}

/// The part of a disk of radius 1 on one side of a line at this distance from its middle.
fn share_of_disk(place: f64) -> f64 {
    let place = place.clamp(-1.0, 1.0);
    0.5 + (place * (1.0 - place * place).sqrt() + place.asin()) / std::f64::consts::PI
}

fn soft_edges_are_those_of_a_disk(gpu: &Gpu) -> Outcome {
    let mesh = sheets(&[SQUARE_SHEET, FLOOR], false);
    let (points, places) = across_penumbra();
    let check = |samples, most| {
        let (mesh, points, places) = (&mesh, &points, &places);
        move |fault| expect_near(&asked(gpu, mesh, points, samples, fault)?, most, |index| share_of_disk(places[index]))
    };
    check(1, VISIBILITY_ERROR)(None)?;
    check(16, SAMPLED_VISIBILITY_ERROR)(None)?;
    each_is_found(
        check(1, VISIBILITY_ERROR),
        &[
            ("const CONTREJOUR_PROFILE_IS_DISK = true;", "const CONTREJOUR_PROFILE_IS_DISK = false;"),
            ("select(-distance, distance, is_behind)", "-distance"),
            ("max(share * radius", "max(0.5 * share * radius"),
            ("nearest <= deepest", "nearest <= 0.9 * depth"),
            ("max(edge.signed_distance + outside_by, 0.0)", "max(edge.signed_distance, 0.0)"),
        ],
    )?;
    let found = check(16, SAMPLED_VISIBILITY_ERROR);
    each_is_found(found, &[("sqrt(1.0 - CONTREJOUR_SHARE * CONTREJOUR_SHARE)", "1.0 - CONTREJOUR_SHARE")])
}

fn even_edges_go_evenly(gpu: &Gpu) -> Outcome {
    let mesh = sheets(&[SQUARE_SHEET, FLOOR], false);
    let (points, places) = across_penumbra();
    let even = SilhouetteMapSettings { samples: 1, profile: EdgeProfile::Linear, ..Default::default() };
    let evenly = |index: usize| 0.5 + 0.5 * places[index].clamp(-1.0, 1.0);
    let check = |tuned| expect_near(&asked_by(gpu, &mesh, &points, tuned, None)?, VISIBILITY_ERROR, evenly);
    check(even)?;
    match check(SilhouetteMapSettings { profile: EdgeProfile::Disk, ..even }) {
        Ok(()) => Err("the edge of a disk goes evenly".into()),
        Err(_) => Ok(()),
    }
}

/// What is thinner than its penumbra leaves light on both sides, which several places see and one does not.
fn a_thin_sheet_has_two_edges(gpu: &Gpu) -> Outcome {
    let half = 0.04;
    let mesh = sheets(&[Sheet { half: [half, 1.0], ..SQUARE_SHEET }, FLOOR], false);
    let places: Vec<f64> = (0..60).map(|step| 0.004 * f64::from(step)).collect();
    let points: Vec<_> =
        places.iter().map(|x| Point { position: DVec3::new(*x, 0.0, 0.01), normal: DVec3::Y }).collect();
    let visible = |index: usize| {
        let [right, left] = [1.0, -1.0].map(|side| (places[index] + side * on_floor(half)) / HALF_PENUMBRA);
        1.0 - (share_of_disk(right) - share_of_disk(left))
    };
    let check = |samples| expect_near(&asked(gpu, &mesh, &points, samples, None)?, THIN_VISIBILITY_ERROR, visible);
    check(16)?;
    if check(1).is_ok() { Err("one place sees both edges".to_owned()) } else { Ok(()) }
}

fn a_shadow_within_another_has_no_edge(gpu: &Gpu) -> Outcome {
    let mesh = sheets(&[SQUARE_SHEET, Sheet { half: [0.9; 2], height: 0.7, middle: 1.2 }, FLOOR], false);
    let (points, _) = across_penumbra();
    let check = |fault| expect_near(&asked(gpu, &mesh, &points, 1, fault)?, VISIBILITY_ERROR, |_| 0.0);
    check(None)?;
    each_is_found(check, &[("select(0.0, past_edge, is_lit)", "past_edge")])
}

fn a_lit_face_has_no_dark_rim(gpu: &Gpu) -> Outcome {
    let mesh = sheets(&[FLOOR], true);
    let normal = DVec3::new(-TURN.sin(), TURN.cos(), 0.0);
    let along = |step: u32| SHEET * (1.0 - 2e-4 * f64::from(step));
    let point = |step: u32| Point { position: on_turned(along(step), 0.05), normal };
    let points: Vec<_> = (1..200).map(point).collect();
    let check = |fault| expect_near(&asked(gpu, &mesh, &points, 1, fault)?, VISIBILITY_ERROR, |_| 1.0);
    check(None)?;
    each_is_found(check, &[("!is_lit & (nearest <= deepest)", "nearest <= deepest")])
}

fn each_is_found(check: impl Fn(Option<Replaced>) -> Outcome, faults: &[Replaced]) -> Outcome {
    match faults.iter().find(|fault| check(Some(**fault)).is_ok()) {
        Some((piece, fault)) => Err(format!("not found: {piece:?} is {fault:?}")),
        None => Ok(()),
    }
}
