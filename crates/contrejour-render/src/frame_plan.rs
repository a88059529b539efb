//! What a frame of a scene does, known before there is a device.

use std::collections::BTreeSet;

use contrejour_gpu::{mesh_facts, mesh_pieces};
use contrejour_plan::{
    BufferKind, Capacity, CascadeError, CasterFacts, DeviceFacts, FramePlan, ObjectBox, Outputs, PlanError, PlanInput,
    SceneFacts, frame_views,
};
use contrejour_scene::{Scene, SceneLight};

use crate::LocalSpace;
use crate::casters::{CasterTopologyError, Casters};

/// Why there is no plan of a scene.
#[derive(Debug, thiserror::Error)]
pub enum FramePlanError {
    /// A light of the scene is no light, or its cascades and the camera do not go together.
    #[error(transparent)]
    Light(#[from] CascadeError),
    /// A mesh that casts has no topology.
    #[error(transparent)]
    Topology(#[from] CasterTopologyError),
    /// The device can't hold what the frame needs.
    #[error(transparent)]
    Plan(#[from] PlanError),
}

/// The plan of one light's shadow.
#[derive(Clone, Debug)]
pub struct LightPlan {
    /// Its place among the scene's lights.
    pub light: usize,
    /// The plan. Buffers that no one light [has](contrejour_plan::BufferKind::is_of_light) are shared by all lights.
    pub plan: FramePlan,
}

/// The plans that a first frame of a scene follows when a [`Renderer`](crate::Renderer) draws it, one for each light that
/// casts.
///
/// # Errors
///
/// [`FramePlanError`] when the scene or the device does not allow a frame.
pub fn frame_plans(scene: &Scene, device: &DeviceFacts) -> Result<Vec<LightPlan>, FramePlanError> {
    let local = LocalSpace::around(&scene.camera);
    let facts = scene_facts(scene, &local, device)?;
    let eye = local.camera(&scene.camera).as_eye(scene.aspect());
    let plans = |shared: &[BufferKind]| -> Result<Vec<LightPlan>, FramePlanError> {
        let casting = scene.lights.iter().enumerate().filter(|(_, light)| light.casts);
        let plan_of = |(index, light): (usize, &SceneLight)| {
            let light_local = local.light(&light.light);
            let views = frame_views(&light_local, Some(&eye), &light.shadow)?.views;
            let (outputs, capacity) = (Outputs::Maps, Capacity::default());
            let settings = &light.shadow;
            let input = PlanInput { scene: &facts, views: &views, settings, device, outputs, capacity, shared };
            Ok(LightPlan { light: index, plan: FramePlan::new(&input)? })
        };
        casting.map(plan_of).collect()
    };
    // Where lights are made in different ways, all of them share what any of them needs.
    let alone = plans(&[])?;
    let kinds = alone.iter().flat_map(|light| &light.plan.buffers).map(|buffer| buffer.kind);
    let shared: BTreeSet<BufferKind> = kinds.filter(|kind| !kind.is_of_light()).collect();
    let is_alike = |light: &LightPlan| shared.iter().all(|kind| light.plan.buffer(*kind).is_some());
    if alone.iter().all(is_alike) { Ok(alone) } else { plans(&shared.into_iter().collect::<Vec<_>>()) }
}

fn scene_facts(scene: &Scene, local: &LocalSpace, device: &DeviceFacts) -> Result<SceneFacts, CasterTopologyError> {
    let casters = Casters::new(scene, local)?;
    Ok(SceneFacts {
        meshes: casters.topologies.iter().map(|topology| mesh_facts(topology)).collect(),
        pieces: (casters.topologies.iter().enumerate())
            .flat_map(|(mesh, topology)| mesh_pieces(topology, mesh, device))
            .collect(),
        casters: (casters.placed.iter().enumerate())
            .map(|(slot, caster)| {
                let topology = casters.topology(caster);
                let bounds = ObjectBox {
                    min: topology.bounds_min,
                    max: topology.bounds_max,
                    world_from_object: caster.local_from_object,
                };
                CasterFacts {
                    slot,
                    name: caster.name.clone(),
                    mesh: caster.mesh,
                    bounds: Some(bounds),
                    own_position_words: 0,
                }
            })
            .collect(),
        receivers: scene.meshes.iter().filter(|placed| !placed.casts).map(|placed| placed.name.clone()).collect(),
    })
}
