//! The whole library on a test mesh, and what a frame leaves on the device.

use std::sync::Arc;

use contrejour_gpu::{CasterInput, FrameInput, MeshHandle, Positions, PrepareError, ShadowOptions, Shadows, Untimed};
use contrejour_layout::{Corner, Counters, Quad, SilhouetteEdge};
use contrejour_plan::{BufferKind, Light};
use glam::DMat4;

use crate::gpu::Gpu;
use crate::meshes::TestMesh;

/// Frames after which a frame must have had room for everything: one that counts quads, one that has room for them and
/// counts their corners, one that has room for those too.
pub const MAX_FRAMES: u32 = 3;

/// A shadow object with the parts of one mesh as casters.
#[derive(Debug)]
pub struct Pipeline<'a> {
    /// The library's object.
    pub shadows: Shadows,
    gpu: &'a Gpu,
    casters: Vec<(MeshHandle, DMat4)>,
}

impl<'a> Pipeline<'a> {
    /// Makes the object and adds the meshes.
    ///
    /// # Errors
    ///
    /// What the library refuses.
    pub fn new(gpu: &'a Gpu, mesh: &TestMesh, options: &ShadowOptions) -> Result<Self, String> {
        let mut shadows = Shadows::new(&gpu.device, options).map_err(|error| error.to_string())?;
        let mut casters = Vec::new();
        for part in &mesh.parts {
            let handle = shadows.add_mesh(Arc::clone(&part.topology)).map_err(|error| error.to_string())?;
            casters.push((handle, part.world_from_object));
        }
        Ok(Self { shadows, gpu, casters })
    }

    /// Prepares a frame.
    ///
    /// # Errors
    ///
    /// What the library refuses.
    pub fn prepare(&mut self, light: &Light) -> Result<(), PrepareError> {
        let casters: Vec<_> = self
            .casters
            .iter()
            .map(|&(mesh, world_from_object)| CasterInput { mesh, world_from_object, positions: Positions::OfMesh })
            .collect();
        self.shadows.prepare(&self.gpu.device, &self.gpu.queue, &FrameInput { light, casters: &casters })
    }

    /// Moves a caster.
    pub fn place(&mut self, caster: usize, world_from_object: DMat4) {
        self.casters[caster].1 = world_from_object;
    }

    /// Lets two casters change places.
    pub fn swap(&mut self, caster: usize, other: usize) {
        self.casters.swap(caster, other);
    }

    /// Prepares and submits one frame and waits for what it counted; zeros where the plan counts nothing.
    ///
    /// # Errors
    ///
    /// What the library refuses.
    pub fn frame(&mut self, light: &Light) -> Result<Counters, String> {
        let _waiting = self.gpu.waiting();
        self.prepare(light).map_err(|error| error.to_string())?;
        let Gpu { device, queue, .. } = self.gpu;
        let mut encoder = device.create_command_encoder(&Default::default());
        self.shadows.encode(&mut encoder, &mut Untimed);
        queue.submit([encoder.finish()]);
        if self.shadows.buffer(BufferKind::Counters).is_none() {
            return Ok(Counters::default());
        }
        self.shadows.wait_for_counters(device).map_err(|error| error.to_string())
    }

    /// Repeats the frame until it had room for everything.
    ///
    /// # Errors
    ///
    /// What the library refuses, or that it needs more frames than it may.
    pub fn complete_frame(&mut self, light: &Light) -> Result<Counters, String> {
        for _ in 0..MAX_FRAMES {
            let counters = self.frame(light)?;
            if self.shadows.is_complete() {
                return Ok(counters);
            }
        }
        Err(format!("not complete after {MAX_FRAMES} frames"))
    }

    /// The silhouette lists of the last frame, page after page.
    pub fn silhouettes(&self) -> Vec<SilhouetteEdge> {
        self.records(BufferKind::Silhouettes, |counters| counters.silhouette_edges)
    }

    /// The quads of the last frame, page after page, as far as there was room.
    pub fn quads(&self) -> Vec<Quad> {
        self.records(BufferKind::Quads, |counters| counters.quads)
    }

    /// The corners of the last frame, page after page, as far as there was room.
    pub fn corners(&self) -> Vec<Corner> {
        self.records(BufferKind::Corners, |counters| counters.corners)
    }

    fn records<T: bytemuck::Pod>(&self, kind: BufferKind, count: impl Fn(&Counters) -> u32) -> Vec<T> {
        let mut records = Vec::new();
        for (counters, buffer) in self.shadows.buffers(BufferKind::Counters).zip(self.shadows.buffers(kind)) {
            let counters = self.gpu.read_back(counters, 1)[0];
            let room = buffer.size() as usize / size_of::<T>();
            records.extend(self.gpu.read_back::<T>(buffer, room.min(count(&counters) as usize)));
        }
        records
    }
}
