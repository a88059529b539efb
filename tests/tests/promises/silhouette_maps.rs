//! Silhouette maps are as defined, and all sources leave the same one: the compute stages, which are exact, and the vertex
//! stage, as topology-aware meshes do it, by what is across the edges of faces or by a stream of normals.
//!
//! For every mesh under eight lights, two of them wide, each texel holds depth and signed distance of the nearest silhouette that the light
//! reaches, as worked out in 64-bit floats from the stages' quads: the distance up to [`DISTANCE_ROUNDING`], the depth up to
//! [`DEPTH_ROUNDING`]. Two kinds of texels are left open, and counted:
//!
//! - **Ties**, for all sources: silhouettes that are equally far, and those on the brink of where distances are drawn, or as
//!   deep as what hides them. Rounding decides, and each outcome is as good.
//! - **By facing**, for the vertex stage: texels within reach of an edge at a face that the light sees edge-on up to
//!   [`FACING_ROUNDING`], since that stage asks in floats, or of an edge beside faces without area that have no sign, which it
//!   draws whatever the light or not at all. For a stream also of an edge of more than two faces, which it asks in pairs.
//!   [`MOST_BY_FACING`] of a mesh's texels may be such; of a stream's where the mesh has no edge of more than two.

use std::collections::HashSet;

use contrejour_gpu::ShadowOptions;
use contrejour_layout::{INCIDENCE_LIST, LightView, UNLIT_FACE};
use contrejour_mesh::incidence_words;
use contrejour_plan::{
    EdgeProfile, Light, LightKind, ShadowSettings, SilhouetteMapSettings, SilhouetteSource, StreamPrecision, Technique,
    View, ViewCounts, views,
};
use contrejour_tests::ask::{Point, visibility_at};
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, cpu_trial, float_blending_trial, gpu_trial};
use contrejour_tests::lights::{lights, widened};
use contrejour_tests::meshes::{self, TestMesh, TestPart};
use contrejour_tests::pipeline::Pipeline;
use contrejour_tests::planted::Replaced;
use contrejour_tests::silhouette_texels::{Definition, Expected, SilhouetteTexel};
use contrejour_tests::texture::read_floats;
use glam::{DMat4, DVec2, DVec3, DVec4, Vec4Swizzles};
use libtest_mimic::Trial;

const MAP_SIZE: u32 = 128;

/// In texels.
const DISTANCE_ROUNDING: f64 = 2e-3;

/// Of the depth, and of all depths of a view together.
const DEPTH_ROUNDING: [f64; 2] = [1e-4, 1e-6];

/// Sine of the angle at which a face is seen that counts as edge-on.
const FACING_ROUNDING: f64 = 1e-5;

/// The same where normals are stored in 16 bits.
const HALF_FACING_ROUNDING: f64 = 1.0 / 512.0;

/// Of the texels of a mesh that are certain.
const MOST_BY_FACING: f64 = 0.1;

pub fn trials() -> Vec<Trial> {
    let mut trials: Vec<_> = meshes::all()
        .into_iter()
        .map(|mesh| {
            let name = format!("silhouette_maps::as_defined_from_all_sources::{}", mesh.name);
            gpu_trial(name, move |gpu| as_defined_from_all_sources(gpu, &mesh))
        })
        .collect();
    trials.push(float_blending_trial(
        "silhouette_maps::blended_ones_hold_the_least_distance",
        blended_ones_hold_the_least_distance,
    ));
    trials.push(cpu_trial(
        "silhouette_maps::comparer_of_blended_ones_finds_planted_faults",
        comparer_of_blended_ones_finds_planted_faults,
    ));
    trials.push(cpu_trial("silhouette_maps::comparer_finds_planted_faults", comparer_finds_planted_faults));
    trials.push(gpu_trial("silhouette_maps::soft_edges_are_those_of_a_disk", soft_edges_are_those_of_a_disk));
    trials.push(gpu_trial("silhouette_maps::even_edges_go_evenly", even_edges_go_evenly));
    trials.push(gpu_trial("silhouette_maps::a_thin_sheet_has_two_edges", a_thin_sheet_has_two_edges));
    trials.push(gpu_trial("silhouette_maps::a_shadow_within_another_has_no_edge", a_shadow_within_another_has_no_edge));
    trials.push(gpu_trial("silhouette_maps::a_lit_face_has_no_dark_rim", a_lit_face_has_no_dark_rim));
    trials
}

const SOURCES: [SilhouetteSource; 3] =
    [SilhouetteSource::Stages, SilhouetteSource::Faces, SilhouetteSource::Stream(StreamPrecision::Bits32)];

pub type Map = Vec<Option<SilhouetteTexel>>;

/// Texels of each kind.
#[derive(Debug, Default)]
pub struct Counts {
    empty: usize,
    certain: usize,
    ties: usize,
    by_facing: usize,
}

fn as_defined_from_all_sources(gpu: &Gpu, mesh: &TestMesh) -> Outcome {
    let mut drawn = SOURCES.map(|source| Drawn::new(gpu, mesh, settings(source, MAP_SIZE)));
    let all = lights(mesh);
    let mut counts: [Counts; 3] = Default::default();
    let narrow = [0, 8, 12, 13, 26, 30].map(|index| all[index]);
    for light in narrow.into_iter().chain([3, 20].map(|index| widened(&all[index]))) {
        let view = views(&light).map_err(|error| error.to_string())?[0];
        let mut expected = None;
        for ((drawn, counts), source) in drawn.iter_mut().zip(&mut counts).zip(SOURCES) {
            let drawn = drawn.as_mut().map_err(|error| error.clone())?;
            let Some(map) = drawn.map(&light, &view)? else { continue };
            let expected = match &mut expected {
                Some(expected) => &*expected,
                none => none.insert(drawn.definition(&view)?),
            };
            let doubtful = || near_doubtful_edges(mesh, &view, source);
            compare(&map, expected, view.far_depth, doubtful, counts)
                .map_err(|difference| format!("{source:?}, {:?}: {difference}", light.kind))?;
        }
    }
    let [stages, faces, stream] = counts;
    eprintln!("{} faces, {}: stages {stages:?}, faces {faces:?}, stream {stream:?}", mesh.face_count(), mesh.name);
    // Nothing is certain where no face has an area.
    let are_too_many =
        |found: &Counts| stages.certain > 0 && found.by_facing as f64 > MOST_BY_FACING * stages.certain as f64;
    // A stream asks the faces around an edge in pairs.
    let asks_pairs = mesh.parts.iter().flat_map(|part| &part.topology.edges).any(|edge| edge.first == INCIDENCE_LIST);
    if are_too_many(&faces) || (are_too_many(&stream) && !asks_pairs) {
        return Err(format!("too many texels are explained: faces {faces:?}, stream {stream:?}"));
    }
    Ok(())
}

/// A mesh whose silhouettes come from one source.
struct Drawn<'a> {
    gpu: &'a Gpu,
    settings: ShadowSettings,
    pipeline: Pipeline<'a>,
}

pub fn settings(source: SilhouetteSource, map_size: u32) -> ShadowSettings {
    let technique = Technique::SilhouetteMap(SilhouetteMapSettings { source, ..Default::default() });
    ShadowSettings { technique, map_size, ..Default::default() }
}

impl<'a> Drawn<'a> {
    fn new(gpu: &'a Gpu, mesh: &TestMesh, settings: ShadowSettings) -> Result<Self, String> {
        let options = ShadowOptions { settings, ..Default::default() };
        Ok(Self { gpu, settings, pipeline: Pipeline::new(gpu, mesh, &options)? })
    }

    /// The map of a light; `None` where nothing casts.
    fn map(&mut self, light: &Light, view: &View) -> Result<Option<Map>, String> {
        self.pipeline.complete_frame(light)?;
        let Some(texture) = self.pipeline.maps().silhouette_map else { return Ok(None) };
        Ok(Some(map_of(&read_floats(self.gpu, texture), view)))
    }

    /// What the map of the stages' last frame may hold.
    fn definition(&self, view: &View) -> Result<Vec<Expected>, String> {
        let record = view.light_view(&self.settings, &ViewCounts::default());
        let depth = self.pipeline.maps().shadow_depth.ok_or("there is no shadow map")?;
        let shadow_depth = &read_floats(self.gpu, depth);
        Ok(Definition { record: &record, shadow_depth }.texels(&self.pipeline.quads()))
    }
}

/// What the two floats of each texel say.
pub fn map_of(floats: &[f32], view: &View) -> Map {
    let texel = |texel: &[f32]| {
        let [depth, signed_distance] = [texel[0], texel[1]].map(f64::from);
        (texel[0] < view.far_depth as f32).then_some(SilhouetteTexel { depth, signed_distance })
    };
    floats.chunks_exact(2).map(texel).collect()
}

pub fn compare(
    map: &Map,
    expected: &[Expected],
    far_depth: f64,
    doubtful: impl Fn() -> HashSet<usize>,
    counts: &mut Counts,
) -> Outcome {
    if map.len() != expected.len() {
        return Err(format!("{} texels of {}", map.len(), expected.len()));
    }
    let mut near_doubtful = None;
    for (index, (texel, expected)) in map.iter().zip(expected).enumerate() {
        let is_one_of_them = match texel {
            None => !expected.is_certain,
            Some(texel) => expected.candidates.iter().any(|candidate| is_alike(candidate, texel, far_depth)),
        };
        match (is_one_of_them, expected.candidates.len()) {
            (true, 0) => counts.empty += 1,
            (true, 1) if expected.is_certain => counts.certain += 1,
            (true, _) => counts.ties += 1,
            (false, _) if near_doubtful.get_or_insert_with(&doubtful).contains(&index) => counts.by_facing += 1,
            (false, _) => return Err(format!("texel {index}: {texel:?}, and not {expected:?}")),
        }
    }
    Ok(())
}

fn is_alike(one: &SilhouetteTexel, other: &SilhouetteTexel, far_depth: f64) -> bool {
    let depth_rounding = DEPTH_ROUNDING[0] * one.depth.abs() + DEPTH_ROUNDING[1] * far_depth;
    (one.signed_distance - other.signed_distance).abs() <= DISTANCE_ROUNDING
        && (one.depth - other.depth).abs() <= depth_rounding
}

/// The texels within reach of edges that a source may see otherwise than the stages do.
pub fn near_doubtful_edges(mesh: &TestMesh, view: &View, source: SilhouetteSource) -> HashSet<usize> {
    let (facing_rounding, most_faces) = match source {
        SilhouetteSource::Stages => return HashSet::new(),
        SilhouetteSource::Faces => (FACING_ROUNDING, usize::MAX),
        SilhouetteSource::Stream(StreamPrecision::Bits32) => (FACING_ROUNDING, 2),
        SilhouetteSource::Stream(StreamPrecision::Bits16) => (HALF_FACING_ROUNDING, 2),
    };
    let record = view.light_view(&settings(source, MAP_SIZE), &ViewCounts::default());
    let segments = mesh.parts.iter().flat_map(|part| doubtful_edges(part, view, facing_rounding, most_faces));
    segments.flat_map(|segment| near_segment(segment, &record)).collect()
}

/// Clip coordinates of the ends of edges at faces that are seen edge-on up to a rounding, of more faces than a source asks
/// together, or beside faces without area that have no sign.
fn doubtful_edges(part: &TestPart, view: &View, facing_rounding: f64, most_faces: usize) -> Vec<[DVec4; 2]> {
    let mesh = &part.topology;
    let clip_from_object: DMat4 = view.light_clip_from_world * part.world_from_object;
    let position = |vertex: u32| DVec3::from(mesh.positions[vertex as usize].map(f64::from));
    let clip = |vertex: u32| clip_from_object * position(vertex).extend(1.0);
    // Depth is a part of how long a side is: one that the light sees end-on has no direction.
    let near_one = |clip: DVec4| {
        let unit = clip / clip.abs().max_element().max(f64::MIN_POSITIVE);
        DVec3::new(unit.x, unit.y, unit.w)
    };
    let is_edge_on: Vec<bool> = (mesh.faces.iter())
        .map(|face| {
            let side = |vertex: u32| near_one(clip_from_object * (position(vertex) - position(face.a)).extend(0.0));
            near_one(clip(face.a)).dot(side(face.b).cross(side(face.c))).abs() <= facing_rounding
        })
        .collect();
    let is_doubtful = |words: &[u32]| {
        let unlit = words.iter().filter(|word| **word >> 1 == UNLIT_FACE).count();
        // Such an edge is drawn whatever the light, or has no face that draws it.
        let asks_no_face = unlit == words.len() || (words.len() == 2 && unlit > 0);
        asks_no_face
            || words.len() > most_faces
            || words.iter().any(|word| is_edge_on.get((word >> 1) as usize) == Some(&true))
    };
    let candidates = &mesh.edges[..mesh.candidate_edge_count as usize];
    let doubtful = candidates.iter().filter(|edge| is_doubtful(incidence_words(edge, &mesh.incidences)));
    doubtful.map(|edge| [clip(edge.low_vertex), clip(edge.high_vertex)]).collect()
}

/// Texels that are as near to a segment as distances are drawn.
fn near_segment([low, high]: [DVec4; 2], record: &LightView) -> Vec<usize> {
    let side = f64::from(record.map_size);
    // What is in front of the near plane is cut off.
    let [mut begin, mut end] = [low, high];
    if begin.z.max(end.z) < 0.0 {
        return Vec::new();
    }
    if begin.z < 0.0 {
        begin = begin.lerp(end, -begin.z / (end.z - begin.z));
    } else if end.z < 0.0 {
        end = end.lerp(begin, -end.z / (begin.z - end.z));
    }
    let texel = |clip: DVec4| (clip.xy() / clip.w * DVec2::new(0.5, -0.5) + 0.5) * side;
    let [begin, end] = [begin, end].map(texel);
    let reach = 0.5 * side * f64::from(record.reach_ndc) + 1.0;
    let along = end - begin;
    let near = |index: usize| {
        let place = DVec2::new((index % side as usize) as f64 + 0.5, (index / side as usize) as f64 + 0.5);
        let share = ((place - begin).dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        place.distance(begin + share * along) <= reach
    };
    (0..(side * side) as usize).filter(|index| near(*index)).collect()
}

/// Blending leaves the distance of the nearest silhouette, without its side, and a depth that is not more than its depth.
fn blended_ones_hold_the_least_distance(gpu: &Gpu) -> Outcome {
    for mesh in meshes::shapes() {
        let light = &lights(&mesh)[8];
        let view = views(light).map_err(|error| error.to_string())?[0];
        for source in SOURCES {
            let by_depth = settings(source, MAP_SIZE);
            let mut by_blending = by_depth;
            by_blending.technique.set("blending", 1.0).map_err(|error| error.to_string())?;
            let exact = Drawn::new(gpu, &mesh, by_depth)?.map(light, &view)?.ok_or("nothing casts")?;
            let blended = Drawn::new(gpu, &mesh, by_blending)?.map(light, &view)?.ok_or("nothing casts")?;
            compare_blended(&blended, &exact)
                .map_err(|difference| format!("{}, {source:?}: {difference}", mesh.name))?;
        }
    }
    Ok(())
}

fn compare_blended(blended: &Map, exact: &Map) -> Outcome {
    let is_least = |blended: &SilhouetteTexel, exact: &SilhouetteTexel| {
        (blended.signed_distance - exact.signed_distance.abs()).abs() <= DISTANCE_ROUNDING
            && blended.depth <= exact.depth
    };
    for (index, texels) in blended.iter().zip(exact).enumerate() {
        let is_good = match texels {
            (Some(blended), Some(exact)) => is_least(blended, exact),
            (None, None) => true,
            _ => false,
        };
        if !is_good {
            return Err(format!("texel {index}: {texels:?}"));
        }
    }
    Ok(())
}

fn comparer_of_blended_ones_finds_planted_faults() -> Outcome {
    let texel = |depth: f64, signed_distance: f64| Some(SilhouetteTexel { depth, signed_distance });
    let exact: Map = vec![None, texel(2.0, -0.5)];
    compare_blended(&vec![None, texel(1.5, 0.5)], &exact)?;
    let faults = [
        vec![texel(2.0, 0.5), texel(2.0, 0.5)],
        vec![None, None],
        vec![None, texel(2.0, -0.5)],
        vec![None, texel(2.0, 0.6)],
        vec![None, texel(2.1, 0.5)],
        vec![None, texel(f64::NAN, 0.5)],
    ];
    match faults.into_iter().find(|fault| compare_blended(fault, &exact).is_ok()) {
        Some(fault) => Err(format!("not found: {fault:?}")),
        None => Ok(()),
    }
}

fn comparer_finds_planted_faults() -> Outcome {
    let texel = |depth: f64, signed_distance: f64| SilhouetteTexel { depth, signed_distance };
    let one = Expected { candidates: vec![texel(2.0, -0.5)], is_certain: true };
    let two = Expected { candidates: vec![texel(2.0, -0.5), texel(3.0, 0.5)], is_certain: true };
    let brink = Expected { is_certain: false, ..one.clone() };
    let expected = [Expected::default(), one, two, brink];
    let good: Map = vec![None, Some(texel(2.0, -0.5)), Some(texel(3.0, 0.5)), None];
    let compared = |map: &Map, doubtful: &[usize]| {
        compare(map, &expected, 9.0, || doubtful.iter().copied().collect(), &mut Counts::default())
    };
    compared(&good, &[])?;
    let planted = [
        (0, Some(texel(2.0, -0.5))),
        (1, None),
        (1, Some(texel(2.0, 0.5))),
        (1, Some(texel(2.0, -0.51))),
        (1, Some(texel(2.001, -0.5))),
        (1, Some(texel(f64::NAN, -0.5))),
        (2, Some(texel(3.0, -0.5))),
        (2, None),
        (3, Some(texel(2.0, 0.0))),
    ];
    for (index, fault) in planted {
        let mut map = good.clone();
        map[index] = fault;
        if compared(&map, &[]).is_ok() {
            return Err(format!("texel {index}: {fault:?} was not found"));
        }
        compared(&map, &[index]).map_err(|error| format!("near a doubtful edge it may be so: {error}"))?;
    }
    if compared(&good[1..].to_vec(), &[]).is_ok() {
        return Err("a missing texel was not found".into());
    }
    Ok(())
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

const SHADING_MAP_SIZE: u32 = 512;

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
    let settings = ShadowSettings { technique, map_size: SHADING_MAP_SIZE, ..Default::default() };
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
