//! A case through the whole pipeline, and what the checks say.

use std::hint::black_box;
use std::time::Instant;

use contrejour_gpu::ShadowLightError;
use contrejour_plan::{Omitted, Reason, View, frame_views, object_light};
use contrejour_render::Gpu;

use super::case::Case;
use super::checks::bare_lit;
use super::device::{DeviceFrame, DeviceMesh};
use super::error::{CaseError, Ended, Refusal};
use super::family::Family;
use super::row::{FacingTimes, Row, add_reason};
use super::seen_view::SeenView;
use super::sight::look;
use crate::mirror_frame::MirrorFrame;

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
    let seen = frame_views(&case.light, None, &case.settings).map_err(ShadowLightError::from);
    let views = seen.map_err(Refusal::from)?.views;
    let mut device = DeviceFrame::new(gpu, &meshes, &case.light, &case.settings)?;
    device.complete(&case.light)?;
    row.time_ms = device.time_ms(&case.light)?;
    row.non_finite = Some(device.non_finite_texels()?);
    let far_depths: Vec<_> = views.iter().map(|view| view.far_depth).collect();
    row.gaps = device.open_boundaries(&far_depths)?;

    let placed: Vec<_> = meshes.iter().map(|mesh| (&*mesh.topology, mesh.world_from_object)).collect();
    let mut is_idle = vec![true; meshes.len()];
    for (view, found) in views.iter().zip(device.read(views.len())?) {
        found.casting.iter().for_each(|mesh| is_idle[*mesh] = false);
        let frame = MirrorFrame::of_view(&placed, view, &case.settings);
        let seen = SeenView { case, meshes: &meshes, view, frame: &frame, twin: &frame.run(), found: &found };
        seen.compare_silhouettes(row);
        seen.compare_smoothies(row);
        if row.facing.is_none() {
            row.facing = facing_times(&frame, &meshes);
        }
    }
    for (mesh, _) in meshes.iter().zip(is_idle).filter(|(_, is_idle)| *is_idle) {
        add_reason(&mut row.degrades, &format!("the mesh casts nothing: {}", why_idle(mesh, &views[0])));
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
