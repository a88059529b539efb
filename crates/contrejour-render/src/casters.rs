//! What casts in a scene, and where it stands.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::ops::Range;
use std::sync::Arc;

use contrejour_gpu::{
    AddMeshError, CasterError, CasterHandle, CasterInput, CountersError, Deformer, LightHandle, NewShadowsError,
    Positions, PrepareError, ShadowLightError, ShadowOptions, Shadows, ViewChoice, VisibilityKind,
};
use contrejour_mesh::{DeformingMesh, MaskedMesh, TopologyAwareMesh, TriangleMesh};
use contrejour_plan::{Eye, Light, LightKind, Outputs, ShadowSettings};
use contrejour_scene::Scene;
use glam::DMat4;

use crate::animated::DeformingCaster;
use crate::caster_meshes::{CasterMesh, CasterMeshError, CasterMeshes};
use crate::silhouettes::had_room;
use crate::{Gpu, LocalSpace};

/// What casts in a scene. Each mesh is made once, however often it stands there.
#[derive(Debug)]
pub(crate) struct Casters {
    pub meshes: Vec<CasterMesh>,
    pub placed: Vec<Caster>,
    /// For each mesh of the scene, those of `placed` that it is: one for what no mask cuts, one for each part that one does.
    of_mesh: Vec<Range<usize>>,
    /// For each mesh of the scene, what moves its vertices against each other.
    pub deforming: Vec<Option<DeformingCaster>>,
    /// None where no mesh deforms.
    pub deformer: Option<Deformer>,
    /// Bytes that poses uploaded and no frame has counted yet.
    pub pose_bytes: u64,
}

/// Triangles that throw a shadow, where they stand.
#[derive(Debug)]
pub(crate) struct Caster {
    /// Its name in the scene.
    pub name: String,
    /// Index of its triangles.
    pub mesh: usize,
    pub local_from_object: DMat4,
    /// The mesh of the scene that it is, or is a part of.
    scene_mesh: usize,
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
    /// Makes each mesh that casts.
    pub fn new(scene: &Scene, local: &LocalSpace) -> Result<Self, CasterMeshError> {
        Self::with_deforming(scene, local, |_| None)
    }

    /// The same where some meshes of the scene, by index, are poses of others, which are what casts.
    pub fn with_deforming<'a>(
        scene: &Scene,
        local: &LocalSpace,
        deforming: impl Fn(usize) -> Option<(&'a DeformingMesh, &'a TriangleMesh)>,
    ) -> Result<Self, CasterMeshError> {
        let mut casters = Self {
            meshes: Vec::new(),
            placed: Vec::new(),
            of_mesh: Vec::new(),
            deforming: scene.meshes.iter().map(|_| None).collect(),
            deformer: None,
            pose_bytes: 0,
        };
        let mut makers = CasterMeshes::default();
        let mut known: HashMap<_, Range<usize>> = HashMap::new();
        for (scene_mesh, placed) in scene.meshes.iter().enumerate() {
            let first = casters.placed.len();
            if placed.casts {
                let meshes = match known.entry(Arc::as_ptr(&placed.mesh)) {
                    Entry::Occupied(known) => known.get().clone(),
                    Entry::Vacant(place) => {
                        let made = match deforming(scene_mesh) {
                            Some((deforming, rest)) => makers.make(&placed.name, rest, Some(deforming))?,
                            None => makers.make(&placed.name, &placed.mesh, None)?,
                        };
                        let first = casters.meshes.len();
                        casters.meshes.extend(made);
                        place.insert(first..casters.meshes.len()).clone()
                    }
                };
                let local_from_object = local.local_from_world() * placed.world_from_object;
                let name = if placed.name.is_empty() { format!("mesh {scene_mesh}") } else { placed.name.clone() };
                casters.placed.extend(meshes.map(|mesh| Caster {
                    name: name.clone(),
                    mesh,
                    local_from_object,
                    scene_mesh,
                }));
            }
            casters.of_mesh.push(first..casters.placed.len());
        }
        Ok(casters)
    }

    /// Moves all that a mesh of the scene casts with.
    pub fn place(&mut self, scene_mesh: usize, local_from_object: &DMat4) {
        if let Some(casters) = self.of_mesh.get(scene_mesh) {
            self.placed[casters.clone()].iter_mut().for_each(|caster| caster.local_from_object = *local_from_object);
        }
    }

    /// The triangles of a caster.
    pub fn topology(&self, caster: &Caster) -> &TopologyAwareMesh {
        self.meshes[caster.mesh].topology()
    }

    /// Where the positions of a caster are.
    fn positions_of(&self, caster: &Caster) -> Positions {
        match (self.positions(caster.scene_mesh), &self.meshes[caster.mesh]) {
            (Positions::InBuffer { buffer, offset, stride, known }, CasterMesh::Masked { first_vertex, .. }) => {
                Positions::InBuffer { buffer, offset: offset + stride * u64::from(*first_vertex), stride, known }
            }
            (positions, _) => positions,
        }
    }

    /// The masked parts that a mesh of the scene casts with, in its order.
    pub fn masked_parts(&self, scene_mesh: usize) -> impl Iterator<Item = &Arc<MaskedMesh>> {
        let placed = self.of_mesh.get(scene_mesh).map_or(&[][..], |casters| &self.placed[casters.clone()]);
        placed.iter().filter_map(|caster| match &self.meshes[caster.mesh] {
            CasterMesh::Masked { mesh, .. } => Some(mesh),
            CasterMesh::Uncut(_) => None,
        })
    }

    /// What moves the vertices of a caster against each other.
    pub fn deforming(&self, caster: &Caster) -> Option<&DeformingCaster> {
        self.deforming[caster.scene_mesh].as_ref()
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
        let meshes = casters.meshes.iter().map(|mesh| mesh.add_to(&mut shadows));
        let meshes = meshes.collect::<Result<Vec<_>, _>>()?;
        let handles = (casters.placed.iter()).map(|caster| {
            shadows.add_caster(&CasterInput {
                mesh: meshes[caster.mesh],
                world_from_object: caster.local_from_object,
                positions: casters.positions_of(caster),
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
            if let Some(known) = casters.known_positions(caster) {
                self.shadows.note_positions(*handle, &known)?;
            }
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
        had_room(gpu, &mut self.shadows)
    }
}
