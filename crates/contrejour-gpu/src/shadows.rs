//! The one object that a renderer talks to.

use std::sync::Arc;
use std::time::{Duration, Instant};

use contrejour_layout::{Counters, EyeView};
use contrejour_mesh::TopologyAwareMesh;
use contrejour_plan::{
    BufferKind, Capacity, DeviceFacts, FramePlan, Omitted, PagePlan, Stage, TextureKind, VisibilityKind,
};

use crate::casters::CasterSet;
use crate::device_watch::{DeviceWatch, OpenScopes};
use crate::draft::{FrameDraft, LiveCopy, Records};
use crate::error::{AddMeshError, CountersError, DeviceError, NewShadowsError, PrepareError};
use crate::frame::{Frame, Made};
use crate::heartbeat::poll;
use crate::inputs::{FrameInput, FrameStats, Maps, ShadowOptions, device_facts};
use crate::pool::{MeshHandle, MeshPool};
use crate::readback::{CounterReadback, READBACK_BYTES};
use crate::timer::PassTimer;
use crate::visibility::{EyeInput, Visibility};
use crate::visibility_wgsl::visibility_wgsl;

/// Silhouettes and shadow maps of one light.
#[derive(Debug)]
pub struct Shadows {
    options: ShadowOptions,
    device_facts: DeviceFacts,
    pool: MeshPool,
    frame: Frame,
    plan: Option<FramePlan>,
    casters: CasterSet,
    capacity: Capacity,
    records: Records,
    copies: Vec<LiveCopy>,
    readback: CounterReadback,
    watch: DeviceWatch,
    visibility: Option<Visibility>,
    stats: FrameStats,
    latest_is_complete: bool,
    /// Whether the maps hold, or will hold after submission, what `records` say.
    is_encoded: bool,
}

impl Shadows {
    /// Features that the library can't do without: none.
    pub fn required_features() -> wgpu::Features {
        wgpu::Features::empty()
    }

    /// Features that the library uses where the device was created with them: blending of 32-bit floats saves a pass,
    /// and where samplers weigh them variance shadow maps are exact.
    pub fn optional_features() -> wgpu::Features {
        wgpu::Features::FLOAT32_BLENDABLE | wgpu::Features::FLOAT32_FILTERABLE
    }

    /// Limits that the library needs: WebGPU's defaults.
    pub fn required_limits() -> wgpu::Limits {
        wgpu::Limits::default()
    }

    /// Makes an object for one light. Nothing that depends on a scene is created yet.
    ///
    /// # Errors
    ///
    /// The device allows less than WebGPU's defaults, the settings are out of range, or the device fails.
    pub fn new(device: &wgpu::Device, options: &ShadowOptions) -> Result<Self, NewShadowsError> {
        let available = device.limits().max_storage_buffers_per_shader_stage;
        let needed = Self::required_limits().max_storage_buffers_per_shader_stage;
        if available < needed {
            return Err(NewShadowsError::Limits { available, needed });
        }
        let device_facts = device_facts(device);
        options.settings.validate()?;
        let scopes = OpenScopes::push(device);
        let readback = CounterReadback::new(device);
        let watch = DeviceWatch::new(device, scopes, READBACK_BYTES)?;
        Ok(Self {
            options: *options,
            device_facts,
            pool: MeshPool::default(),
            frame: Frame::default(),
            plan: None,
            casters: CasterSet::default(),
            capacity: Capacity::default(),
            records: Records::default(),
            copies: Vec::new(),
            readback,
            watch,
            visibility: None,
            stats: FrameStats::default(),
            latest_is_complete: false,
            is_encoded: false,
        })
    }

    /// Adds a mesh. It is kept, and goes to the device when a frame first needs it there.
    ///
    /// # Errors
    ///
    /// The positions of all meshes together are more than 32 bits can index.
    pub fn add_mesh(&mut self, mesh: Arc<TopologyAwareMesh>) -> Result<MeshHandle, AddMeshError> {
        self.pool.add(mesh, &self.device_facts).map_err(|words| AddMeshError::PoolTooLarge { words })
    }

    /// Prepares a frame: follows the frame plan, uploads the records of light and casters.
    ///
    /// What the plan newly lists is created here and what it no longer lists is dropped; a frame in which only lights
    /// and casters move creates nothing and uploads their records alone. Lists that an earlier frame found too short
    /// grow here.
    ///
    /// # Errors
    ///
    /// The light or a caster is not valid, or the plan lists more than the device allows; then nothing has changed. Where
    /// the device itself fails ([`PrepareError::Device`]), what was made is dropped, and the next prepare makes all of it
    /// again; until then there are no maps, as before the first.
    pub fn prepare(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        input: &FrameInput<'_>,
    ) -> Result<(), PrepareError> {
        self.watch.check(device)?;
        let late = self.watch.late();
        self.keep_if(late)?;
        self.collect_counters();
        let draft = FrameDraft::new(input, &self.pool, &self.options, &self.device_facts, self.capacity)?;
        let set_up_bytes = self.follow(device, queue, &draft)?;
        self.upload(queue, draft, set_up_bytes);
        Ok(())
    }

    /// Records the frame: compute stages, then the passes that fill the maps. Nothing is recorded where the frame is
    /// like the one before and that one was complete, since its maps stand.
    ///
    /// The encoder's commands must be submitted, or dropped together with this object.
    pub fn encode<T: PassTimer>(&mut self, encoder: &mut wgpu::CommandEncoder, timer: &mut T) {
        let Some(plan) = self.plan.as_ref().filter(|_| !self.stats.is_unchanged) else { return };
        for copy in &self.copies {
            let target = self.frame.buffers.get(BufferKind::Positions, 0);
            encoder.copy_buffer_to_buffer(&copy.source, copy.source_offset, target, copy.target_offset, copy.size);
        }
        self.is_encoded = true;
        let [view, ..] = self.records.light_views.as_slice() else { return };
        self.frame.encode(encoder, &plan.pages, view, timer);
        if self.counts() {
            let capacities = plan.pages.iter().map(PagePlan::capacity).collect();
            self.readback.copy(encoder, self.frame.buffers.all(BufferKind::Counters), capacities);
        }
    }

    /// Records the full-screen visibility of a deferred renderer's pixels into `eye.target`.
    ///
    /// # Errors
    ///
    /// The device fails, or does not draw into the options' `visibility_format`; then nothing was recorded.
    ///
    /// # Panics
    ///
    /// Before the first [`prepare`](Self::prepare).
    pub fn encode_visibility<T: PassTimer>(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        encoder: &mut wgpu::CommandEncoder,
        eye: &EyeInput<'_>,
        timer: &mut T,
    ) -> Result<(), DeviceError> {
        let format = self.options.visibility_format;
        let Some(visibility) = &mut self.visibility else { panic!("{NOT_PREPARED}") };
        let scopes = OpenScopes::push(device);
        let (pass, shadow) = visibility.pass(device, format);
        let eye_group = pass.bind_eye(device, queue, eye);
        if let Err(error) = self.watch.close(device, scopes, EYE_BYTES) {
            visibility.drop_pass();
            return Err(error);
        }
        pass.encode(encoder, eye, [&eye_group, shadow], timer);
        Ok(())
    }

    /// Which maps the visibility function reads. A later [`prepare`](Self::prepare) changes it only where smoothies
    /// come or go: the light gains or loses its size, the first caster comes or the last one goes.
    ///
    /// # Panics
    ///
    /// Before the first [`prepare`](Self::prepare), and where the options want no maps.
    pub fn visibility_kind(&self) -> VisibilityKind {
        self.visibility().kind
    }

    /// WGSL text with the function `contrejour_visibility(position_world: vec3f, normal_world: vec3f) -> f32` and its
    /// bindings in the given bind group; append it to a shader. All its names start with `contrejour`, but for the
    /// struct `ReceiverView`. Normals have unit length and
    /// are those of the side that is seen: a side averted from the light is dark. 0 is dark, 1 is lit; points outside the
    /// light's maps are lit.
    ///
    /// # Panics
    ///
    /// As [`visibility_kind`](Self::visibility_kind).
    pub fn visibility_wgsl(&self, group: u32) -> String {
        visibility_wgsl(self.visibility_kind(), group)
    }

    /// Layout of [`visibility_bind_group`](Self::visibility_bind_group).
    ///
    /// # Panics
    ///
    /// As [`visibility_kind`](Self::visibility_kind).
    pub fn visibility_layout(&self) -> &wgpu::BindGroupLayout {
        &self.visibility().layout
    }

    /// The bind group of the visibility function. A later [`prepare`](Self::prepare) may replace it.
    ///
    /// # Panics
    ///
    /// As [`visibility_kind`](Self::visibility_kind).
    pub fn visibility_bind_group(&self) -> &wgpu::BindGroup {
        &self.visibility().bind_group
    }

    fn visibility(&self) -> &Visibility {
        match &self.visibility {
            Some(visibility) => visibility,
            None => panic!("{NOT_PREPARED}"),
        }
    }

    /// The maps themselves, after the first [`prepare`](Self::prepare).
    pub fn maps(&self) -> Maps<'_> {
        let find = |kind| self.frame.textures.find(kind);
        Maps {
            shadow_depth: find(TextureKind::ShadowDepth),
            shadow_hardware_depth: find(TextureKind::ShadowHardwareDepth),
            moments: find(TextureKind::Moments),
            smoothie_depth: find(TextureKind::SmoothieDepth),
            smoothie_alpha: find(TextureKind::SmoothieAlpha),
            smoothie_buffer: find(TextureKind::SmoothieBuffer),
        }
    }

    /// A buffer of the frame, where the plan lists it: the silhouette list and its counters stay here for stages of
    /// the caller's. A later [`prepare`](Self::prepare) may replace it. Where a scene fills several pages this is the
    /// first one's: [`buffers`](Self::buffers) are all.
    pub fn buffer(&self, kind: BufferKind) -> Option<&wgpu::Buffer> {
        self.frame.buffers.find(kind, 0)
    }

    /// The buffers of a kind: one for each of the [plan's pages](FramePlan::pages), or one that serves all pages. A
    /// scene has more than one page where its meshes are too large for the device's buffers.
    pub fn buffers(&self, kind: BufferKind) -> impl Iterator<Item = &wgpu::Buffer> {
        self.frame.buffers.all(kind)
    }

    /// The plan of the last prepared frame.
    pub fn plan(&self) -> Option<&FramePlan> {
        self.plan.as_ref()
    }

    /// What is known so far.
    pub fn stats(&self) -> FrameStats {
        self.stats
    }

    /// Whether the latest counted frame had room for all its quads and corners. While it had not, prepare and encode
    /// once more.
    pub fn is_complete(&self) -> bool {
        self.plan.is_some() && (!self.counts() || self.latest_is_complete)
    }

    /// Whether the frame counts anything.
    fn counts(&self) -> bool {
        self.frame.buffers.find(BufferKind::Counters, 0).is_some()
    }

    /// Waits until the submitted frames are done and returns the counters of the last one. For tools and tests: a
    /// frame loop has no need to wait.
    ///
    /// # Errors
    ///
    /// The device was lost, or no frame that counts was submitted.
    pub fn wait_for_counters(&mut self, device: &wgpu::Device) -> Result<Counters, CountersError> {
        self.stats.readback_waits += 1;
        poll(device, wgpu::PollType::wait_indefinitely())?;
        self.watch.check(device)?;
        // Another thread that polls the same device may still have our callback to run.
        let patience = Instant::now() + CALLBACK_PATIENCE;
        while self.readback.is_pending() {
            if Instant::now() > patience {
                return Err(CountersError::NotSubmitted);
            }
            std::thread::yield_now();
        }
        self.collect_counters();
        self.stats.counters.ok_or(CountersError::NoFrame)
    }

    /// Takes the counters that have arrived: counts overflows and grows what was too short.
    fn collect_counters(&mut self) {
        for pages in self.readback.arrived() {
            self.latest_is_complete = pages.iter().all(|page| page.capacity.holds(&page.counters));
            self.stats.overflow_frames += u64::from(!self.latest_is_complete);
            // Where a page lacks room all get it: what moves may next be on another one.
            for page in &pages {
                let grown = page.capacity.grown_for(&page.counters);
                if !page.capacity.holds(&page.counters) {
                    self.capacity.quads = self.capacity.quads.max(grown.quads);
                    self.capacity.corners = self.capacity.corners.max(grown.corners);
                }
            }
            self.stats.counters = Some(pages.iter().map(|page| page.counters).sum());
        }
    }

    /// Makes and fills what the draft's plan lists; returns the bytes that it uploaded. A frame that needs nothing new
    /// opens no error scope.
    fn follow(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, draft: &FrameDraft) -> Result<u64, DeviceError> {
        let has_changed = self.plan.as_ref() != Some(&draft.plan);
        let has_new_casters = self.casters != draft.casters;
        if !has_changed && !has_new_casters {
            return Ok(0);
        }
        let scopes = OpenScopes::push(device);
        let bytes = self.make(device, queue, draft);
        let made = self.watch.close(device, scopes, planned_bytes(&draft.plan));
        self.keep_if(made)?;
        Ok(bytes)
    }

    fn make(&mut self, device: &wgpu::Device, queue: &wgpu::Queue, draft: &FrameDraft) -> u64 {
        let made = self.frame.follow(device, &draft.plan);
        self.follow_visibility(device, &draft.plan, &made);
        self.readback.make_room(device, draft.plan.pages.len());

        let mut bytes = 0;
        let mut write = |(kind, page): (BufferKind, usize), offset: u64, data: &[u8]| {
            if let Some(buffer) = self.frame.buffers.find(kind, page).filter(|_| !data.is_empty()) {
                queue.write_buffer(buffer, offset, data);
                bytes += data.len() as u64;
            }
        };
        if made.buffers.contains(&(BufferKind::Positions, 0)) {
            self.pool.fill_positions(|offset, data| write((BufferKind::Positions, 0), offset, data));
        }
        // Where nobody reads planes, their buffer has no room for them.
        let without_planes =
            |plan: &FramePlan| plan.reason(&Omitted::FacePlanes).is_some() || !plan.has_stage(Stage::ClassifyFaces);
        let lacks_planes = without_planes(&draft.plan);
        let lacked_planes = self.plan.as_ref().is_none_or(without_planes);
        let old_pages = self.plan.as_ref().map_or(&[][..], |plan| &plan.pages);
        for (page, index) in draft.plan.pages.iter().zip(0..) {
            let holds_others = old_pages.get(index).is_none_or(|old| old.pieces != page.pieces);
            // The buffer of one face is as large as one without planes.
            let has_new_planes = lacked_planes || holds_others || made.buffers.contains(&(BufferKind::Planes, index));
            if has_new_planes && !lacks_planes {
                self.pool.fill_planes(page, |offset, data| write((BufferKind::Planes, index), offset, data));
            }
            for kind in MESH_POOLS {
                if holds_others || made.buffers.contains(&(kind, index)) {
                    self.pool.fill(kind, page, |offset, data| write((kind, index), offset, data));
                }
            }
        }
        for (table, page) in draft.casters.tables(&self.pool, &draft.plan.pages).iter().zip(0..) {
            write((BufferKind::Casters, page), 0, bytemuck::cast_slice(&table.casters));
            write((BufferKind::FaceBlocks, page), 0, bytemuck::cast_slice(&table.face_blocks));
            write((BufferKind::EdgeBlocks, page), 0, bytemuck::cast_slice(&table.edge_blocks));
        }
        bytes
    }

    /// Drops everything that was made where the device failed, so that no later frame uses something half-made.
    fn keep_if(&mut self, made: Result<(), DeviceError>) -> Result<(), DeviceError> {
        if made.is_err() {
            self.frame = Frame::default();
            self.visibility = None;
            self.readback.drop_room();
            self.plan = None;
            self.casters = CasterSet::default();
            self.latest_is_complete = false;
            self.is_encoded = false;
        }
        made
    }

    fn follow_visibility(&mut self, device: &wgpu::Device, plan: &FramePlan, made: &Made) {
        let Frame { buffers, textures, .. } = &self.frame;
        let kind = plan.visibility;
        if self.visibility.as_ref().map(|visibility| visibility.kind) != kind {
            self.visibility = kind.map(|kind| Visibility::new(device, kind, buffers, textures));
        } else if let Some(visibility) = &mut self.visibility
            && (made.textures || made.buffers.contains(&(BufferKind::ReceiverView, 0)))
        {
            visibility.bind_again(device, buffers, textures);
        }
    }

    /// Uploads the frame's records and takes the draft over.
    fn upload(&mut self, queue: &wgpu::Queue, draft: FrameDraft, set_up_bytes: u64) {
        let FrameDraft { plan, casters, records, singular_casters, copies } = draft;
        let is_same = self.plan.as_ref() == Some(&plan)
            && set_up_bytes == 0
            && copies.is_empty()
            && self.records == records
            && self.casters == casters;
        self.stats.is_unchanged = is_same && self.is_encoded;
        self.stats.upload_bytes = 0;
        self.stats.set_up_bytes = set_up_bytes;
        self.stats.singular_casters = singular_casters;
        if !is_same {
            let mut write = |(kind, page), bytes: &[u8]| {
                if let Some(buffer) = self.frame.buffers.find(kind, page).filter(|_| !bytes.is_empty()) {
                    queue.write_buffer(buffer, 0, bytes);
                    self.stats.upload_bytes += bytes.len() as u64;
                }
            };
            if self.records.caster_places != records.caster_places || set_up_bytes > 0 {
                write((BufferKind::CasterPlaces, 0), bytemuck::cast_slice(&records.caster_places));
            }
            for (light_view, page) in records.light_views.iter().zip(0..) {
                write((BufferKind::LightView, page), bytemuck::bytes_of(light_view));
            }
            write((BufferKind::ReceiverView, 0), bytemuck::bytes_of(&records.receiver_view));
            self.is_encoded = false;
        }
        self.plan = Some(plan);
        self.casters = casters;
        self.records = records;
        self.copies = copies;
    }
}

fn planned_bytes(plan: &FramePlan) -> u64 {
    let buffers = plan.buffers.iter().map(|buffer| buffer.bytes);
    buffers.chain(plan.textures.iter().map(|texture| texture.bytes)).sum()
}

/// The pools that meshes fill page by page.
const MESH_POOLS: [BufferKind; 4] =
    [BufferKind::Faces, BufferKind::Edges, BufferKind::Incidences, BufferKind::VertexEdges];

/// How long a callback may take once the device is idle.
const CALLBACK_PATIENCE: Duration = Duration::from_secs(2);

/// Bytes that the full-screen pass needs: the record of the eye.
const EYE_BYTES: u64 = size_of::<EyeView>() as u64;

const NOT_PREPARED: &str = "no maps yet: call `prepare` first, with options that want maps";
