//! The meshes of a scene that cast, with their topology.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::Arc;

use contrejour_gpu::{
    AddMeshError, CasterError, CasterHandle, CasterInput, CountersError, Deformer, LightHandle, NewShadowsError,
    PrepareError, ShadowLightError, ShadowOptions, Shadows, ViewChoice, VisibilityKind,
};
use contrejour_mesh::{BuildOptions, TopologyAwareMesh, TopologyError, TriangleMesh};
use contrejour_plan::{Eye, Light, LightKind, Outputs, ShadowSettings};
use contrejour_scene::{Scene, SceneMesh};
use glam::DMat4;

use crate::animated::DeformingCaster;
use crate::{Gpu, LocalSpace};

/// What casts in a scene. Each mesh has one topology, however often it stands there.
#[derive(Debug)]
pub(crate) struct Casters {
    pub topologies: Vec<Arc<TopologyAwareMesh>>,
    pub placed: Vec<Caster>,
    /// For each mesh of the scene, its index in `placed`, where it casts.
    of_mesh: Vec<Option<usize>>,
    /// None where no mesh deforms.
    pub deformer: Option<Deformer>,
    /// Bytes that poses uploaded and no frame has counted yet.
    pub pose_bytes: u64,
}

/// A mesh that throws a shadow.
#[derive(Debug)]
pub(crate) struct Caster {
    /// Its name in the scene.
    pub name: String,
    /// Index of its topology.
    pub mesh: usize,
    pub local_from_object: DMat4,
    /// What moves its vertices against each other.
    pub deforming: Option<DeformingCaster>,
}

/// A mesh that casts has no topology.
#[derive(Debug, thiserror::Error)]
#[error("mesh {mesh:?} cannot cast a shadow")]
pub struct CasterTopologyError {
    /// Name of the mesh in the scene.
    pub mesh: String,
    /// What is wrong with it.
    pub source: TopologyError,
}

/// Why the shadows of a scene cannot be made.
#[derive(Debug, thiserror::Error)]
pub enum CastShadowsError {
    /// The device does not allow shadows.
    #[error(transparent)]
    Shadows(#[from] NewShadowsError),
    /// The light is no light, or the shadow settings are out of range.
    #[error(transparent)]
    Light(#[from] ShadowLightError),
    /// A mesh that casts does not fit.
    #[error(transparent)]
    AddMesh(#[from] AddMeshError),
    /// A caster does not fit its mesh.
    #[error(transparent)]
    Caster(#[from] CasterError),
}

/// Why a frame of shadows cannot be prepared.
#[derive(Debug, thiserror::Error)]
pub enum PrepareShadowsError {
    /// The light is no light.
    #[error(transparent)]
    Light(#[from] ShadowLightError),
    /// A caster is gone.
    #[error(transparent)]
    Caster(#[from] CasterError),
    /// The device does not allow the frame.
    #[error(transparent)]
    Prepare(#[from] PrepareError),
}

/// The library's object with all casters and lights of a scene; its world is our local space.
#[derive(Debug)]
pub(crate) struct CastShadows {
    pub shadows: Shadows,
    handles: Vec<CasterHandle>,
}

impl Casters {
    /// Builds the topology of each mesh that casts.
    pub fn new(scene: &Scene, local: &LocalSpace) -> Result<Self, CasterTopologyError> {
        Self::with_topologies(scene, local, |_| None)
    }

    /// The same with other topologies of some meshes, by their index in the scene.
    pub fn with_topologies(
        scene: &Scene,
        local: &LocalSpace,
        other_topology: impl Fn(usize) -> Option<Result<TopologyAwareMesh, TopologyError>>,
    ) -> Result<Self, CasterTopologyError> {
        let mut casters = Self {
            topologies: Vec::new(),
            placed: Vec::new(),
            of_mesh: vec![None; scene.meshes.len()],
            deformer: None,
            pose_bytes: 0,
        };
        let mut known = HashMap::new();
        let casting = |placed: &SceneMesh| placed.casts && !placed.mesh.triangles.is_empty();
        for (index, placed) in scene.meshes.iter().enumerate().filter(|(_, placed)| casting(placed)) {
            let mesh = match known.entry(Arc::as_ptr(&placed.mesh)) {
                Entry::Occupied(known) => *known.get(),
                Entry::Vacant(place) => {
                    let TriangleMesh { positions, triangles, .. } = &*placed.mesh;
                    let topology = other_topology(index)
                        .unwrap_or_else(|| TopologyAwareMesh::build(positions, triangles, &BuildOptions::default()))
                        .map_err(|source| CasterTopologyError { mesh: placed.name.clone(), source })?;
                    casters.topologies.push(Arc::new(topology));
                    *place.insert(casters.topologies.len() - 1)
                }
            };
            casters.of_mesh[index] = Some(casters.placed.len());
            casters.placed.push(Caster {
                name: placed.name.clone(),
                mesh,
                local_from_object: local.local_from_world() * placed.world_from_object,
                deforming: None,
            });
        }
        Ok(casters)
    }

    /// The caster that a mesh of the scene is, where it casts.
    pub fn of_mesh(&mut self, mesh: usize) -> Option<&mut Caster> {
        self.placed.get_mut((*self.of_mesh.get(mesh)?)?)
    }

    /// The topology of a caster.
    pub fn topology(&self, caster: &Caster) -> &TopologyAwareMesh {
        &self.topologies[caster.mesh]
    }

    /// Edges of all casters.
    pub fn edge_count(&self) -> u64 {
        self.placed.iter().map(|caster| self.topology(caster).edges.len() as u64).sum()
    }
}

impl CastShadows {
    /// Without a light.
    pub fn new(gpu: &Gpu, casters: &Casters) -> Result<Self, CastShadowsError> {
        let mut shadows = Shadows::new(&gpu.device)?;
        let meshes = casters.topologies.iter().map(|topology| shadows.add_mesh(Arc::clone(topology)));
        let meshes = meshes.collect::<Result<Vec<_>, _>>()?;
        let handles = (casters.placed.iter()).map(|caster| {
            shadows.add_caster(&CasterInput {
                mesh: meshes[caster.mesh],
                world_from_object: caster.local_from_object,
                positions: casters.positions(caster),
            })
        });
        let handles = handles.collect::<Result<_, _>>()?;
        Ok(Self { shadows, handles })
    }

    /// Adds a light that casts.
    pub fn add_light(
        &mut self,
        light_local: &Light,
        settings: &ShadowSettings,
    ) -> Result<LightHandle, CastShadowsError> {
        let options = ShadowOptions { settings: *settings, outputs: Outputs::Maps, ..ShadowOptions::default() };
        Ok(self.shadows.add_light(light_local, &options)?)
    }

    /// Prepares a frame of the casters that it was made with, where they stand now, and with the lights like this; those that
    /// are cascaded follow the eye.
    pub fn prepare<'a>(
        &mut self,
        gpu: &Gpu,
        casters: &Casters,
        lights_local: impl IntoIterator<Item = (LightHandle, &'a Light)>,
        eye_local: &Eye,
    ) -> Result<(), PrepareShadowsError> {
        for (handle, caster) in self.handles.iter().zip(&casters.placed) {
            self.shadows.place_caster(*handle, &caster.local_from_object)?;
        }
        for (handle, light_local) in lights_local {
            self.shadows.set_light(handle, light_local)?;
            if let LightKind::Cascaded { .. } = light_local.kind {
                self.shadows.set_eye(handle, eye_local)?;
            }
        }
        Ok(self.shadows.prepare(&gpu.device, &gpu.queue)?)
    }

    /// What shapes the shader of a pass that asks for a light's visibility.
    pub fn kind_of(&self, light: LightHandle) -> (VisibilityKind, ViewChoice) {
        (self.shadows.visibility_kind(light), self.shadows.view_choice(light))
    }

    /// Waits for the submitted frames; returns whether the last one had room for everything.
    pub fn wait_until_done(&mut self, gpu: &Gpu) -> Result<bool, CountersError> {
        match self.shadows.wait_for_counters(&gpu.device) {
            Ok(_) => Ok(self.shadows.is_complete()),
            // Frames without silhouettes count nothing and miss nothing.
            Err(CountersError::NoFrame) => Ok(true),
            Err(error) => Err(error),
        }
    }
}
