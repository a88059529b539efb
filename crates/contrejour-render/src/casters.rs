//! The meshes of a scene that cast, with their topology.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::Arc;

use contrejour_gpu::{
    AddMeshError, CasterError, CasterInput, CountersError, LightHandle, NewShadowsError, Positions, PrepareError,
    ShadowLightError, ShadowOptions, Shadows,
};
use contrejour_mesh::{BuildOptions, TopologyAwareMesh, TopologyError, TriangleMesh};
use contrejour_plan::Light;
use contrejour_scene::Scene;
use glam::DMat4;

use crate::{Gpu, LocalSpace};

/// What casts in a scene. Each mesh has one topology, however often it stands there.
#[derive(Debug)]
pub(crate) struct Casters {
    pub topologies: Vec<Arc<TopologyAwareMesh>>,
    pub placed: Vec<Caster>,
}

/// A mesh that throws a shadow.
#[derive(Debug)]
pub(crate) struct Caster {
    /// Its name in the scene.
    pub name: String,
    /// Index of its topology.
    pub mesh: usize,
    pub local_from_object: DMat4,
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
    /// The device does not allow the frame.
    #[error(transparent)]
    Prepare(#[from] PrepareError),
}

/// The library's object with all casters and the light of a scene; its world is our local space.
#[derive(Debug)]
pub(crate) struct CastShadows {
    pub shadows: Shadows,
    pub light: LightHandle,
}

impl Casters {
    /// Builds the topology of each mesh that casts.
    pub fn new(scene: &Scene, local: &LocalSpace) -> Result<Self, CasterTopologyError> {
        let mut casters = Self { topologies: Vec::new(), placed: Vec::new() };
        let mut known = HashMap::new();
        for placed in scene.meshes.iter().filter(|placed| placed.casts && !placed.mesh.triangles.is_empty()) {
            let mesh = match known.entry(Arc::as_ptr(&placed.mesh)) {
                Entry::Occupied(known) => *known.get(),
                Entry::Vacant(place) => {
                    let TriangleMesh { positions, triangles, .. } = &*placed.mesh;
                    let topology = TopologyAwareMesh::build(positions, triangles, &BuildOptions::default())
                        .map_err(|source| CasterTopologyError { mesh: placed.name.clone(), source })?;
                    casters.topologies.push(Arc::new(topology));
                    *place.insert(casters.topologies.len() - 1)
                }
            };
            casters.placed.push(Caster {
                name: placed.name.clone(),
                mesh,
                local_from_object: local.local_from_world() * placed.world_from_object,
            });
        }
        Ok(casters)
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
    pub fn new(
        gpu: &Gpu,
        casters: &Casters,
        light_local: &Light,
        options: &ShadowOptions,
    ) -> Result<Self, CastShadowsError> {
        let mut shadows = Shadows::new(&gpu.device)?;
        let meshes = casters.topologies.iter().map(|topology| shadows.add_mesh(Arc::clone(topology)));
        let meshes = meshes.collect::<Result<Vec<_>, _>>()?;
        for caster in &casters.placed {
            shadows.add_caster(&CasterInput {
                mesh: meshes[caster.mesh],
                world_from_object: caster.local_from_object,
                positions: Positions::OfMesh,
            })?;
        }
        let light = shadows.add_light(&gpu.device, light_local, options)?;
        Ok(Self { shadows, light })
    }

    /// Prepares a frame with the light like this.
    pub fn prepare(&mut self, gpu: &Gpu, light_local: &Light) -> Result<(), PrepareShadowsError> {
        self.shadows.set_light(self.light, light_local)?;
        Ok(self.shadows.prepare(&gpu.device, &gpu.queue)?)
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
