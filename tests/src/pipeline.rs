//! The whole library on a test mesh, and what a frame leaves on the device.

use std::sync::Arc;

use contrejour_gpu::{
    CasterHandle, CasterInput, LightHandle, Maps, MeshHandle, Positions, PrepareError, ShadowOptions, Shadows, Untimed,
};
use contrejour_layout::{Corner, Counters, Quad, SilhouetteEdge};
use contrejour_plan::{BufferKind, Eye, FramePlan, Light};
use glam::DMat4;

use crate::gpu::Gpu;
use crate::meshes::TestMesh;

/// Frames after which a frame must have had room for everything: one that counts quads, one that has room for them and
/// counts their corners, one that has room for those too.
pub const MAX_FRAMES: u32 = 3;

/// A shadow object with the parts of one mesh as casters, and one light.
#[derive(Debug)]
pub struct Pipeline<'a> {
    /// The library's object.
    pub shadows: Shadows,
    gpu: &'a Gpu,
    options: ShadowOptions,
    parts: Vec<(MeshHandle, DMat4)>,
    casters: Vec<CasterHandle>,
    light: Option<LightHandle>,
    eye: Option<Eye>,
}

impl<'a> Pipeline<'a> {
    /// Makes the object and adds the meshes.
    ///
    /// # Errors
    ///
    /// What the library refuses.
    pub fn new(gpu: &'a Gpu, mesh: &TestMesh, options: &ShadowOptions) -> Result<Self, String> {
        let mut shadows = Shadows::new(&gpu.device).map_err(|error| error.to_string())?;
        let mut parts = Vec::new();
        let mut casters = Vec::new();
        for part in &mesh.parts {
            let mesh = shadows.add_mesh(Arc::clone(&part.topology)).map_err(|error| error.to_string())?;
            parts.push((mesh, part.world_from_object));
            casters.push(shadows.add_caster(&input(parts[parts.len() - 1])).map_err(|error| error.to_string())?);
        }
        Ok(Self { shadows, gpu, options: *options, parts, casters, light: None, eye: None })
    }

    /// Prepares a frame with the light like this.
    ///
    /// # Errors
    ///
    /// What the library refuses.
    ///
    /// # Panics
    ///
    /// When the light, the options or the eye are out of range.
    pub fn prepare(&mut self, light: &Light) -> Result<(), PrepareError> {
        match self.light {
            Some(handle) => self.shadows.set_light(handle, light).expect("the lights of the tests are good"),
            None => {
                let handle = self.shadows.add_light(light, &self.options);
                self.light = Some(handle.expect("lights and options of the tests are good"));
            }
        }
        if let Some((light, eye)) = self.light.zip(self.eye) {
            self.shadows.set_eye(light, &eye).expect("the eyes of the tests are good");
        }
        self.shadows.prepare(&self.gpu.device, &self.gpu.queue)
    }

    /// Lets cascades follow an eye from the next frame on.
    pub fn follow_eye(&mut self, eye: &Eye) {
        self.eye = Some(*eye);
    }

    /// Moves a caster.
    ///
    /// # Panics
    ///
    /// When there is none of this index.
    pub fn place(&mut self, caster: usize, world_from_object: DMat4) {
        self.shadows.place_caster(self.casters[caster], &world_from_object).expect("the caster is there");
    }

    /// Removes the last caster and adds it again.
    ///
    /// # Panics
    ///
    /// When there is none.
    pub fn replace_last(&mut self) {
        let (part, caster) = self.parts.last().zip(self.casters.last_mut()).expect("there is a caster");
        self.shadows.remove_caster(*caster).expect("the caster is there");
        *caster = self.shadows.add_caster(&input(*part)).expect("it was there before");
    }

    /// The light's handle.
    ///
    /// # Panics
    ///
    /// Before the first frame.
    pub fn light(&self) -> LightHandle {
        self.light.expect("a frame was prepared")
    }

    /// The plan of the last frame.
    pub fn plan(&self) -> Option<&FramePlan> {
        self.shadows.plan(self.light?)
    }

    /// The light's maps.
    pub fn maps(&self) -> Maps<'_> {
        self.shadows.maps(self.light())
    }

    /// Prepares and records one frame.
    ///
    /// # Errors
    ///
    /// What the library refuses.
    pub fn record(&mut self, light: &Light) -> Result<wgpu::CommandBuffer, String> {
        self.prepare(light).map_err(|error| error.to_string())?;
        let mut encoder = self.gpu.device.create_command_encoder(&Default::default());
        self.shadows.encode(&mut encoder, &mut Untimed);
        Ok(encoder.finish())
    }

    /// Records and submits one frame and waits for what it counted; zeros where the plan counts nothing.
    ///
    /// # Errors
    ///
    /// What the library refuses.
    pub fn frame(&mut self, light: &Light) -> Result<Counters, String> {
        let commands = self.record(light)?;
        let Gpu { device, queue, .. } = self.gpu;
        queue.submit([commands]);
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
        for (counters, list) in self.shadows.buffers(BufferKind::Counters).zip(self.shadows.buffers(kind)) {
            let counters = self.gpu.read_part(counters, 1)[0];
            let room = list.size() as usize / size_of::<T>();
            records.extend(self.gpu.read_part::<T>(list, room.min(count(&counters) as usize)));
        }
        records
    }
}

fn input((mesh, world_from_object): (MeshHandle, DMat4)) -> CasterInput {
    CasterInput { mesh, world_from_object, positions: Positions::OfMesh }
}
