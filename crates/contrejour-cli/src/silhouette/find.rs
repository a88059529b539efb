//! Silhouette edges, found on the device or on the CPU.

use std::sync::Arc;

use contrejour_gpu::{CasterInput, Positions, ShadowOptions, Shadows};
use contrejour_layout::{BLOCK_BY_PLANES, BLOCK_BY_POSITIONS, BLOCK_SIZE, Caster, SilhouetteEdge, WorkItem};
use contrejour_mirror::{FrameInputs, run_frame};
use contrejour_plan::{Light, NearOne, Outputs, ShadowSettings, View, ViewCounts, caster_light, object_light, views};
use contrejour_render::{Gpu, find_silhouettes};

use super::found::PlacedMesh;
use crate::failure::Failure;
use crate::output::warn;

/// Runs the compute stages, and nothing else, on the device.
pub fn on_gpu(placed: &[PlacedMesh<'_>], light: &Light) -> Result<Vec<SilhouetteEdge>, Failure> {
    let gpu = Gpu::open()?;
    let mut shadows = Shadows::new(&gpu.device)?;
    for placed in placed {
        let mesh = shadows.add_mesh(Arc::clone(&placed.topology))?;
        shadows.add_caster(&CasterInput {
            mesh,
            world_from_object: placed.world_from_object,
            positions: Positions::OfMesh,
        })?;
    }
    let options = ShadowOptions { outputs: Outputs::Silhouettes, ..ShadowOptions::default() };
    shadows.add_light(light, &options)?;
    warn_of_singular_casters(placed, &views(light)?[0]);
    Ok(find_silhouettes(&gpu, &mut shadows)?)
}

/// Runs the twins of the compute stages, mesh by mesh.
pub fn on_cpu(placed: &[PlacedMesh<'_>], light: &Light) -> Result<Vec<SilhouetteEdge>, Failure> {
    let views = views(light)?;
    let view = views.first().ok_or("the light has no view")?;
    let mut silhouettes = Vec::new();
    for (placed, caster) in placed.iter().zip(0..) {
        let found = silhouettes_of(placed, view).unwrap_or_default();
        silhouettes.extend(found.into_iter().map(|edge| SilhouetteEdge { caster, ..edge }));
    }
    warn_of_singular_casters(placed, view);
    Ok(silhouettes)
}

/// The silhouette of one mesh; `None` where its matrix is singular.
fn silhouettes_of(placed: &PlacedMesh<'_>, view: &View) -> Option<Vec<SilhouetteEdge>> {
    let topology = &*placed.topology;
    let near_one = NearOne::of_box(topology.bounds_min, topology.bounds_max);
    let caster_light = caster_light(view, &placed.world_from_object, &near_one);
    if caster_light.casts == 0 {
        return None;
    }
    let face_count = topology.faces.len() as u32;
    let edge_count = topology.candidate_edge_count;
    let planes = topology.face_planes();
    let blocks = |count: u32| (0..count.div_ceil(BLOCK_SIZE)).map(|block| WorkItem { block, ..WorkItem::default() });
    let kind = |block| if planes.block_fits(block) { BLOCK_BY_PLANES } else { BLOCK_BY_POSITIONS };
    let face_items = blocks(face_count).map(|item| WorkItem { kind: kind(item.block), ..item });
    let face_items: Vec<WorkItem> = face_items.collect();
    let edge_items: Vec<WorkItem> = blocks(edge_count).collect();
    let caster = Caster {
        position_stride_words: 3,
        face_count,
        edge_count,
        position_scale: near_one.scale,
        position_origin: near_one.origin,
        ..Caster::default()
    };
    // Without room for quads and corners none are kept.
    let counts = ViewCounts {
        casters: 1,
        face_blocks: face_items.len() as u32,
        edge_blocks: edge_items.len() as u32,
        undecided: face_count,
        silhouettes: edge_count,
        quads: 0,
        corners: 0,
    };
    let frame = run_frame(&FrameInputs {
        view: &view.light_view(&ShadowSettings::default(), &counts),
        face_items: &face_items,
        edge_items: &edge_items,
        casters: &[caster],
        caster_lights: &[caster_light],
        positions: bytemuck::cast_slice(&topology.positions),
        faces: &topology.faces,
        planes: &planes.planes,
        edges: &topology.edges,
        incidences: &topology.incidences,
        vertex_edges: &[],
    });
    Some(frame.silhouettes)
}

fn warn_of_singular_casters(placed: &[PlacedMesh<'_>], view: &View) {
    let is_singular = |placed: &&PlacedMesh<'_>| object_light(view.light_world, &placed.world_from_object).singular;
    let count = placed.iter().filter(is_singular).count();
    if count > 0 {
        warn(&format!("{count} nodes have a matrix without an inverse for this light, so they have no silhouette"));
    }
}
