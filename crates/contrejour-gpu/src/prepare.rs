//! Preparing a frame: what is needed is made, what changed is uploaded.

use contrejour_layout::BLOCK_SIZE;
use contrejour_plan::{BufferKind, BufferPlan, FramePlan, PlanError, PoolHoles, SceneFacts, shared_plans};

use crate::device_watch::OpenScopes;
use crate::error::{DeviceError, PrepareError};
use crate::lights::LightHandle;
use crate::shadows::Shadows;

/// Buffers with room for fewer records or words stay as they are.
const LEAST_SHRUNK_ITEMS: u64 = 1 << 20;

/// As many blocks, beside which lists of all their faces and edges are kept.
const LEAST_SHRUNK_BLOCKS: u64 = LEAST_SHRUNK_ITEMS / BLOCK_SIZE as u64;

impl Shadows {
    /// Prepares a frame: follows the frame plans of all lights, uploads the records of lights and casters that changed.
    ///
    /// What a plan newly lists is created here and what none lists any more is dropped; a frame in which only lights and
    /// casters move creates nothing and uploads their records alone. Lists that an earlier frame found too short grow here,
    /// and so do pools that have no room for what came: that submits a copy of what they hold, and waits for nothing.
    ///
    /// # Errors
    ///
    /// A cascaded light has no eye, or the plans list more than the device allows; then nothing has changed, and the next
    /// prepare tries again. Where the device itself fails ([`PrepareError::Device`]), what was made is dropped, and the next
    /// prepare makes all of it again; until then there are no maps, as before the first.
    pub fn prepare(&mut self, device: &wgpu::Device, queue: &wgpu::Queue) -> Result<(), PrepareError> {
        self.watch.check(device)?;
        let late = self.watch.late();
        self.keep_if(late)?;
        if let Some((key, _)) = self.lights.iter_mut().find(|(_, light)| light.needs_eye()) {
            return Err(PrepareError::NoEye { light: LightHandle(key) });
        }
        self.collect_counters();
        self.stats.set_up_bytes = 0;
        self.casters.stand(&self.meshes);
        if self.is_stale {
            let plans = self.plans_of_packed()?;
            self.follow(device, queue, plans)?;
            self.is_stale = false;
        }
        self.upload(queue);
        Ok(())
    }

    /// The plans of all lights. What lies in the pools stays where it is, but where nothing is on the device yet, where that
    /// is much too large for what is left, and where holes would cost a page: then everything moves together.
    fn plans_of_packed(&mut self) -> Result<Vec<FramePlan>, PlanError> {
        if self.buffers.shared().is_empty() || self.is_mostly_unused() {
            self.pack();
        }
        let plans = self.plans();
        let has_one_page = matches!(&plans, Ok(plans) if plans.iter().all(|plan| plan.pages.len() == 1));
        if has_one_page || self.holes() == PoolHoles::default() {
            return plans;
        }
        self.pack();
        self.plans()
    }

    /// Moves everything together, without holes. The buffers are dropped: all of it is uploaded again.
    fn pack(&mut self) {
        self.buffers.drop_buffers();
        self.meshes.pack();
        self.casters.pack(&mut self.meshes);
    }

    fn holes(&self) -> PoolHoles {
        let PoolHoles { face_blocks, edge_blocks, .. } = self.casters.holes();
        PoolHoles { face_blocks, edge_blocks, ..self.meshes.holes() }
    }

    /// Whether a pool or a list of blocks fills less than a quarter of its buffer, and that is large.
    fn is_mostly_unused(&self) -> bool {
        let is_mostly_unused = |buffer: &BufferPlan| {
            let (used, least) = match buffer.kind {
                BufferKind::FaceBlocks | BufferKind::EdgeBlocks => {
                    (self.casters.used(buffer.kind), LEAST_SHRUNK_BLOCKS)
                }
                kind => (self.meshes.used(kind), LEAST_SHRUNK_ITEMS),
            };
            used.is_some_and(|used| buffer.items >= least && buffer.items / 4 > used)
        };
        self.buffers.made().iter().any(is_mostly_unused)
    }

    /// The plans of all lights, in their order.
    fn plans(&self) -> Result<Vec<FramePlan>, PlanError> {
        let (meshes, pieces) = self.meshes.facts();
        let casters = self.casters.facts(&self.meshes.indices());
        let (receivers, masks, holes) = (Vec::new(), self.meshes.masks().facts(), self.holes());
        let scene = SceneFacts { meshes, pieces, casters, receivers, masks, holes };
        let made = self.buffers.made();
        let all_views = self.lights.iter().map(|(_, light)| light.view_count()).sum();
        let plans = |shared: &[BufferKind]| -> Result<Vec<_>, PlanError> {
            let plan = |(_, light): (usize, &crate::lights::LightState)| {
                light.plan(&scene, &self.device_facts, self.capacity, all_views, (shared, made))
            };
            self.lights.iter().map(plan).collect()
        };
        shared_plans(plans)
    }

    /// Makes and fills what the plans list.
    fn follow(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, plans: Vec<FramePlan>) -> Result<(), DeviceError> {
        let bytes = plans.iter().map(planned_bytes).sum();
        let scopes = OpenScopes::push(device);
        let set_up = self.buffers.follow(device, queue, &plans, (&mut self.meshes, &mut self.casters));
        self.stats.set_up_bytes = set_up.bytes;
        if set_up.has_new_buffers {
            self.last_seat = 0;
        }
        for ((_, light), plan) in self.lights.iter_mut().zip(plans) {
            light.follow(device, plan, self.buffers.shared_and_pipelines(), set_up.has_new_buffers);
        }
        let counted_pages = self.lights.iter().map(|(_, light)| light.counted_pages()).sum();
        self.readback.make_room(device, counted_pages);
        self.buffers.drop_unused();
        let made = self.watch.close(device, scopes, bytes);
        self.keep_if(made)
    }

    /// Drops everything that was made where the device failed, so that no later frame uses something half-made.
    fn keep_if(&mut self, made: Result<(), DeviceError>) -> Result<(), DeviceError> {
        if made.is_err() {
            self.buffers = Default::default();
            self.last_seat = 0;
            self.readback.drop_room();
            self.lights.iter_mut().for_each(|(_, light)| light.drop_made());
            self.is_stale = true;
        }
        made
    }

    /// Uploads what changed, and decides whose maps are made.
    fn upload(&mut self, queue: &wgpu::Queue) {
        let has_unknown_positions = self.casters.have_unknown_positions();
        for (_, light) in self.lights.iter_mut() {
            light.note_touched(self.casters.touched());
            if has_unknown_positions {
                light.make_due();
            }
        }
        let mut bytes = self.buffers.upload_places(queue, &mut self.casters);
        for (_, light) in self.lights.iter_mut() {
            bytes += light.upload(queue);
        }
        let due = self.lights.iter().filter(|(_, light)| light.is_due()).count() as u32;
        self.stats.upload_bytes = bytes;
        self.stats.lights_redone = due;
        self.stats.lights_kept = self.lights.iter().count() as u32 - due;
        self.stats.singular_casters = self.casters.singular_count();
    }
}

fn planned_bytes(plan: &FramePlan) -> u64 {
    let buffers = plan.buffers.iter().map(|buffer| buffer.bytes);
    buffers.chain(plan.textures.iter().map(|texture| texture.bytes)).sum()
}
