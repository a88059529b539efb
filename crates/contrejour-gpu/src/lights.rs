//! The lights of a scene: what is known of each, and what it has on the device.

use contrejour_layout::{Counters, LightView, ReceiverView, VIEW_CULLS, VIEW_TESTS};
use contrejour_plan::{
    BufferKind, BufferPlan, Capacity, CascadeError, DeviceFacts, Eye, FramePlan, FrameViews, LeftOut, Light, LightKind,
    Omitted, Outputs, Pass, PlanError, PlanInput, Reason, SceneFacts, Stage, View, ViewChoice, frame_views,
};

use crate::buffers::Buffers;
use crate::caster_places::Extent;
use crate::error::ShadowLightError;
use crate::frame::{Frame, Made, Recorded};
use crate::inputs::ShadowOptions;
use crate::pipelines::Pipelines;
use crate::readback::{Copying, CountedPage, Page};
use crate::seats::{Seated, Seats};
use crate::slots::Key;
use crate::timer::PassTimer;
use crate::visibility::Visibility;

/// Names a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct LightHandle(pub(crate) Key);

/// A light with its views, its plan and its maps.
#[derive(Debug)]
pub(crate) struct LightState {
    pub options: ShadowOptions,
    pub choice: ViewChoice,
    light: Light,
    /// What cascades follow.
    eye: Option<Eye>,
    /// Without views while a cascaded light has no eye.
    seen: FrameViews,
    /// What is made for it; `None` before the first frame.
    pub plan: Option<FramePlan>,
    pub frame: Frame,
    pub visibility: Option<Visibility>,
    pub counters: Option<Counters>,
    records: Records,
    latest_is_complete: bool,
    /// Whether its records are to be uploaded.
    has_new_records: bool,
    /// Whether its maps are to be made, or made anew.
    is_due: bool,
}

/// What a light uploads.
#[derive(Clone, Debug, Default, PartialEq)]
struct Records {
    /// Those of all views on the first page, then on the next: pages differ in their counts.
    light_views: Vec<LightView>,
    receiver_views: Vec<ReceiverView>,
}

/// What decides a light's plan beside its options and the scene.
fn shape(views: &[View]) -> (usize, bool) {
    (views.len(), views.iter().any(|view| view.light_size > 0.0))
}

fn seen(light: &Light, eye: Option<&Eye>, options: &ShadowOptions) -> Result<FrameViews, ShadowLightError> {
    light.validate()?;
    let waits_for_eye = matches!(light.kind, LightKind::Cascaded { .. }) && eye.is_none();
    if waits_for_eye { Ok(FrameViews::default()) } else { Ok(frame_views(light, eye, &options.settings)?) }
}

impl LightState {
    /// # Errors
    ///
    /// The light or the settings are out of range.
    pub fn new(light: &Light, options: &ShadowOptions) -> Result<Self, ShadowLightError> {
        options.settings.validate()?;
        Ok(Self {
            options: *options,
            choice: ViewChoice::of(&light.kind),
            light: *light,
            eye: None,
            seen: seen(light, None, options)?,
            plan: None,
            frame: Frame::default(),
            visibility: None,
            counters: None,
            records: Records::default(),
            latest_is_complete: false,
            has_new_records: true,
            is_due: true,
        })
    }

    /// Takes another state of the light over; says whether that needs another plan.
    ///
    /// # Errors
    ///
    /// The light is out of range; then nothing has changed.
    pub fn change(&mut self, light: &Light) -> Result<bool, ShadowLightError> {
        self.look(light, self.eye)
    }

    /// Lets cascades follow an eye; says whether that needs another plan.
    ///
    /// # Errors
    ///
    /// The eye is out of range, or the light has no cascades for it; then nothing has changed.
    pub fn follow_eye(&mut self, eye: &Eye) -> Result<bool, ShadowLightError> {
        eye.validate().map_err(CascadeError::from)?;
        let light = self.light;
        self.look(&light, Some(*eye))
    }

    fn look(&mut self, light: &Light, eye: Option<Eye>) -> Result<bool, ShadowLightError> {
        let seen = seen(light, eye.as_ref(), &self.options)?;
        let choice = ViewChoice::of(&light.kind);
        let needs_plan = shape(&self.seen.views) != shape(&seen.views) || self.choice != choice;
        // Cascades move by whole texels: within one the maps stand, and only receivers learn of the eye.
        self.is_due |= self.seen.views != seen.views;
        self.has_new_records |= self.seen != seen;
        (self.light, self.eye, self.seen, self.choice) = (*light, eye, seen, choice);
        Ok(needs_plan)
    }

    /// Its views.
    pub fn view_count(&self) -> usize {
        self.seen.views.len()
    }

    /// Whether it is cascaded and has no eye.
    pub fn needs_eye(&self) -> bool {
        self.seen.views.is_empty()
    }

    /// # Errors
    ///
    /// The device can't hold what the light needs.
    pub fn plan(
        &self,
        scene: &SceneFacts,
        device: &DeviceFacts,
        capacity: Capacity,
        all_views: usize,
        (shared, made): (&[BufferKind], &[BufferPlan]),
    ) -> Result<FramePlan, PlanError> {
        let ShadowOptions { settings, outputs, .. } = &self.options;
        let (views, outputs) = (&self.seen.views[..], *outputs);
        FramePlan::new(&PlanInput { scene, views, all_views, settings, device, outputs, capacity, shared, made })
    }

    /// Makes what a plan lists for this light. `has_new_buffers` says whether some shared ones are not those that they were.
    pub fn follow(
        &mut self,
        device: &wgpu::Device,
        plan: FramePlan,
        (shared, pipelines): (&Buffers, &mut Pipelines),
        has_new_buffers: bool,
    ) {
        let views = self.seen.views.len();
        let made = self.frame.follow(device, &plan, views, (shared, pipelines), has_new_buffers);
        if made.buffers {
            self.records = Records::default();
        }
        self.follow_visibility(device, &plan, made);
        self.is_due |= made.textures || self.plan.as_ref().is_none_or(|old| old.stages != plan.stages);
        self.has_new_records = true;
        self.plan = Some(plan);
    }

    fn follow_visibility(&mut self, device: &wgpu::Device, plan: &FramePlan, made: Made) {
        let Frame { buffers, textures, .. } = &self.frame;
        let kind = plan.visibility.map(|kind| (kind, self.choice));
        if self.visibility.as_ref().map(|visibility| (visibility.kind, visibility.choice)) != kind {
            self.visibility = kind.map(|(kind, choice)| Visibility::new(device, kind, choice, buffers, textures));
        } else if let Some(visibility) = &mut self.visibility
            && (made.textures || made.buffers)
        {
            visibility.bind_again(device, buffers, textures);
        }
    }

    /// Drops everything that was made, where the device failed.
    pub fn drop_made(&mut self) {
        self.plan = None;
        self.frame = Frame::default();
        self.visibility = None;
        self.latest_is_complete = false;
        self.is_due = true;
    }

    /// Notes where something was or is.
    pub fn note_touched(&mut self, touched: &[Extent]) {
        let sees = |extent: &Extent| match extent {
            Extent::Nowhere => false,
            Extent::Everywhere => true,
            Extent::Box(bounds) => {
                self.seen.views.iter().any(|view| view.can_see(bounds, view.reach_ndc(&self.options.settings)))
            }
        };
        // The list of silhouette edges does not end where the maps do.
        let is_everywhere = self.options.outputs == Outputs::Silhouettes && !touched.is_empty();
        self.is_due = self.is_due || is_everywhere || touched.iter().any(sees);
    }

    /// Lets its maps be made anew.
    pub fn make_due(&mut self) {
        self.is_due = true;
    }

    /// Uploads records that changed; returns their bytes.
    pub fn upload(&mut self, queue: &wgpu::Queue) -> u64 {
        let Some(plan) = &mut self.plan else { return 0 };
        let mut bytes = 0;
        if std::mem::take(&mut self.has_new_records) {
            let before = std::mem::replace(&mut self.records, Records::new(&self.seen, plan));
            let mut write = |(kind, page), data: &[u8]| {
                if let Some(buffer) = self.frame.buffers.find(kind, page) {
                    queue.write_buffer(buffer, 0, data);
                    bytes += data.len() as u64;
                }
            };
            if before.light_views != self.records.light_views {
                for (views, page) in self.records.light_views.chunks(self.seen.views.len()).zip(0..) {
                    write((BufferKind::LightView, page), bytemuck::cast_slice(views));
                }
            }
            if before.receiver_views != self.records.receiver_views {
                write((BufferKind::ReceiverView, 0), bytemuck::cast_slice(&self.records.receiver_views));
            }
        }
        // Told frame by frame.
        let kept = LeftOut { what: Omitted::Redrawing, reason: Reason::NothingChanged };
        plan.left_out.retain(|left_out| *left_out != kept);
        if !self.is_due {
            plan.left_out.push(kept);
        }
        bytes
    }

    pub fn is_due(&self) -> bool {
        self.is_due
    }

    /// One of its views, to be given a seat; `None` before the first frame.
    pub fn seated(&self, view: usize) -> Option<Seated<'_>> {
        Some(Seated { plan: self.plan.as_ref()?, of_light: &self.frame.buffers, view })
    }

    /// Records what fills the maps of a view from what was found for its seat, and copies what that counted.
    pub fn encode_view<T: PassTimer>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        (shared, seats): (&Buffers, &Seats),
        (view, seat): (usize, usize),
        counted: Option<(Key, &mut Copying<'_>)>,
        (recorded, timer): (&mut Recorded, &mut T),
    ) {
        let Some(plan) = &self.plan else { return };
        seats.encode_extrusion(encoder, shared, (plan, seat), (recorded, timer));
        let of_view = (plan, &self.records.light_views[view]);
        self.frame.encode(encoder, of_view, (shared, seats), (view, seat), (recorded, timer));
        if let Some((light, counted)) = counted.filter(|_| self.counts()) {
            for (counters, page) in shared.parts(BufferKind::Counters, seat).zip(&plan.pages) {
                counted.copy(encoder, counters, Page { light, capacity: page.capacity() });
            }
        }
    }

    /// Draws the triangles of a pass over a view once more; says whether the plan has that pass.
    pub fn draw_again(
        &self,
        device: &wgpu::Device,
        with: (Pass, &wgpu::FragmentState<'_>, &mut wgpu::RenderPass<'_>),
        (shared, seats): (&Buffers, &Seats),
        (view, seat): (usize, usize),
    ) -> bool {
        let Some(plan) = &self.plan else { return false };
        let of_view = (plan, &self.records.light_views[view]);
        self.frame.draw_again(device, with, of_view, (shared, seats), (view, seat))
    }

    /// Notes that its maps were made. Where it counts and its counters can't be copied, it stays due: its maps may lack what
    /// did not fit.
    pub fn note_recorded(&mut self, is_counted: bool) {
        self.is_due = self.counts() && !is_counted;
    }

    /// Takes what the pages of a frame counted. Returns the room that was missing.
    pub fn take_counters(&mut self, pages: &[CountedPage]) -> Option<Capacity> {
        let too_small = pages.iter().filter(|page| !page.is_complete());
        let missing = too_small.map(|page| page.page.capacity.grown_for(&page.counters)).reduce(Capacity::max);
        self.latest_is_complete = missing.is_none();
        self.counters = Some(pages.iter().map(|page| page.counters).sum());
        self.is_due |= missing.is_some();
        missing
    }

    /// Pages whose counters a frame sends back: none where no stage counts.
    pub fn counted_pages(&self) -> usize {
        let counting = self.plan.as_ref().filter(|plan| !plan.stages.is_empty());
        counting.map_or(0, |plan| plan.pages.len() * self.seen.views.len())
    }

    /// Whether its stages count anything.
    fn counts(&self) -> bool {
        self.counted_pages() > 0
    }

    /// Whether its latest counted frame had room for everything.
    pub fn is_complete(&self) -> bool {
        self.plan.is_some() && (!self.counts() || self.latest_is_complete)
    }
}

impl Records {
    fn new(seen: &FrameViews, plan: &FramePlan) -> Self {
        let views = &seen.views;
        // The list of silhouette edges does not end where the maps do.
        let everywhere = if plan.outputs == Outputs::Silhouettes { VIEW_CULLS } else { 0 };
        let untested = if plan.has_stage(Stage::ClassifyFaces) { 0 } else { VIEW_TESTS };
        let has_edges = plan.has_stage(Stage::DetectSilhouette);
        let light_view = |view: &View, page: usize| {
            let record = view.light_view(&plan.settings, &plan.pages[page].counts);
            let edge_block_count = if has_edges { record.edge_block_count } else { 0 };
            LightView { flags: record.flags & !everywhere & !untested, edge_block_count, ..record }
        };
        let of_page = |page| views.iter().map(move |view| light_view(view, page));
        Self {
            light_views: (0..plan.pages.len()).flat_map(of_page).collect(),
            receiver_views: seen.receiver_views(&plan.settings),
        }
    }
}
