//! The passes that fill silhouette maps, each alone over a shadow map that hides a part of the silhouettes, are as the
//! definition says, in views of all kinds of light; and with a fault in their text they are not.

use std::f64::consts::TAU;
use std::sync::Arc;

use bytemuck::cast_slice;
use contrejour_gpu::passes::{self, MapPass};
use contrejour_layout::{Caster, FaceNeighbours};
use contrejour_mesh::{
    BuildOptions, TamForm, TamOptions, TamPrecision, TamStream, TopologyAwareMesh, edge_fans, face_neighbours,
};
use contrejour_plan::{Light, LightKind, NearOne, Pass, SilhouetteSource, StreamPrecision, View, views};
use contrejour_scene::shapes::Shape;
use contrejour_tests::chain::Chain;
use contrejour_tests::frame::{Frame, GAP};
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::lights::{IN_PLANES_OF_FACES, cascades, direction, lamps, lights, widened};
use contrejour_tests::map_run::MapRun;
use contrejour_tests::meshes::{self, TestMesh, TestPart};
use contrejour_tests::planted::{Replaced, check_each_is_found};
use contrejour_tests::silhouette_texels::{Definition, Expected};
use glam::{DMat4, DVec3};
use libtest_mimic::Trial;

use crate::silhouette_doubts::near_doubtful_edges;
use crate::silhouette_maps::{Counts, compare, map_of, settings};

const MAP_SIZE: u32 = 128;

const STREAM: SilhouetteSource = SilhouetteSource::Stream(StreamPrecision::Bits32);
const HALF_STREAM: SilhouetteSource = SilhouetteSource::Stream(StreamPrecision::Bits16);

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial(
            "silhouette_passes::as_defined_in_views_of_lamps_and_cascades",
            as_defined_in_views_of_lamps_and_cascades,
        ),
        gpu_trial("silhouette_passes::faults_of_the_one_from_quads_are_found", |gpu| {
            faults_are_found(gpu, SilhouetteSource::Stages, &[FAULTS, FAULTS_FROM_QUADS].concat())
        }),
        gpu_trial("silhouette_passes::faults_of_the_one_from_faces_are_found", |gpu| {
            faults_are_found(gpu, SilhouetteSource::Faces, &[FAULTS, FAULTS_FROM_FACES].concat())
        }),
        gpu_trial("silhouette_passes::faults_of_the_one_from_a_stream_are_found", |gpu| {
            faults_are_found(gpu, STREAM, &[FAULTS, FAULTS_FROM_A_STREAM].concat())
        }),
        gpu_trial("silhouette_passes::faults_of_the_one_from_halves_are_found", |gpu| {
            faults_are_found(gpu, HALF_STREAM, FAULTS_FROM_HALVES)
        }),
        gpu_trial("silhouette_passes::faces_seen_edge_on_leave_no_hole", faces_seen_edge_on_leave_no_hole),
    ]
}

const FAULTS: &[Replaced] = &[
    ("select(distance, -distance, across > 0.0)", "distance"),
    ("widening(leaning(ndc), across_way)", "1.0"),
    ("return point.is_in_band && is_unhidden(point);", "return is_unhidden(point);"),
    ("return point.is_in_band && is_unhidden(point);", "return point.is_in_band;"),
    ("return point.order / (1.0 + point.order);", "return 0.5;"),
    ("const JUST_OUTSIDE_TEXELS = 1.0;", "const JUST_OUTSIDE_TEXELS = -1.0;"),
];

const FAULTS_FROM_QUADS: &[Replaced] = &[
    ("min(share, max(-sine, 0.0) / cosine)", "0.0"),
    ("max(-sine, 0.0)", "max(sine, 0.0)"),
    ("cosine > abs(sine)", "true"),
    ("> (deepest + bias) * (1.0 + ROUNDING)", "> 0.9 * deepest"),
    ("beyond * onwards + width * across", "beyond * onwards + 0.5 * width * across"),
];

const FAULTS_FROM_FACES: &[Replaced] = &[
    ("(is_lit == faces_light(caster, clip_from_object, face_across)) == is_along", "is_along"),
    ("select(counter_clockwise(direction), clockwise(direction), blocker_left)", "clockwise(direction)"),
    ("sides.x == 0u || sides.y == 0u", "sides.x != sides.y"),
    ("blocker_left = sides.y == 0u;", "blocker_left = sides.x == 0u;"),
    ("select(0u, 1u, is_lit == is_along)", "select(0u, 1u, is_lit)"),
    ("(inradius + reach) / inradius", "(inradius + 0.5 * reach) / inradius"),
    ("2.0 * size * vec2f(", "size * vec2f("),
    ("point.order < (*nearest).order", "false"),
];

const FAULTS_FROM_A_STREAM: &[Replaced] = &[
    ("is_lit != is_lit_at(facing(clip_from_object, image_from_normal, corners[i], across))", "is_lit"),
    ("length_squared > 0.0 && ", ""),
    ("const UNLIT_ABOVE = 2.0;", "const UNLIT_ABOVE = 64.0;"),
    ("corners[widest.index], normal)", "corners[widest.index], -normal)"),
    ("let across = vectors[3u + i];", "let across = vectors[3u + (i + 1u) % 3u];"),
    ("cross(near[1], near[2]), cross(near[2], near[0])", "cross(near[2], near[0]), cross(near[1], near[2])"),
    ("is_lit == runs_up);", "is_lit);"),
    ("(inradius + reach) / inradius", "(inradius + 0.5 * reach) / inradius"),
    ("3u * i;", "3u * (i ^ 1u);"),
];

const FAULTS_FROM_HALVES: &[Replaced] = &[
    ("HALF_STREAM_FACE_WORDS * index + 3u * pair", "STREAM_FACE_WORDS * index + 3u * pair"),
    ("vec3f(first, middle.x)", "vec3f(first, middle.y)"),
    ("vec3f(middle.y, last)", "vec3f(last, middle.y)"),
];

const WITH_A_LONGEST_SIDE: Replaced = ("squares.x >= max(squares.y, squares.z)", "true");

/// What keeps outlines closed where light is in the plane of faces.
const FAULTS_OF_FACES_SEEN_EDGE_ON: [(SilhouetteSource, &[Replaced]); 3] = [
    (SilhouetteSource::Faces, &[("const EDGE_ON = 1e-6;", "const EDGE_ON = 0.0;"), WITH_A_LONGEST_SIDE]),
    (STREAM, &[("const EDGE_ON = 1e-6;", "const EDGE_ON = 0.0;"), WITH_A_LONGEST_SIDE]),
    (HALF_STREAM, &[("const EDGE_ON = 0.001;", "const EDGE_ON = 0.0;")]),
];

/// Of the silhouettes.
#[derive(Clone, Copy, PartialEq)]
enum Hidden {
    /// The deeper half, here and there.
    Half,
    Nothing,
}

/// A mesh under a light, ready to be drawn, and what is to be drawn.
struct Case {
    mesh: TestMesh,
    view: View,
    hidden: Hidden,
    frame: Frame,
    neighbours: Vec<FaceNeighbours>,
    fans: Vec<u32>,
    stream: Vec<u8>,
    half_stream: Vec<u8>,
    shadow_depth: Vec<f32>,
    expected: Vec<Expected>,
}

fn as_defined_in_views_of_lamps_and_cascades(gpu: &Gpu) -> Outcome {
    let chain = Chain::new(gpu, "write_draw_args");
    let runs = [SilhouetteSource::Stages, SilhouetteSource::Faces, STREAM]
        .map(|source| (source, run_of(gpu, source, pass_of(source).wgsl)));
    for mesh in meshes::shapes() {
        let of_lamps = lamps(&mesh).into_iter().flat_map(|lamp| views(&widened(&lamp)).unwrap_or_default());
        for view in of_lamps.chain(cascades(&mesh)) {
            let case = Case::new(&chain, &mesh, view, Hidden::Half);
            for (source, run) in &runs {
                case.check(gpu, run, *source).map_err(|difference| format!("{source:?}: {difference}"))?;
            }
        }
    }
    Ok(())
}

fn faults_are_found(gpu: &Gpu, source: SilhouetteSource, faults: &[Replaced]) -> Outcome {
    let chain = Chain::new(gpu, "write_draw_args");
    let mut cases = Vec::new();
    let shapes = meshes::shapes().into_iter();
    let chosen = shapes.filter(|mesh| ["knot", "fence", "elephant", "box"].contains(&&*mesh.name));
    for mesh in chosen.chain([pinwheel(), book([1.8, 1.9, 2.0, 2.1]), book([0.3, 1.4, 2.2, 4.0])]) {
        let mesh = if source == HALF_STREAM { of_halves(&mesh) } else { mesh };
        let all = lights(&mesh);
        for light in [&all[0], &all[8], &lamps(&mesh)[1]] {
            let views = views(&widened(light)).map_err(|error| error.to_string())?;
            cases.extend(views.into_iter().map(|view| Case::new(&chain, &mesh, view, Hidden::Half)));
        }
    }
    check_faults(gpu, source, &cases, faults)
}

/// Where a light is in the plane of faces, one of their edges has the silhouette, and which does not matter where nothing is
/// hidden; but one must.
fn faces_seen_edge_on_leave_no_hole(gpu: &Gpu) -> Outcome {
    let chain = Chain::new(gpu, "write_draw_args");
    for (source, faults) in FAULTS_OF_FACES_SEEN_EDGE_ON {
        let mut cases = Vec::new();
        let mut add = |mesh: &TestMesh, light: &Light| {
            let view = views(light).map_err(|error| error.to_string())?[0];
            cases.push(Case::new(&chain, mesh, view, Hidden::Nothing));
            Outcome::Ok(())
        };
        for mesh in meshes::shapes().into_iter().flat_map(|mesh| TURNS.map(|angle| turned(&mesh, angle))) {
            let mesh = if source == HALF_STREAM { of_halves(&mesh) } else { mesh };
            in_planes_of_faces(&mesh).iter().try_for_each(|light| add(&mesh, light))?;
        }
        if source != HALF_STREAM {
            let column = column();
            lights(&column)[..8].iter().try_for_each(|light| add(&column, light))?;
        }
        check_faults(gpu, source, &cases, faults)?;
    }
    Ok(())
}

/// A column of slivers, whose normals a stream knows better than they follow from their corners; one is always seen nearly
/// edge-on.
fn column() -> TestMesh {
    let shape = Shape::Cylinder { radius: 0.5, height: 4.0, segments: 2000 };
    let mesh = shape.generate().expect("a good cylinder");
    TestMesh::generated("column", &mesh.positions, &mesh.triangles)
}

/// Lights in the planes of faces, some along their sides; none so near that they see the roundings of a mesh's positions.
fn in_planes_of_faces(mesh: &TestMesh) -> Vec<Light> {
    let all = lights(mesh);
    let (middle, radius) = mesh.middle_and_radius();
    let corners: Vec<_> = mesh.corners_world().collect();
    let is_apart = |light: &Light| match light.kind {
        LightKind::Spot { position, .. } => corners.iter().all(|corner| corner.distance(position) > 0.1 * radius),
        _ => true,
    };
    let along_sides = (0..3).map(|side| direction(corners[side] - corners[(side + 1) % 3], middle, radius));
    IN_PLANES_OF_FACES.into_iter().map(|index| all[index]).filter(is_apart).chain(along_sides).collect()
}

/// About an axis that is none of the world's, in radians.
const TURNS: [f64; 4] = [0.0, 0.7, 1.4, 2.1];

fn turned(mesh: &TestMesh, angle: f64) -> TestMesh {
    let turn = DMat4::from_axis_angle(DVec3::new(0.3, 0.8, -0.4).normalize(), angle);
    let mut turned = mesh.clone();
    turned.parts.iter_mut().for_each(|part| part.world_from_object = turn * part.world_from_object);
    turned
}

fn check_faults(gpu: &Gpu, source: SilhouetteSource, cases: &[Case], faults: &[Replaced]) -> Outcome {
    let check = |wgsl: &str| {
        let run = run_of(gpu, source, wgsl);
        cases.iter().try_for_each(|case| case.check(gpu, &run, source))
    };
    let wgsl = pass_of(source).wgsl;
    check(wgsl)?;
    check_each_is_found(wgsl, faults, check)
}

/// The mesh with positions that 16-bit floats hold, so that a stream of those rounds normals alone.
fn of_halves(mesh: &TestMesh) -> TestMesh {
    // Positions near 1 have 10 bits behind the point.
    const STEP: f64 = 1.0 / 512.0;
    let mut mesh = mesh.clone();
    for part in &mut mesh.parts {
        let near_one = NearOne::of_box(part.topology.bounds_min, part.topology.bounds_max);
        let step = STEP / f64::from(near_one.scale);
        let rounded = |coordinate: f32| ((f64::from(coordinate) / step).round() * step) as f32;
        let positions: Vec<_> = part.topology.positions.iter().map(|position| position.map(rounded)).collect();
        let built = TopologyAwareMesh::build(&positions, &part.triangles, &BuildOptions::default());
        part.topology = Arc::new(built.expect("rounded positions are finite"));
    }
    mesh
}

/// Blades that share a vertex, where six outline edges meet.
fn pinwheel() -> TestMesh {
    let on_circle = |step: u32| {
        let angle = TAU * f64::from(step) / 6.0;
        DVec3::new(angle.cos(), 0.1 * angle.sin(), angle.sin()).as_vec3().to_array()
    };
    let positions: Vec<[f32; 3]> = std::iter::once([0.0; 3]).chain((0..6).map(on_circle)).collect();
    TestMesh::generated("pinwheel", &positions, &[[0, 2, 1], [0, 4, 3], [0, 6, 5]])
}

/// Pages at these angles that share an edge, two wound one way and two the other.
fn book(angles: [f64; 4]) -> TestMesh {
    let page = |angle: f64| DVec3::new(angle.cos(), 0.5, angle.sin()).as_vec3().to_array();
    let pages = angles.map(page);
    let positions: Vec<[f32; 3]> = [[0.0; 3], [0.0, 1.0, 0.0]].into_iter().chain(pages).collect();
    TestMesh::generated("book", &positions, &[[0, 1, 2], [1, 0, 3], [0, 1, 4], [1, 0, 5]])
}

fn run_of(gpu: &Gpu, source: SilhouetteSource, wgsl: &str) -> MapRun {
    MapRun::new(gpu, wgsl, pass_of(source).pass.name(), entry_points(source))
}

fn pass_of(source: SilhouetteSource) -> &'static MapPass {
    let pass = match source {
        SilhouetteSource::Stages => Pass::SilhouetteMap,
        SilhouetteSource::Faces => Pass::SilhouetteMapTam,
        SilhouetteSource::Stream(StreamPrecision::Bits32) => Pass::SilhouetteMapStream,
        SilhouetteSource::Stream(StreamPrecision::Bits16) => Pass::SilhouetteMapHalfStream,
    };
    passes::ALL.iter().find(|known| known.pass == pass).expect("the library lists it")
}

fn entry_points(source: SilhouetteSource) -> [&'static str; 2] {
    match source {
        SilhouetteSource::Stages => ["vertex_silhouette_quad", "fragment_silhouette_quad"],
        SilhouetteSource::Faces => ["vertex_silhouette_face", "fragment_silhouette_face"],
        SilhouetteSource::Stream(_) => ["vertex_silhouette_stream", "fragment_silhouette_face"],
    }
}

impl Case {
    fn new(chain: &Chain<'_>, mesh: &TestMesh, view: View, hidden: Hidden) -> Self {
        let mut frame = Frame::of_view(&mesh.parts, &view, &settings(SilhouetteSource::Stages, MAP_SIZE));
        chain.run(&mut frame);
        // As the faces lie: each part's behind a gap.
        let gap = FaceNeighbours { across_ab: u32::MAX, across_bc: u32::MAX, across_ca: u32::MAX };
        let neighbours =
            mesh.parts.iter().flat_map(|part| [vec![gap], face_neighbours(&part.topology)].concat()).collect();
        let fans = mesh.parts.iter().flat_map(|part| [GAP.to_vec(), edge_fans(&part.topology)].concat()).collect();
        let [stream, half_stream] =
            [TamPrecision::Full, TamPrecision::Half].map(|precision| stream_of(mesh, &frame, precision));
        let quads = frame.made_quads();
        let shadow_depth = match hidden {
            Hidden::Half => hiding_half(quads.iter().map(|quad| depth_of_q(&frame, quad.q[0])).collect(), &view),
            Hidden::Nothing => vec![view.far_depth as f32; (MAP_SIZE * MAP_SIZE) as usize],
        };
        let expected = Definition { record: frame.view(), shadow_depth: &shadow_depth }.texels(quads);
        Self { mesh: mesh.clone(), view, hidden, neighbours, fans, stream, half_stream, shadow_depth, expected, frame }
    }

    fn check(&self, gpu: &Gpu, run: &MapRun, source: SilhouetteSource) -> Outcome {
        let Self { view, frame, .. } = self;
        let vertices = frame.draw_args[usize::from(source == SilhouetteSource::Stages)].vertex_count;
        let bytes = |name: &str| match name {
            "face_neighbours" => cast_slice(&self.neighbours),
            "edge_fans" => cast_slice(&self.fans),
            "stream_faces" if source == SilhouetteSource::Stream(StreamPrecision::Bits16) => &self.half_stream,
            "stream_faces" => &self.stream,
            _ => frame.bytes(name),
        };
        let floats = run.run(gpu, bytes, &self.shadow_depth, view.far_depth, vertices);
        let map = map_of(&floats, view);
        let doubtful = || {
            let doubtful = near_doubtful_edges(&self.mesh, view, source, MAP_SIZE);
            if self.hidden == Hidden::Nothing { doubtful } else { doubtful.or_hidden() }
        };
        compare(&map, &self.expected, view.far_depth, doubtful, &mut Counts::default())
            .map_err(|difference| format!("{} {source:?}: {difference}", self.mesh.name))
    }
}

/// As the faces lie, from positions as the matrices expect them.
fn stream_of(mesh: &TestMesh, frame: &Frame, precision: TamPrecision) -> Vec<u8> {
    let gap = vec![0x55; TamForm::Faces.face_bytes(precision)];
    let of_part = |(part, caster): (&TestPart, &Caster)| {
        let options = TamOptions { origin: caster.position_origin, scale: caster.position_scale };
        let stream = TamStream::new(&part.topology, &options);
        let records = stream.records_in_place(0..part.topology.faces.len() as u32, precision);
        [gap.clone(), records.expect("positions near 1 fit")].concat()
    };
    mesh.parts.iter().zip(&frame.casters).flat_map(of_part).collect()
}

/// A shadow map of blocks that show nothing and blocks that hide the deeper half of what is this deep.
fn hiding_half(mut depths: Vec<f32>, view: &View) -> Vec<f32> {
    const BLOCK: u32 = 8;
    depths.sort_by(f32::total_cmp);
    let middle = depths.get(depths.len() / 2).copied().unwrap_or_default();
    let texels = (0..MAP_SIZE * MAP_SIZE).map(|index| [index % MAP_SIZE, index / MAP_SIZE]);
    let is_empty = |[column, row]: [u32; 2]| (column / BLOCK + row / BLOCK).is_multiple_of(2);
    texels.map(|texel| if is_empty(texel) { view.far_depth as f32 } else { middle }).collect()
}

fn depth_of_q(frame: &Frame, q: f32) -> f32 {
    if frame.view().perspective == 1 { -1.0 / q } else { q }
}
