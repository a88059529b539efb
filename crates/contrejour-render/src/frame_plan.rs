//! What a frame of a scene does, known before there is a device.

use contrejour_gpu::{mesh_facts, mesh_pieces};
use contrejour_plan::{
    Capacity, CasterFacts, DeviceFacts, FramePlan, LightError, ObjectBox, Outputs, PlanError, PlanInput, SceneFacts,
    ShadowSettings, guard_ndc, views_with_guard,
};
use contrejour_scene::{NoLight, Scene};

use crate::LocalSpace;
use crate::casters::{CasterTopologyError, Casters};

/// Why there is no plan of a scene.
#[derive(Debug, thiserror::Error)]
pub enum FramePlanError {
    /// The scene's light is no light.
    #[error(transparent)]
    Light(#[from] LightError),
    /// There is no light.
    #[error(transparent)]
    NoLight(#[from] NoLight),
    /// A mesh that casts has no topology.
    #[error(transparent)]
    Topology(#[from] CasterTopologyError),
    /// The device can't hold what the frame needs.
    #[error(transparent)]
    Plan(#[from] PlanError),
}

/// The plan that a first frame of a scene follows when a [`Renderer`](crate::Renderer) draws it.
///
/// # Errors
///
/// [`FramePlanError`] when the scene or the device does not allow a frame.
pub fn frame_plan(scene: &Scene, settings: &ShadowSettings, device: &DeviceFacts) -> Result<FramePlan, FramePlanError> {
    let local = LocalSpace::around(&scene.camera);
    let light = local.light(&scene.first_light()?.light);
    let views = views_with_guard(&light, guard_ndc(&light, settings))?;
    let casters = Casters::new(scene, &local)?;
    let facts = SceneFacts {
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
    };
    let (outputs, capacity) = (Outputs::Maps, Capacity::default());
    Ok(FramePlan::new(&PlanInput { scene: &facts, views: &views, settings, device, outputs, capacity, shared: &[] })?)
}
