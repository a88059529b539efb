//! The one object that a renderer talks to.

use std::sync::Arc;
use std::time::{Duration, Instant};

use contrejour_layout::Counters;
use contrejour_mesh::{MaskedMesh, TopologyAwareMesh};
use contrejour_plan::{BufferKind, Capacity, DeviceFacts, Eye, FramePlan, Light};
use glam::DMat4;

use crate::casters::{CasterHandle, CasterInput, Casters, KnownPositions};
use crate::device_watch::{DeviceWatch, OpenScopes};
use crate::error::{AddMeshError, CasterError, CountersError, NewShadowsError, RemoveMeshError, ShadowLightError};
use crate::heartbeat::poll;
use crate::inputs::{FrameStats, ShadowOptions, device_facts};
use crate::lights::{LightHandle, LightState};
use crate::pool::{MeshHandle, MeshPool};
use crate::readback::CounterReadback;
use crate::scene_buffers::SceneBuffers;
use crate::slots::{Key, Slots};

/// Silhouettes and shadow maps of all lights of a scene.
///
/// Meshes, casters and lights are added, changed and removed by handles at any time; a frame uploads what changed and
/// makes the maps of those lights that see a change.
///
/// What stays is not touched by what comes and goes. On the device each mesh and each caster has places of its own for as
/// long as it is there; what comes gets a place that something left, or lies behind the others. So the frame after it
/// uploads the mesh, the caster's record and its blocks, 12 bytes for each 64 faces or edges, and where a list grew 128 bytes
/// that say so, whatever else there is; what goes costs as many bytes of blocks at most. Nothing is waited for.
///
/// - A buffer is as large as the first frame needs it. One that gets too small grows to half more than is needed, by a copy on
///   the device; while that runs both are there. One that has room is kept, also where less would do.
/// - Where a large pool fills less than a quarter of its buffer (from 2^20 records or words, or from 16 384 blocks), all
///   buffers are made anew, as large as needed, and all that is left is uploaded again.
/// - A scene that fills several [pages](FramePlan::pages) is packed anew whenever meshes or casters come or go, but for
///   positions; one that fills a page only for its holes is packed first.
/// - Where a light first needs a pool, as smoothies need edges, or where the first caster comes, it is filled with all meshes.
#[derive(Debug)]
pub struct Shadows {
    pub(crate) device_facts: DeviceFacts,
    pub(crate) meshes: MeshPool,
    pub(crate) casters: Casters,
    pub(crate) lights: Slots<LightState>,
    pub(crate) buffers: SceneBuffers,
    pub(crate) capacity: Capacity,
    pub(crate) readback: CounterReadback,
    pub(crate) watch: DeviceWatch,
    pub(crate) stats: FrameStats,
    /// The seat of the view that was recorded last.
    pub(crate) last_seat: usize,
    /// Views that are recorded; kept, so that no frame allocates.
    pub(crate) due: Vec<(Key, usize)>,
    /// Whether what is made may not be what is needed: something came or went, or lists were too short.
    pub(crate) is_stale: bool,
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

    /// Makes an object for a scene without anything in it. Nothing that depends on a scene is created yet.
    ///
    /// # Errors
    ///
    /// The device allows less than WebGPU's defaults, or fails.
    pub fn new(device: &wgpu::Device) -> Result<Self, NewShadowsError> {
        let available = device.limits().max_storage_buffers_per_shader_stage;
        let needed = Self::required_limits().max_storage_buffers_per_shader_stage;
        if available < needed {
            return Err(NewShadowsError::Limits { available, needed });
        }
        let scopes = OpenScopes::push(device);
        let readback = CounterReadback::new(device);
        let watch = DeviceWatch::new(device, scopes, 0)?;
        Ok(Self {
            device_facts: device_facts(device),
            meshes: MeshPool::default(),
            casters: Casters::default(),
            lights: Slots::default(),
            buffers: SceneBuffers::default(),
            capacity: Capacity::default(),
            readback,
            watch,
            stats: FrameStats::default(),
            last_seat: 0,
            due: Vec::new(),
            is_stale: true,
        })
    }

    /// Adds a mesh. It is kept, and goes to the device when a frame first needs it there.
    ///
    /// # Errors
    ///
    /// The positions of all meshes together are more than 32 bits can index; then it is not added.
    pub fn add_mesh(&mut self, mesh: Arc<TopologyAwareMesh>) -> Result<MeshHandle, AddMeshError> {
        let handle = self.meshes.add(mesh, &self.device_facts);
        self.is_stale = true;
        handle.map_err(|words| AddMeshError::PoolTooLarge { words })
    }

    /// Adds a mesh whose faces a mask cuts. Its casters are in the shadow maps with their holes and have neither silhouettes
    /// nor smoothies: [the plan](contrejour_plan::FramePlan::left_out) says so for each.
    ///
    /// # Errors
    ///
    /// The positions of all meshes together, or their masks, are more than 32 bits can index.
    pub fn add_masked_mesh(&mut self, mesh: &Arc<MaskedMesh>) -> Result<MeshHandle, AddMeshError> {
        self.is_stale = true;
        self.meshes.add_masked(mesh, &self.device_facts)
    }

    /// Removes a mesh. Its handle names nothing any more, and meshes that come later lie where it lay.
    ///
    /// # Errors
    ///
    /// Casters stand on it, or there is no such mesh; then nothing has changed.
    pub fn remove_mesh(&mut self, mesh: MeshHandle) -> Result<(), RemoveMeshError> {
        let casters = self.casters.count_on(mesh);
        if casters > 0 {
            return Err(RemoveMeshError::StillCasts { mesh, casters });
        }
        if !self.meshes.remove(mesh) {
            return Err(RemoveMeshError::UnknownMesh { mesh });
        }
        self.is_stale = true;
        Ok(())
    }

    /// Adds a caster: one place of one mesh.
    ///
    /// # Errors
    ///
    /// The mesh was not added here, or a buffer of positions does not hold what the mesh needs.
    pub fn add_caster(&mut self, caster: &CasterInput) -> Result<CasterHandle, CasterError> {
        let handle = self.casters.add(caster, &mut self.meshes)?;
        self.is_stale = true;
        Ok(handle)
    }

    /// Moves a caster.
    ///
    /// # Errors
    ///
    /// There is no such caster.
    pub fn place_caster(&mut self, caster: CasterHandle, world_from_object: &DMat4) -> Result<(), CasterError> {
        self.casters.place(caster, world_from_object)
    }

    /// Says which positions a caster's own buffer holds, and where. To be called when they change, or in each frame: what is
    /// known already changes nothing.
    ///
    /// # Errors
    ///
    /// There is no such caster, it has the positions of its mesh, or the box is none; then nothing has changed.
    pub fn note_positions(&mut self, caster: CasterHandle, known: &KnownPositions) -> Result<(), CasterError> {
        self.casters.note_positions(caster, known)
    }

    /// Removes a caster. Its handle names nothing any more.
    ///
    /// # Errors
    ///
    /// There is no such caster.
    pub fn remove_caster(&mut self, caster: CasterHandle) -> Result<(), CasterError> {
        self.casters.remove(caster, &mut self.meshes)?;
        self.is_stale = true;
        Ok(())
    }

    /// Adds a light. One that is cascaded needs an eye before the next frame; see [`set_eye`](Self::set_eye).
    ///
    /// # Errors
    ///
    /// The light or the settings are out of range.
    pub fn add_light(&mut self, light: &Light, options: &ShadowOptions) -> Result<LightHandle, ShadowLightError> {
        let state = LightState::new(light, options)?;
        self.is_stale = true;
        Ok(LightHandle(self.lights.insert(state)))
    }

    /// Moves or changes a light; how its shadow is made stays.
    ///
    /// # Errors
    ///
    /// The light is out of range, or there is none of this handle; then nothing has changed.
    pub fn set_light(&mut self, handle: LightHandle, light: &Light) -> Result<(), ShadowLightError> {
        let state = self.lights.get_mut(handle.0).ok_or(ShadowLightError::UnknownLight { light: handle })?;
        self.is_stale |= state.change(light)?;
        Ok(())
    }

    /// Says which eye a light's cascades follow: the camera whose picture the light falls on. To be called in each frame in
    /// which that moves or turns. Maps follow it by whole texels: while that moves none, they stand, and a frame uploads
    /// where receivers are looked up and nothing else. Lights of other kinds keep it for when they become cascaded.
    ///
    /// # Errors
    ///
    /// The eye is out of range, the light's maps are too small for cascades, or there is no such light; then nothing has
    /// changed.
    pub fn set_eye(&mut self, handle: LightHandle, eye: &Eye) -> Result<(), ShadowLightError> {
        let state = self.lights.get_mut(handle.0).ok_or(ShadowLightError::UnknownLight { light: handle })?;
        self.is_stale |= state.follow_eye(eye)?;
        Ok(())
    }

    /// Removes a light with its maps. Its handle names nothing any more.
    ///
    /// # Errors
    ///
    /// There is no such light.
    pub fn remove_light(&mut self, handle: LightHandle) -> Result<(), ShadowLightError> {
        self.lights.remove(handle.0).ok_or(ShadowLightError::UnknownLight { light: handle })?;
        self.is_stale = true;
        Ok(())
    }

    /// Lets the maps of all lights be made anew in the next frame, whether or not anything changed.
    pub fn redraw(&mut self) {
        self.lights.iter_mut().for_each(|(_, light)| light.make_due());
    }

    /// A buffer of the frame, where a plan lists it: the silhouette list and its counters stay here for stages of the
    /// caller's. Counters may count more than a list has room for, until it [grew](Self::is_complete).
    ///
    /// Views that are tested together have [parts of their own](contrejour_plan::Seating) of a list, and the next ones fill
    /// them anew: this is the part of the last view of the last light that was recorded, as it can be bound; of lists that
    /// views have test by test, such as lit bits, it is all of them ([`FilledView`](crate::FilledView) knows the seat). A
    /// later [`prepare`](Self::prepare) may replace the buffer. Where a scene fills several pages this is the first one's:
    /// [`buffers`](Self::buffers) are all.
    pub fn buffer(&self, kind: BufferKind) -> Option<wgpu::BufferSlice<'_>> {
        self.buffers(kind).next()
    }

    /// The buffers of a kind: one for each of the [plan's pages](FramePlan::pages), or one that serves all pages. A
    /// scene has more than one page where its meshes are too large for the device's buffers. Those [of a
    /// light](BufferKind::is_of_light) are the last light's.
    pub fn buffers(&self, kind: BufferKind) -> impl Iterator<Item = wgpu::BufferSlice<'_>> {
        let of_light = self.lights.iter().last().filter(|_| kind.is_of_light());
        let buffers = of_light.map_or(self.buffers.shared(), |(_, light)| &light.frame.buffers);
        buffers.parts(kind, self.last_seat)
    }

    /// The plan of the last prepared frame of a light.
    pub fn plan(&self, light: LightHandle) -> Option<&FramePlan> {
        self.lights.get(light.0)?.plan.as_ref()
    }

    /// What is known so far.
    pub fn stats(&self) -> FrameStats {
        self.stats
    }

    /// Whether the latest counted frame of each light had room for all its silhouette edges, quads and corners. While it
    /// had not, prepare and encode once more.
    pub fn is_complete(&self) -> bool {
        !self.is_stale && self.lights.iter().all(|(_, light)| light.is_complete())
    }

    /// Waits until the submitted frames are done and returns the counters of the last one, of all lights together. For
    /// tools and tests: a frame loop has no need to wait.
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
    pub(crate) fn collect_counters(&mut self) {
        self.readback.take_arrived(|frame| {
            for pages in frame.chunk_by(|one, next| one.page.light == next.page.light) {
                let Some(light) = self.lights.get_mut(pages[0].page.light) else { continue };
                // Where a page lacks room all get it: what moves may next be on another one.
                if let Some(missing) = light.take_counters(pages) {
                    self.stats.overflow_frames += 1;
                    self.capacity = self.capacity.max(missing);
                    self.is_stale = true;
                }
            }
        });
        let counted = self.lights.iter().filter_map(|(_, light)| light.counters);
        self.stats.counters = counted.reduce(|one, other| [one, other].into_iter().sum());
    }
}

/// How long a callback may take once the device is idle.
const CALLBACK_PATIENCE: Duration = Duration::from_secs(2);
