//! What a frame of a scene does, known before there is a device.

use contrejour_gpu::mesh_pieces;
use contrejour_plan::{
    BufferKind, Capacity, CascadeError, CasterFacts, DeviceFacts, FramePlan, ObjectBox, Outputs, PlanError, PlanInput,
    PoolHoles, SceneFacts, frame_views, shared_plans,
};
use contrejour_scene::{Scene, SceneLight};

use crate::LocalSpace;
use crate::caster_meshes::{CasterMesh, CasterMeshError, mask_facts_of};
use crate::casters::Casters;

/// Why there is no plan of a scene.
#[derive(Debug, thiserror::Error)]
pub enum FramePlanError {
    /// A light of the scene is no light, or its cascades and the camera do not go together.
    #[error(transparent)]
    Light(#[from] CascadeError),
    /// A mesh that casts has no topology, or a mask does not fit it.
    #[error(transparent)]
    CasterMesh(#[from] CasterMeshError),
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
    let casting = || scene.lights.iter().enumerate().filter(|(_, light)| light.casts);
    let views_of = |light: &SceneLight| -> Result<_, FramePlanError> {
        Ok(frame_views(&local.light(&light.light), Some(&eye), &light.shadow)?.views)
    };
    let all_views = casting().map(|(_, light)| Ok(views_of(light)?.len())).sum::<Result<usize, FramePlanError>>()?;
    let plan_of = |light: &SceneLight, shared: &[BufferKind]| -> Result<FramePlan, FramePlanError> {
        let views = &views_of(light)?;
        let (outputs, capacity) = (Outputs::Maps, Capacity::default());
        let settings = &light.shadow;
        let (scene, made) = (&facts, &[]);
        let input = PlanInput { scene, views, all_views, settings, device, outputs, capacity, shared, made };
        Ok(FramePlan::new(&input)?)
    };
    let plans = shared_plans(|shared| casting().map(|(_, light)| plan_of(light, shared)).collect())?;
    Ok(casting().zip(plans).map(|((light, _), plan)| LightPlan { light, plan }).collect())
}

fn scene_facts(scene: &Scene, local: &LocalSpace, device: &DeviceFacts) -> Result<SceneFacts, CasterMeshError> {
    let casters = Casters::new(scene, local)?;
    Ok(SceneFacts {
        meshes: casters.meshes.iter().map(CasterMesh::facts).collect(),
        pieces: (casters.meshes.iter().enumerate())
            .flat_map(|(mesh, of_caster)| mesh_pieces(of_caster.topology(), mesh, device))
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
        masks: mask_facts_of(&casters.meshes),
        holes: PoolHoles::default(),
    })
}
