//! `contrejour plan`: what a frame of a scene does, and what it leaves out and why.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::Arc;

use contrejour_gpu::mesh_facts;
use contrejour_mesh::{BuildOptions, TopologyAwareMesh, TriangleMesh};
use contrejour_plan::{
    Capacity, CasterFacts, DeviceFacts, FramePlan, ObjectBox, Outputs, PlanInput, SceneFacts, ShadowSettings, views,
};
use contrejour_render::Gpu;
use contrejour_scene::Scene;
use serde::Serialize;

use crate::args::PlanArguments;
use crate::failure::{Failure, one_line};
use crate::output::{print, warn};
use crate::scenes;

#[derive(Serialize)]
struct DevicePlan {
    /// `null` where there is no device.
    device: Option<String>,
    plan: FramePlan,
}

pub fn run(arguments: &PlanArguments) -> Result<(), Failure> {
    let scene = scenes::open(arguments.scene.as_deref())?;
    let settings = arguments.shadow.applied_to(scene.shadow)?;
    let (device, facts) = match Gpu::open() {
        Ok(gpu) => (Some(gpu.description()), gpu.facts()),
        Err(error) => {
            warn(&format!("{}; the plan is for a device with WebGPU's defaults", one_line(&error)));
            (None, DeviceFacts::default())
        }
    };
    let plan = plan(&scene, &settings, &facts)?;
    print(&if arguments.json {
        serde_json::to_string_pretty(&DevicePlan { device, plan })?
    } else {
        format!("device: {}\n{plan}", device.as_deref().unwrap_or("none, WebGPU's defaults"))
    })
}

fn plan(scene: &Scene, settings: &ShadowSettings, device: &DeviceFacts) -> Result<FramePlan, Failure> {
    let views = views(&scene.light)?;
    let view = views.first().ok_or("the light has no view")?;
    let facts = scene_facts(scene)?;
    Ok(FramePlan::new(&PlanInput {
        scene: &facts,
        view,
        settings,
        device,
        outputs: Outputs::Maps,
        capacity: Capacity::default(),
    })?)
}

fn scene_facts(scene: &Scene) -> Result<SceneFacts, Failure> {
    let mut facts = SceneFacts::default();
    let mut known = HashMap::new();
    for placed in &scene.meshes {
        if !placed.casts {
            facts.receivers.push(placed.name.clone());
            continue;
        }
        let (mesh, min, max) = match known.entry(Arc::as_ptr(&placed.mesh)) {
            Entry::Occupied(known) => *known.get(),
            Entry::Vacant(place) => {
                let TriangleMesh { positions, triangles, .. } = &*placed.mesh;
                let topology = TopologyAwareMesh::build(positions, triangles, &BuildOptions::default())?;
                facts.meshes.push(mesh_facts(&topology));
                *place.insert((facts.meshes.len() - 1, topology.bounds_min, topology.bounds_max))
            }
        };
        let bounds = ObjectBox { min, max, world_from_object: placed.world_from_object };
        facts.casters.push(CasterFacts {
            name: placed.name.clone(),
            mesh,
            bounds: Some(bounds),
            own_position_words: 0,
        });
    }
    Ok(facts)
}
