//! Silhouettes alone, left in a GPU buffer for stages of the caller's own.
//!
//! `cargo run --release -p contrejour --example silhouettes`

#[allow(dead_code, reason = "each example uses its part")]
mod common;

use std::sync::Arc;

use common::{Outcome, Torus};
use contrejour::layout::{Counters, SilhouetteEdge};
use contrejour::plan::BufferKind;
use contrejour::prelude::*;

fn main() -> Outcome {
    let (device, queue) = common::open_device()?;
    let torus = Torus::new(96, 48);
    let mut shadows = Shadows::new(&device)?;
    let mesh = TopologyAwareMesh::build(&torus.positions, &torus.triangles, &BuildOptions::default())?;
    let topology = Arc::new(mesh);
    let mesh = shadows.add_mesh(Arc::clone(&topology))?;

    let caster = CasterInput { mesh, world_from_object: common::world_from_body(), positions: Positions::OfMesh };
    shadows.add_caster(&caster)?;
    let options = ShadowOptions { outputs: Outputs::Silhouettes, ..Default::default() };
    shadows.add_light(&common::light(), &options)?;
    // The lists begin as long as silhouettes of such meshes mostly are, and grow where that is too short.
    while !shadows.is_complete() {
        shadows.prepare(&device, &queue)?;
        let mut encoder = device.create_command_encoder(&Default::default());
        shadows.encode(&mut encoder, &mut Untimed);
        queue.submit([encoder.finish()]);
        shadows.wait_for_counters(&device)?;
    }

    // Here a renderer would bind both buffers to a stage of its own, page by page where the mesh is too large for one.
    // The lists are not in any order; edges are.
    let mut edges: Vec<SilhouetteEdge> = Vec::new();
    let [silhouettes, counters] = [BufferKind::Silhouettes, BufferKind::Counters].map(|kind| shadows.buffers(kind));
    for (silhouettes, counters) in silhouettes.zip(counters) {
        let counters: Counters = bytemuck::pod_read_unaligned(&common::read_buffer(&device, &queue, counters)?);
        let bytes = common::read_buffer(&device, &queue, silhouettes)?;
        let page: Vec<SilhouetteEdge> = bytemuck::pod_collect_to_vec(&bytes);
        edges.extend(&page[..counters.silhouette_edges as usize]);
    }
    edges.sort_by_key(|edge| edge.edge_id);
    println!("{} of {} edges are in the silhouette", edges.len(), topology.edges.len());
    for silhouette in edges.iter().take(5) {
        let edge = topology.edges[silhouette.edge_id as usize];
        let multiplicity = i64::from(silhouette.left) - i64::from(silhouette.right);
        println!("  {} - {}: {multiplicity:+}", edge.low_vertex, edge.high_vertex);
    }
    Ok(())
}
