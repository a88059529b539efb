//! Ten million triangles: more work items than a dispatch has groups along x, and more bytes than a shader sees of one
//! buffer. It takes minutes and some GiB, so it runs when asked for:
//! `cargo test -p contrejour-tests --test promises -- ten_million --ignored --nocapture`.

use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::time::Instant;

use contrejour_gpu::ShadowOptions;
use contrejour_layout::{CORNER_WEDGE, Corner, INCIDENCE_ALONG, MAX_GROUPS_X, SilhouetteEdge};
use contrejour_mesh::{TopologyAwareMesh, incidence_words};
use contrejour_oracle::lit;
use contrejour_plan::{NearOne, ShadowSettings, caster_light, views};
use contrejour_tests::compare::{Record, check_finite, compare_exact, compare_records};
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::lights::point;
use contrejour_tests::meshes::TestMesh;
use contrejour_tests::pipeline::Pipeline;
use contrejour_tests::texture::{read_depth, read_floats, read_half_floats};
use glam::{DMat4, DVec3, Vec2};
use libtest_mimic::Trial;

use crate::closed;

const AROUND: u32 = 2500;
const ACROSS: u32 = 2000;

pub fn trials() -> Vec<Trial> {
    vec![gpu_trial("ten_million::triangles_are_exact_and_whole", are_exact_and_whole).with_ignored_flag(true)]
}

fn are_exact_and_whole(gpu: &Gpu) -> Outcome {
    let clock = Instant::now();
    let say = |what: &str| eprintln!("{:6.1} s: {what}", clock.elapsed().as_secs_f64());
    let mesh = torus();
    let topology = &mesh.parts[0].topology;
    say(&format!("built {} faces, {} edges", topology.faces.len(), topology.edges.len()));
    let light = point(DVec3::new(2.0, 4.0, 1.0), DVec3::ZERO, 1.5);
    let mut pipeline = Pipeline::new(gpu, &mesh, &ShadowOptions::default())?;
    pipeline.frame(&light)?;
    say("the first frame, with its uploads");
    let counters = pipeline.complete_frame(&light)?;
    say(&format!("a complete frame: {counters:?}"));

    let plan = pipeline.plan().ok_or("a prepared frame has a plan")?;
    eprintln!("{plan}");
    let most_items = plan.pages.iter().map(|page| page.counts.edge_blocks).max();
    if plan.pages.len() < 2 || most_items <= Some(MAX_GROUPS_X) {
        return Err(format!("{} pages, at most {most_items:?} work items on one", plan.pages.len()));
    }
    let mut silhouettes = pipeline.silhouettes();
    silhouettes.sort_by_key(|edge| edge.edge_id);
    compare_exact("silhouette edge", &exact_silhouette(topology, &light)?, &silhouettes)?;
    closed::check(topology, &silhouettes)?;
    say(&format!("{} silhouette edges are exact and closed", silhouettes.len()));

    let mut twin = Frame::new(&mesh.parts, &light, &ShadowSettings::default());
    twin.run_mirrors("place_casters", "write_extrude_args");
    compare_records("silhouette edge", &twin.silhouettes[..silhouettes.len()], &silhouettes, 0.0)?;
    twin.run_mirrors("write_extrude_args", "write_draw_args");
    compare_keys("quads", &twin.quads[..twin.counts().quads as usize], &pipeline.quads(), |_| false)?;
    compare_keys("corners", twin.made_corners(), &pipeline.corners(), is_hardly_open)?;
    say("quads and corners are those of the twin");

    let maps = pipeline.maps();
    let (Some(depth), Some(smoothie_depth), Some(alpha)) =
        (maps.shadow_depth, maps.smoothie_depth, maps.smoothie_alpha)
    else {
        return Err("the plan lists no smoothies".into());
    };
    check_finite("shadow depth", &read_floats(gpu, depth))?;
    check_finite("smoothie depth", &read_depth(gpu, smoothie_depth))?;
    check_finite("alpha", &read_half_floats(gpu, alpha))
}

/// A torus around the y axis, radii 1 and 0.4.
fn torus() -> TestMesh {
    let angle = |step: u32, steps: u32| TAU * f64::from(step) / f64::from(steps);
    let mut positions = Vec::with_capacity((AROUND * ACROSS) as usize);
    let mut triangles = Vec::with_capacity(2 * (AROUND * ACROSS) as usize);
    for i in 0..AROUND {
        for j in 0..ACROSS {
            let (ring, tube) = (angle(i, AROUND), angle(j, ACROSS));
            let radius = 1.0 + 0.4 * tube.cos();
            positions.push([radius * ring.cos(), 0.4 * tube.sin(), -radius * ring.sin()].map(|x| x as f32));
            let vertex = |i: u32, j: u32| i % AROUND * ACROSS + j % ACROSS;
            let [a, b, c, d] = [vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
    }
    TestMesh::generated("torus", &positions, &triangles)
}

/// By definition, over the edges that the mesh crate found: no face of the torus is without area.
fn exact_silhouette(mesh: &TopologyAwareMesh, light: &contrejour_plan::Light) -> Result<Vec<SilhouetteEdge>, String> {
    if !mesh.partners.is_empty() {
        return Err("a face has no area".into());
    }
    let view = views(light).map_err(|error| error.to_string())?[0];
    let near_one = NearOne::of_box(mesh.bounds_min, mesh.bounds_max);
    let light = caster_light(&view, &DMat4::IDENTITY, &near_one).light_object.map(f32::from_bits);
    let at = |vertex: u32| mesh.positions[vertex as usize];
    let is_lit: Vec<bool> =
        mesh.faces.iter().map(|face| lit(at(face.a), at(face.b), at(face.c), light, false)).collect();
    let mut silhouette = Vec::new();
    for (edge, edge_id) in mesh.edges.iter().zip(0..) {
        let (mut left, mut right) = (0, 0);
        for word in incidence_words(edge, &mesh.incidences) {
            let along = word & INCIDENCE_ALONG != 0;
            *(if is_lit[(word >> 1) as usize] == along { &mut left } else { &mut right }) += 1;
        }
        if left != right {
            silhouette.push(SilhouetteEdge { caster: 0, edge_id, left, right });
        }
    }
    Ok(silhouette)
}

/// The same records, but for some that rounding may leave out.
fn compare_keys<T: Record>(what: &str, expected: &[T], found: &[T], may_miss: fn(&T) -> bool) -> Outcome {
    let by_key = |records: &[T]| records.iter().map(|record| (record.key(), *record)).collect::<BTreeMap<_, _>>();
    let (expected_by_key, found_by_key) = (by_key(expected), by_key(found));
    if expected_by_key.len() != expected.len() || found_by_key.len() != found.len() {
        return Err(format!("{what}: a key is there twice"));
    }
    let missing = |records: &BTreeMap<[u32; 3], T>, others: &BTreeMap<[u32; 3], T>| {
        records.iter().find(|(key, record)| !others.contains_key(*key) && !may_miss(record)).map(|(key, _)| *key)
    };
    match missing(&expected_by_key, &found_by_key).or(missing(&found_by_key, &expected_by_key)) {
        None => Ok(()),
        Some(key) => Err(format!("{what}: {key:?} is in one list alone")),
    }
}

/// Whether a wedge is so narrow that its two edges may count as one straight line.
fn is_hardly_open(corner: &Corner) -> bool {
    corner.kind == CORNER_WEDGE && Vec2::from(corner.begin).dot(Vec2::from(corner.end)) > 1.0 - 1e-6
}
