//! Skins and morph targets on the device: the current positions of deforming meshes.

mod error;
mod pool;
mod resources;

use std::collections::BTreeMap;
use std::sync::Arc;

use contrejour_mesh::DeformingMesh;
use glam::DMat4;

pub use error::{AddDeformingError, DeformError, NewDeformerError};

use crate::casters::Positions;
use crate::device_watch::{DeviceWatch, OpenScopes};
use crate::error::DeviceError;
use crate::shadows::Shadows;
use crate::timer::PassTimer;
use pool::{Poses, Tables};
use resources::{DeformPipeline, DeformResources};

/// A mesh that was given to [`Deformer::add`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct DeformHandle(u64);

/// The pose of a deforming mesh in a frame.
#[derive(Clone, Copy, Debug)]
pub struct DeformInput<'a> {
    /// Which one.
    pub caster: DeformHandle,
    /// For each joint, object space from the space in which the mesh was bound; affine. They go to the device as `f32`.
    pub joint_matrices: &'a [DMat4],
    /// Weight of each morph target.
    pub morph_weights: &'a [f64],
}

/// Moves the vertices of all deforming meshes of a scene in one dispatch a frame, before the shadows of any light.
///
/// Each frame it is [prepared](Self::prepare) with the poses, which are all that goes to the device, and
/// [records](Self::encode) its stage into the encoder that the shadows follow in; casters name the
/// [positions](Self::positions) that it leaves. Vertices that were
/// [welded as moving alike](DeformingMesh::topology) have equal bits in any pose. A coordinate that overflows stays at the
/// largest number.
#[derive(Debug)]
pub struct Deformer {
    casters: BTreeMap<DeformHandle, Arc<DeformingMesh>>,
    next_handle: u64,
    most_bytes: u64,
    tables: Tables,
    /// None until the first caster is prepared.
    pipeline: Option<DeformPipeline>,
    /// None where the set of casters has changed since, or there is none.
    resources: Option<DeformResources>,
    watch: DeviceWatch,
    upload_bytes: u64,
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
            casters: BTreeMap::new(),
            next_handle: 0,
            most_bytes: limits.max_storage_buffer_binding_size.min(limits.max_buffer_size),
            tables: Tables::default(),
            pipeline: None,
            resources: None,
            watch: DeviceWatch::new(device, scopes, 0)?,
            upload_bytes: 0,
        })
    }

    /// Adds a mesh. It goes to the device when a frame is next prepared; meshes that share an [`Arc`] lie there once.
    ///
    /// # Errors
    ///
    /// All meshes together are more than a buffer of the device holds; then it is not added.
    pub fn add(&mut self, mesh: Arc<DeformingMesh>) -> Result<DeformHandle, AddDeformingError> {
        let with_it = Tables::new(self.casters.values().chain([&mesh]));
        with_it.check_sizes(self.most_bytes)?;
        let handle = DeformHandle(self.next_handle);
        self.next_handle += 1;
        self.casters.insert(handle, mesh);
        self.follow(with_it);
        Ok(handle)
    }

    /// Removes a mesh; false where it was not there. The others keep their handles; their positions are elsewhere after
    /// the next [`prepare`](Self::prepare).
    pub fn remove(&mut self, caster: DeformHandle) -> bool {
        let was_there = self.casters.remove(&caster).is_some();
        if was_there {
            self.follow(Tables::new(self.casters.values()));
        }
        was_there
    }

    fn follow(&mut self, tables: Tables) {
        self.tables = tables;
        self.resources = None;
    }

    /// Prepares a frame: uploads joint matrices and weights, and, where meshes came or went, the meshes.
    ///
    /// # Errors
    ///
    /// A pose is missing, is of no mesh here, or has other joints or morph targets than its mesh or numbers that are not
    /// finite; then nothing has changed. Where the device fails, the next prepare makes everything again.
    pub fn prepare(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        inputs: &[DeformInput<'_>],
    ) -> Result<(), DeformError> {
        self.watch.check(device)?;
        let late = self.watch.late();
        self.keep_if(late)?;
        let poses = Poses::new(&self.casters, inputs)?;
        self.upload_bytes = 0;
        if self.casters.is_empty() {
            return Ok(());
        }
        if self.resources.is_none() {
            let scopes = OpenScopes::push(device);
            let pipeline = self.pipeline.get_or_insert_with(|| DeformPipeline::new(device));
            self.resources = Some(DeformResources::new(device, queue, pipeline, &self.tables));
            let made = self.watch.close(device, scopes, self.tables.bytes());
            self.keep_if(made)?;
        }
        if let Some(resources) = &self.resources {
            self.upload_bytes = resources.upload(queue, &poses);
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

    /// Records the stage; nothing where there is no mesh or no frame was prepared since the last one came or went.
    pub fn encode<T: PassTimer>(&self, encoder: &mut wgpu::CommandEncoder, timer: &mut T) {
        if let (Some(pipeline), Some(resources)) = (&self.pipeline, &self.resources) {
            pipeline.encode(encoder, resources, timer);
        }
    }

    /// Where the positions of a mesh lie once the recorded commands have run, for [`CasterInput`](crate::CasterInput)
    /// and, as 12 bytes a vertex, for vertex buffers; none before a frame was prepared with the mesh.
    pub fn positions(&self, caster: DeformHandle) -> Option<Positions> {
        let index = self.casters.keys().position(|&handle| handle == caster)?;
        let buffer = &self.resources.as_ref()?.positions;
        let offset = 4 * u64::from(self.tables.first_position_words[index]);
        Some(Positions::InBuffer { buffer: buffer.clone(), offset, stride: 12 })
    }

    /// Bytes of joint matrices and weights that the last [`prepare`](Self::prepare) uploaded.
    pub fn upload_bytes(&self) -> u64 {
        self.upload_bytes
    }
}
