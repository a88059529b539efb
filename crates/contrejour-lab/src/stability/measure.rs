//! A case through the whole pipeline, and what the checks say.

use std::hint::black_box;
use std::time::Instant;

use contrejour_layout::{CasterLight, Corner, Quad, SilhouetteEdge};
use contrejour_oracle::{GapSearch, OracleTopology, blocker_image, open_vertices, outline_gaps};
use contrejour_plan::{NearOne, Omitted, Reason, View, object_light, views};
use contrejour_render::Gpu;
use glam::{DVec2, Mat4, Vec3};

use super::case::Case;
use super::checks::{FaceSigns, WidthDefinition, bare_lit, missing_quads, non_finite, wrong_edges, wrong_signs};
use super::device::{DeviceFrame, DeviceMesh};
use super::error::{CaseError, Ended, Refusal};
use super::family::Family;
use super::row::{FacingTimes, Row, add_reason};
use super::sight::look;
use crate::mirror_frame::MirrorFrame;

/// Faces up to which the silhouette itself is compared, and not only its faces and that it is closed: the oracle keeps
/// a tree of all edges.
const ORACLE_FACES_MAX: usize = 50_000;

/// Faces that are classified at least for one time, so that the clock can tell.
const TIMED_FACES: usize = 50_000;

/// What a case comes to. What the library refuses is a row too.
pub(super) fn measure(gpu: &Gpu, family: &Family, case: &Case) -> Result<Row, CaseError> {
    let mut row = Row {
        family: family.name,
        parameter: case.parameter.clone(),
        at: case.at,
        degrades: case.degrades.clone(),
        visibility_error_max: case.visibility_error_max,
        refusal_is_due: case.refusal_is_due,
        ..Row::default()
    };
    match tried(gpu, case, &mut row) {
        Ok(()) => Ok(row),
        Err(Ended::Refused(refusal)) => Ok(Row { degrades: refusal.to_string(), is_refused: true, ..row }),
        Err(Ended::Failed(error)) => Err(error),
    }
}

fn tried(gpu: &Gpu, case: &Case, row: &mut Row) -> Result<(), Ended> {
    let meshes = case.meshes.iter().map(DeviceMesh::new).collect::<Result<Vec<_>, _>>().map_err(Refusal::from)?;
    let view = views(&case.light).map_err(Refusal::from)?[0];
    let mut device = DeviceFrame::new(gpu, &meshes, &case.light, &case.settings)?;
    device.complete(&case.light)?;
    row.time_ms = device.time_ms(&case.light)?;
    let found = device.read()?;

    let placed: Vec<_> = meshes.iter().map(|mesh| (&*mesh.topology, mesh.world_from_object)).collect();
    let frame = MirrorFrame::new(&placed, &case.light, &case.settings).map_err(Refusal::from)?;
    let twin = frame.run();

    // Faces and silhouettes, caster by caster.
    let (mut faces, mut wrong_f32, mut wrong, mut open) = (0, 0, 0, 0);
    for &index in &found.casting {
        let (mesh, light) = (&*meshes[index].topology, &frame.caster_lights[index]);
        let exact = FaceSigns::exact(mesh, light);
        // All casters have room for their bits, on the device too.
        let first_lit_word = frame.casters[index].first_lit_word as usize;
        let mut lit = vec![&twin.lit[first_lit_word..]];
        lit.extend(found.lit.as_ref().map(|lit| &lit[first_lit_word..]));
        faces += mesh.faces.len() as u64;
        wrong_f32 += wrong_signs(&exact, &[&bare_lit(mesh, light)]);
        wrong += wrong_signs(&exact, &lit);

        let of_caster = |edges: &[SilhouetteEdge]| -> Vec<SilhouetteEdge> {
            edges.iter().filter(|edge| edge.caster as usize == index).copied().collect()
        };
        let mut lists = vec![of_caster(&twin.silhouettes)];
        if found.lit.is_some() {
            lists.push(of_caster(&found.silhouettes));
        }
        let source = &case.meshes[index];
        let expected = (mesh.faces.len() <= ORACLE_FACES_MAX).then(|| {
            OracleTopology::new(&source.positions, &source.triangles)
                .silhouette(light.light_object.map(f32::from_bits), light.mirrored == 1)
        });
        for list in &lists {
            open += open_vertices(&mesh.edges, list).len() as u64;
            wrong += expected.as_ref().map_or(0, |expected| wrong_edges(&mesh.edges, expected, list));
        }
    }
    row.faces_tested = Some(faces);
    row.sign_errors_f32 = Some(wrong_f32);
    row.sign_errors = Some(wrong);
    row.open_cycles = Some(open);
    row.facing = facing_times(&frame, &meshes);

    // What is drawn.
    row.non_finite = Some(found.non_finite + non_finite(&twin.quads) + non_finite(&twin.corners));
    if let Some(definition) = WidthDefinition::new(&view, &case.settings) {
        let drawn = [(&found.quads, &found.corners), (&twin.quads, &twin.corners)];
        let errors = drawn.iter().filter_map(|(quads, corners)| definition.error(&meshes, quads, corners));
        row.width_error = errors.reduce(f64::max);

        let has_image = |edge: &&SilhouetteEdge| frame.caster_lights[edge.caster as usize].has_image();
        let missing = [(&found.silhouettes, &found.quads), (&twin.silhouettes, &twin.quads)].map(|(edges, quads)| {
            let edges: Vec<_> = edges.iter().filter(has_image).copied().collect();
            missing_quads(&view, &meshes, &edges, quads)
        });
        let points = case.gap_search.as_ref().and_then(|search| {
            let blockers = blockers(&meshes, &frame);
            drawn.iter().map(|(quads, corners)| gap_points(quads, corners, &blockers, search)).max()
        });
        row.gaps = missing.into_iter().max().map(|missing| missing + points.unwrap_or(0));
    }
    for (mesh, index) in meshes.iter().zip(0..) {
        if !found.casting.contains(&index) {
            add_reason(&mut row.degrades, &format!("the mesh casts nothing: {}", why_idle(mesh, &view)));
        }
    }
    explain(row, &device);
    // Before it is looked at with maps of its own: large ones would stand twice.
    drop(device);
    if let Some(camera) = case.seen_from
        && let Some(sight) = look(gpu, case, camera)?
    {
        row.visibility_error = sight.visibility_error;
        row.non_finite = row.non_finite.map(|count| count + sight.non_finite);
        row.pictures = Some(sight.pictures);
    }
    Ok(())
}

fn gap_points(quads: &[Quad], corners: &[Corner], blockers: &[[DVec2; 3]], search: &GapSearch) -> u64 {
    outline_gaps(quads, corners, blockers, search).len() as u64
}

/// Images of all faces, by the very matrices that the stages get.
fn blockers(meshes: &[DeviceMesh], frame: &MirrorFrame) -> Vec<[DVec2; 3]> {
    let of_mesh = |(mesh, light): (&DeviceMesh, &CasterLight)| {
        let topology = &mesh.topology;
        let NearOne { origin, scale } = NearOne::of_box(topology.bounds_min, topology.bounds_max);
        let near_one = |&position: &[f32; 3]| scale * (Vec3::from(position) - Vec3::from(origin));
        let positions: Vec<_> = topology.positions.iter().map(near_one).collect();
        let faces: Vec<_> = topology.faces.iter().map(|face| [face.a, face.b, face.c]).collect();
        blocker_image(&positions, &faces, &Mat4::from_cols_array(&light.light_clip_from_object))
    };
    meshes.iter().zip(&frame.caster_lights).flat_map(of_mesh).collect()
}

/// Why a mesh does not cast.
fn why_idle(mesh: &DeviceMesh, view: &View) -> Reason {
    if mesh.topology.faces.is_empty() {
        Reason::NoFaces
    } else if object_light(view.light_world, &mesh.world_from_object).singular {
        Reason::SingularMatrix
    } else {
        Reason::OutsideFrustum
    }
}

/// Adds what the library itself says that it left out.
fn explain(row: &mut Row, device: &DeviceFrame<'_>) {
    let left_out = device.plan().map_or(&[][..], |plan| &plan.left_out);
    let told = left_out.iter().filter_map(|left_out| match (&left_out.what, left_out.reason) {
        (Omitted::DetectionStages, Reason::LightHasNoSize) => Some(format!("no silhouette: {}", left_out.reason)),
        _ => None,
    });
    let counters = device.shadows.stats().counters.unwrap_or_default();
    let imageless = (counters.imageless_casters > 0).then(|| {
        "32-bit floats can't hold the view's clip space: the silhouette is found, no shadow is thrown".to_owned()
    });
    told.chain(imageless).for_each(|reason| add_reason(&mut row.degrades, &reason));
}

/// The same faces by a bare test and by the twins of the exact stages, taking turns; the best of three each. None where
/// there is no face.
fn facing_times(frame: &MirrorFrame, meshes: &[DeviceMesh]) -> Option<FacingTimes> {
    let faces: usize = meshes.iter().map(|mesh| mesh.topology.faces.len()).sum();
    if faces == 0 {
        return None;
    }
    let runs = TIMED_FACES.div_ceil(faces);
    let ns_per_face = |run: &dyn Fn()| {
        let clock = Instant::now();
        (0..runs).for_each(|_| run());
        clock.elapsed().as_secs_f64() * 1e9 / (runs * faces) as f64
    };
    let bare = || {
        for (mesh, light) in meshes.iter().zip(&frame.caster_lights) {
            black_box(bare_lit(&mesh.topology, light));
        }
    };
    let exact = || {
        black_box(frame.lit());
    };
    let best = (0..3)
        .map(|_| [ns_per_face(&bare), ns_per_face(&exact)])
        .reduce(|best, times| [best[0].min(times[0]), best[1].min(times[1])]);
    best.map(|[bare_ns, exact_ns]| FacingTimes { bare_ns, exact_ns })
}
