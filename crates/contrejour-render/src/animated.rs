//! Scenes in motion: their poses on the device.

use std::sync::Arc;

use contrejour_gpu::{
    AddDeformingError, DeformError, DeformHandle, DeformInput, Deformer, KnownPositions, NewDeformerError, Positions,
    SetPoseError,
};
use contrejour_mesh::{DeformingMesh, PartPose, PoseError, TriangleMesh};
use contrejour_scene::{AnimatedScene, Scene};
use glam::DVec3;

use crate::casters::{Caster, Casters};
use crate::error::NewRendererError;
use crate::gpu::Gpu;
use crate::local_space::LocalSpace;
use crate::posed_normals::PosedNormals;
use crate::renderer::Renderer;
use crate::scene_lights::MoveError;
use crate::scene_meshes::PosedDraw;

/// Why a scene does not move.
#[derive(Debug, thiserror::Error)]
pub enum AnimationError {
    /// The device does not allow deforming meshes.
    #[error(transparent)]
    New(#[from] NewDeformerError),
    /// The deforming meshes do not fit on the device.
    #[error(transparent)]
    Add(#[from] AddDeformingError),
    /// A frame has no pose.
    #[error(transparent)]
    Pose(#[from] PoseError),
    /// A light is none in a pose.
    #[error(transparent)]
    Move(#[from] MoveError),
    /// The pose does not fit its mesh.
    #[error(transparent)]
    SetPose(#[from] SetPoseError),
    /// The device fails.
    #[error(transparent)]
    Deform(#[from] DeformError),
}

/// What moves the vertices of a mesh that casts against each other.
#[derive(Debug)]
pub(crate) struct DeformingCaster {
    pub handle: DeformHandle,
    mesh: Arc<DeformingMesh>,
    triangles: Vec<[u32; 3]>,
    normals: PosedNormals,
    /// Where the vertices are, for what the CPU draws.
    pub posed: Vec<DVec3>,
}

/// What moves the vertices of a scene's meshes against each other.
///
/// The meshes that a pose moves are the first ones of the scene, and all of them cast.
pub trait DeformingMeshes {
    /// What deforms a mesh of the scene; none where nothing does.
    fn deforming(&self, mesh: usize) -> Option<&Arc<DeformingMesh>>;

    /// The mesh that a mesh of the scene is a pose of, at rest.
    fn rest_mesh(&self, mesh: usize) -> Option<&TriangleMesh>;
}

impl DeformingMeshes for AnimatedScene {
    fn deforming(&self, mesh: usize) -> Option<&Arc<DeformingMesh>> {
        self.deforming(mesh)
    }

    fn rest_mesh(&self, mesh: usize) -> Option<&TriangleMesh> {
        self.rest_mesh(mesh)
    }
}

impl Renderer {
    /// Uploads a scene in motion, in its first frame.
    ///
    /// # Errors
    ///
    /// [`NewRendererError`] when something does not fit on the device.
    pub fn new_animated(gpu: Gpu, animated: &AnimatedScene) -> Result<Self, NewRendererError> {
        let frame = animated.frame(animated.time(0)).map_err(AnimationError::from)?;
        Self::new_posed(gpu, &animated.scene, animated, &frame.poses)
    }

    /// Uploads a scene whose first meshes stand in these poses.
    ///
    /// # Errors
    ///
    /// [`NewRendererError`] when something does not fit on the device.
    pub fn new_posed(
        gpu: Gpu,
        scene: &Scene,
        meshes: &dyn DeformingMeshes,
        poses: &[PartPose],
    ) -> Result<Self, NewRendererError> {
        let new_casters = |gpu: &Gpu, local: &LocalSpace| -> Result<Casters, NewRendererError> {
            let deforming = |mesh| Some((&**meshes.deforming(mesh)?, meshes.rest_mesh(mesh)?));
            let mut casters = Casters::with_deforming(scene, local, deforming)?;
            casters.add_deforming(gpu, scene, meshes)?;
            casters.pose(gpu, scene, poses, local)?;
            Ok(casters)
        };
        let mut renderer = Self::with_casters(gpu, scene, new_casters)?;
        renderer.pose_meshes(scene, poses)?;
        Ok(renderer)
    }

    /// Poses a scene in motion for the frames that follow, with its camera and its lights; `time` is in seconds.
    ///
    /// # Errors
    ///
    /// [`AnimationError`] when a number overflows, a light is none in this pose, or the device fails.
    pub fn pose(&mut self, animated: &AnimatedScene, time: f64) -> Result<(), AnimationError> {
        let frame = animated.frame(time)?;
        self.pose_meshes(&animated.scene, &frame.poses)?;
        self.set_camera(&frame.camera);
        for (index, light) in frame.lights.iter().enumerate() {
            self.set_light(index, light)?;
        }
        Ok(())
    }

    /// Poses the first meshes of the scene for the frames that follow. Joint matrices and weights go to the device, and, for
    /// shading alone, normals.
    ///
    /// # Errors
    ///
    /// [`AnimationError`] when the device fails.
    pub fn pose_meshes(&mut self, scene: &Scene, poses: &[PartPose]) -> Result<(), AnimationError> {
        self.casters.pose(&self.gpu, scene, poses, &self.local)?;
        let mut bytes = 0;
        for ((index, pose), draw) in moving(scene, poses).zip(0..) {
            let deformed = self.casters.deforming[index].as_ref().map(|deforming| {
                let normals = deforming.normals.at(&deforming.posed, &deforming.triangles);
                (self.casters.positions(index), normals)
            });
            let posed = PosedDraw { mesh: &scene.meshes[index].mesh, pose, local: &self.local, deformed };
            bytes += self.meshes.pose(&self.gpu, draw, &posed);
        }
        self.casters.pose_bytes += bytes;
        Ok(())
    }
}

/// The meshes that poses move, without those that have no triangle: they are drawn and cast, and come first there.
fn moving<'a>(scene: &'a Scene, poses: &'a [PartPose]) -> impl Iterator<Item = (usize, &'a PartPose)> + use<'a> {
    poses.iter().enumerate().filter(|&(index, _)| !scene.meshes[index].mesh.triangles.is_empty())
}

impl Casters {
    /// Gives the deforming meshes of a scene to a deformer, where there are any.
    fn add_deforming(&mut self, gpu: &Gpu, scene: &Scene, meshes: &dyn DeformingMeshes) -> Result<(), AnimationError> {
        for (index, placed) in scene.meshes.iter().enumerate() {
            let (Some(mesh), Some(rest)) = (meshes.deforming(index), meshes.rest_mesh(index)) else { continue };
            if placed.mesh.triangles.is_empty() {
                continue;
            }
            let deformer = match &mut self.deformer {
                Some(deformer) => deformer,
                none => none.insert(Deformer::new(&gpu.device)?),
            };
            self.deforming[index] = Some(DeformingCaster {
                handle: deformer.add(Arc::clone(mesh))?,
                mesh: Arc::clone(mesh),
                triangles: rest.triangles.clone(),
                normals: PosedNormals::new(rest),
                posed: Vec::new(),
            });
        }
        Ok(())
    }

    /// Moves what moves.
    fn pose(&mut self, gpu: &Gpu, scene: &Scene, poses: &[PartPose], local: &LocalSpace) -> Result<(), AnimationError> {
        for (index, pose) in moving(scene, poses) {
            self.place(index, &(local.local_from_world() * pose.world_from_object));
            if let (Some(deforming), Some(deformer)) = (&mut self.deforming[index], &mut self.deformer) {
                deforming.posed = deforming.mesh.posed(pose);
                deformer.set_pose(&DeformInput {
                    caster: deforming.handle,
                    joint_matrices: &pose.joint_matrices,
                    morph_weights: &pose.morph_weights,
                })?;
            }
        }
        if let Some(deformer) = &mut self.deformer {
            deformer.prepare(&gpu.device, &gpu.queue)?;
            self.pose_bytes += deformer.upload_bytes();
        }
        Ok(())
    }

    /// Which positions a caster has in its latest pose; none where it is rigid.
    pub fn known_positions(&self, caster: &Caster) -> Option<KnownPositions> {
        self.deformer.as_ref()?.known(self.deforming(caster)?.handle)
    }

    /// Where the positions of a mesh of the scene are.
    pub fn positions(&self, scene_mesh: usize) -> Positions {
        let deformed = self.deforming[scene_mesh].as_ref().zip(self.deformer.as_ref());
        deformed.and_then(|(deforming, deformer)| deformer.positions(deforming.handle)).unwrap_or_default()
    }
}
