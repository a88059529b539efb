//! Skins and morph targets on the device: the current positions of deforming meshes.

mod error;
mod pool;
mod pose;
mod resources;

use std::sync::Arc;

use contrejour_mesh::DeformingMesh;
use glam::DMat4;

pub use error::{AddDeformingError, DeformError, NewDeformerError, SetPoseError};

use crate::casters::{KnownPositions, Positions};
use crate::device_watch::{DeviceWatch, OpenScopes};
use crate::error::DeviceError;
use crate::shadows::Shadows;
use crate::timer::PassTimer;
use pool::Pool;
use pose::DevicePose;
use resources::{DeformPipeline, DeformResources};

/// A mesh that was given to [`Deformer::add`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct DeformHandle(u64);

/// The pose of a deforming mesh.
#[derive(Clone, Copy, Debug)]
pub struct DeformInput<'a> {
    /// Which one.
    pub caster: DeformHandle,
    /// For each joint, object space from the space in which the mesh was bound; affine. They go to the device as `f32`.
    pub joint_matrices: &'a [DMat4],
    /// Weight of each morph target.
    pub morph_weights: &'a [f64],
}

/// Moves the vertices of all deforming meshes of a scene in one pass a frame, before the shadows of any light: in one
/// dispatch for all that was there in the first frame, and in some more for what came later and found no room among it.
///
/// Meshes get [poses](Self::set_pose); those that changed are all that a [prepared](Self::prepare) frame uploads. It
/// [records](Self::encode) its stage into the encoder that the shadows follow in; casters name the
/// [positions](Self::positions) that it leaves, and hear [of each other pose](Shadows::note_positions). Vertices that were
/// [welded as moving alike](DeformingMesh::topology) have equal bits in any pose. A coordinate that overflows stays at the
/// largest number.
///
/// What stays is not touched by what comes and goes: a frame uploads the meshes that came, and positions stay where they are
/// for as long as their mesh is there. Buffers that get too small grow to half more than is needed, by copies on the device;
/// one with room is kept until the last of its meshes is gone.
#[derive(Debug)]
pub struct Deformer {
    pool: Pool,
    next_handle: u64,
    most_bytes: u64,
    /// None until the first caster is prepared.
    pipeline: Option<DeformPipeline>,
    /// None until the first caster is prepared, and where there is none any more.
    resources: Option<DeformResources>,
    watch: DeviceWatch,
    /// Whether positions are to be made: other poses or meshes were uploaded.
    is_due: bool,
    upload_bytes: u64,
    set_up_bytes: u64,
}

impl Deformer {
    /// Makes an object for one scene. Nothing that depends on it is created yet.
    ///
    /// # Errors
    ///
    /// The device allows less than WebGPU's defaults, or fails.
    pub fn new(device: &wgpu::Device) -> Result<Self, NewDeformerError> {
        let limits = device.limits();
        let available = limits.max_storage_buffers_per_shader_stage;
        let needed = Shadows::required_limits().max_storage_buffers_per_shader_stage;
        if available < needed {
            return Err(NewDeformerError::Limits { available, needed });
        }
        let scopes = OpenScopes::push(device);
        Ok(Self {
            pool: Pool::default(),
            next_handle: 0,
            most_bytes: limits.max_storage_buffer_binding_size.min(limits.max_buffer_size),
            pipeline: None,
            resources: None,
            watch: DeviceWatch::new(device, scopes, 0)?,
            is_due: false,
            upload_bytes: 0,
            set_up_bytes: 0,
        })
    }

    /// Adds a mesh. It goes to the device when a frame is next prepared; meshes that share an [`Arc`] lie there once.
    ///
    /// # Errors
    ///
    /// All meshes together are more than a buffer of the device holds; then it is not added.
    pub fn add(&mut self, mesh: Arc<DeformingMesh>) -> Result<DeformHandle, AddDeformingError> {
        let handle = DeformHandle(self.next_handle);
        self.pool.add(handle, mesh, self.most_bytes)?;
        self.next_handle += 1;
        Ok(handle)
    }

    /// Removes a mesh; false where it was not there. The others keep their handles and their positions; those of meshes that
    /// come later lie where it lay.
    pub fn remove(&mut self, caster: DeformHandle) -> bool {
        self.pool.remove(caster)
    }

    /// Gives a mesh the pose that it keeps until it gets another one.
    ///
    /// # Errors
    ///
    /// The pose is of no mesh here, has other joints or morph targets than its mesh, or numbers that are not finite; then the
    /// mesh keeps the one that it had.
    pub fn set_pose(&mut self, input: &DeformInput<'_>) -> Result<(), SetPoseError> {
        let DeformInput { caster: handle, joint_matrices, morph_weights } = *input;
        let caster = self.pool.casters.get(&handle).ok_or(SetPoseError::UnknownCaster { caster: handle })?;
        let pose = DevicePose::new(handle, &caster.mesh, (joint_matrices, morph_weights))?;
        self.pool.set_pose(handle, &pose, |mesh| mesh.posed_bounds(joint_matrices, morph_weights));
        Ok(())
    }

    /// Prepares a frame: uploads poses that changed, and the meshes that came.
    ///
    /// # Errors
    ///
    /// A mesh has no pose; then nothing has changed. Where the device fails, the next prepare makes everything again, and
    /// positions are elsewhere.
    pub fn prepare(&mut self, device: &wgpu::Device, queue: &wgpu::Queue) -> Result<(), DeformError> {
        self.watch.check(device)?;
        let late = self.watch.late();
        self.keep_if(late)?;
        (self.upload_bytes, self.set_up_bytes) = (0, 0);
        if self.resources.is_none() {
            self.pool.pack(self.most_bytes);
        }
        if let Some((&caster, _)) = self.pool.casters.iter().find(|(_, caster)| caster.latest.is_none()) {
            return Err(DeformError::MissingPose { caster });
        }
        if self.pool.casters.is_empty() {
            self.resources = None;
            return Ok(());
        }
        if self.pool.has_changed {
            let scopes = OpenScopes::push(device);
            let pipeline = self.pipeline.get_or_insert_with(|| DeformPipeline::new(device));
            let before = self.resources.take();
            let (made, bytes) =
                DeformResources::follow(before, (device, queue), pipeline, &mut self.pool, self.most_bytes);
            self.resources = Some(made);
            self.set_up_bytes = bytes;
            self.is_due = true;
            let made = self.watch.close(device, scopes, bytes);
            self.keep_if(made)?;
        }
        if let Some(resources) = &self.resources {
            self.upload_bytes = resources.upload(queue, &mut self.pool);
            self.is_due |= self.upload_bytes > 0;
            self.pool.note_posed();
        }
        Ok(())
    }

    fn keep_if(&mut self, made: Result<(), DeviceError>) -> Result<(), DeviceError> {
        if made.is_err() {
            self.pipeline = None;
            self.resources = None;
        }
        made
    }

    /// Records the stage for what was [prepared](Self::prepare) last; nothing where that has been recorded.
    ///
    /// The encoder's commands must be submitted, or dropped together with this object.
    pub fn encode<T: PassTimer>(&mut self, encoder: &mut wgpu::CommandEncoder, timer: &mut T) {
        if let (Some(pipeline), Some(resources), true) = (&self.pipeline, &self.resources, self.is_due) {
            pipeline.encode(encoder, resources, timer);
            self.is_due = false;
        }
    }

    /// Where the positions of a mesh lie once the recorded commands have run, for [`CasterInput`](crate::CasterInput)
    /// and, as 12 bytes a vertex, for vertex buffers; none before a frame was prepared with the mesh. With
    /// what is [known](Self::known) of them.
    pub fn positions(&self, caster: DeformHandle) -> Option<Positions> {
        let caster = self.pool.casters.get(&caster).filter(|caster| !caster.is_new)?;
        let buffer = self.resources.as_ref()?.positions(caster.batch)?;
        Some(Positions::InBuffer {
            buffer: buffer.clone(),
            offset: 4 * caster.first_word,
            stride: 12,
            known: caster.known,
        })
    }

    /// Which positions a mesh has in the pose that was [prepared](Self::prepare) last, and where, for
    /// [`Shadows::note_positions`]; none before that was done.
    pub fn known(&self, caster: DeformHandle) -> Option<KnownPositions> {
        self.pool.casters.get(&caster)?.known
    }

    /// Bytes of poses that the last [`prepare`](Self::prepare) uploaded.
    pub fn upload_bytes(&self) -> u64 {
        self.upload_bytes
    }

    /// Bytes that it uploaded once because meshes came or went. Copies on the device are not among them.
    pub fn set_up_bytes(&self) -> u64 {
        self.set_up_bytes
    }
}
