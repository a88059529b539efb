//! The stages of views that are tested together, and of each of them by its seat.

use std::sync::Arc;

use contrejour_layout::{BundleShape, LightView, SeatCounters, ViewBundle};
use contrejour_plan::{BufferKind, BufferPlan, FramePlan, PagePlan, Stage};

use crate::buffers::Buffers;
use crate::compute::StagePipeline;
use crate::frame::{Recorded, is_same};
use crate::pipelines::Pipelines;
use crate::raster::MapPipeline;
use crate::resources::{Bindings, Whose};
use crate::timer::PassTimer;

/// Pipelines, and bind groups that belong to seats: lights have them in turn.
#[derive(Debug, Default)]
pub(crate) struct Seats {
    /// Those that run once for all views of a bundle, and those that run for one view after the other.
    tests: Vec<Arc<StagePipeline>>,
    extrusion: Vec<Arc<StagePipeline>>,
    /// The passes that bind what a seat has.
    passes: Vec<Arc<MapPipeline>>,
    /// For each of the tests one bind group for each page.
    of_tests: Vec<Vec<wgpu::BindGroup>>,
    seats: Vec<SeatGroups>,
    page_count: usize,
}

/// The bind groups of a seat, for each stage or pass one for each page.
#[derive(Debug)]
struct SeatGroups {
    extrusion: Vec<Vec<wgpu::BindGroup>>,
    passes: Vec<Vec<wgpu::BindGroup>>,
}

/// A view with its plan, and where the records of its light lie.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Seated<'a> {
    pub plan: &'a FramePlan,
    pub of_light: &'a Buffers,
    /// Index among those of the light.
    pub view: usize,
}

const VIEW_BYTES: u64 = size_of::<LightView>() as u64;
const SHAPE_BYTES: u64 = size_of::<BundleShape>() as u64;

/// Seats of the shapes that a buffer of them holds.
const SEAT_COUNTS: [u32; 4] = [1, 2, 4, 8];

impl Seats {
    /// Makes what the plans of all lights need. Bind groups stay where all that they bind is what it was; `has_new_buffers`
    /// says whether that is so for the buffers.
    pub fn follow(
        &mut self,
        device: &wgpu::Device,
        plans: &[FramePlan],
        (shared, pipelines): (&Buffers, &mut Pipelines),
        has_new_buffers: bool,
    ) {
        let Some(FramePlan { seats: seat_count, pages, .. }) = plans.first() else {
            *self = Self::default();
            return;
        };
        let is_test = |stage: &Arc<StagePipeline>| Stage::UP_TO_SILHOUETTES.contains(&stage.stage());
        let (tests, extrusion): (Vec<_>, Vec<_>) = pipelines.stages(device, plans).into_iter().partition(is_test);
        let mut passes: Vec<Arc<MapPipeline>> = Vec::new();
        for pass in plans.iter().flat_map(|plan| pipelines.passes(device, plan)) {
            if pass.is_of_seat() && !passes.iter().any(|known| Arc::ptr_eq(known, &pass)) {
                passes.push(pass);
            }
        }
        let binds_the_same = !has_new_buffers
            && is_same(&self.tests, &tests)
            && is_same(&self.extrusion, &extrusion)
            && is_same(&self.passes, &passes)
            && (self.seats.len(), self.page_count) == (*seat_count as usize, pages.len());
        if binds_the_same {
            return;
        }
        let of_stages = |stages: &[Arc<StagePipeline>], whose| -> Vec<Vec<_>> {
            let bindings = Bindings { shared, whose };
            let of_stage =
                |stage: &Arc<StagePipeline>| (0..pages.len()).map(|page| stage.bind(device, &bindings, page)).collect();
            stages.iter().map(of_stage).collect()
        };
        let seat = |seat: usize| {
            let bindings = Bindings { shared, whose: Whose::Seat(seat) };
            SeatGroups {
                extrusion: of_stages(&extrusion, Whose::Seat(seat)),
                passes: passes.iter().map(|pass| pass.bind_buffers(device, &bindings, pages.len())).collect(),
            }
        };
        let of_tests = of_stages(&tests, Whose::Bundle);
        let seats = (0..*seat_count as usize).map(seat).collect();
        *self = Self { tests, extrusion, passes, of_tests, seats, page_count: pages.len() };
    }

    /// Most views of a bundle; 0 where nothing was made.
    pub fn count(&self) -> usize {
        self.seats.len()
    }

    /// The bind groups of a pass that binds what a seat has.
    pub fn of_pass(&self, pass: &Arc<MapPipeline>, seat: usize) -> &[wgpu::BindGroup] {
        let place = self.passes.iter().position(|known| Arc::ptr_eq(known, pass));
        place.map_or(&[], |place| &self.seats[seat].passes[place])
    }

    /// Gives each view a seat, in their order, and records what is done once for all of them.
    pub fn encode_tests<T: PassTimer>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        shared: &Buffers,
        bundle: &[Seated<'_>],
        recorded: &mut Recorded,
        timer: &mut T,
    ) {
        let Some(Seated { plan: FramePlan { pages, .. }, .. }) = bundle.first() else { return };
        let views = bundle.len() as u64;
        let seats = views.next_power_of_two();
        for page in 0..pages.len() {
            let Some(target) = shared.find(BufferKind::ViewBundle, page) else { continue };
            for (Seated { of_light, view, .. }, seat) in bundle.iter().zip(0..) {
                let records = of_light.get(BufferKind::LightView, page);
                let from = *view as u64 * VIEW_BYTES;
                encoder.copy_buffer_to_buffer(records, from, target, seat * VIEW_BYTES, VIEW_BYTES);
            }
            if views < seats {
                encoder.clear_buffer(target, views * VIEW_BYTES, Some((seats - views) * VIEW_BYTES));
            }
            let shapes = shared.get(BufferKind::BundleShapes, page);
            let from = u64::from(seats.trailing_zeros()) * SHAPE_BYTES;
            encoder.copy_buffer_to_buffer(shapes, from, target, SHAPE_OFFSET, SHAPE_BYTES);
        }
        for counters in shared.all(BufferKind::Counters) {
            encoder.clear_buffer(counters, 0, Some(seats * size_of::<SeatCounters>() as u64));
        }
        let is_needed = |stage| bundle.iter().any(|seated| seated.plan.has_stage(stage));
        let stages = || {
            let all = self.tests.iter().zip(self.of_tests.iter().map(Vec::as_slice));
            all.filter(|(stage, _)| is_needed(stage.stage()))
        };
        encode_stages(encoder, stages, shared, (pages, views as u32), (recorded, timer));
    }

    /// Records the stages that extrude what the tests found for the view of a seat.
    pub fn encode_extrusion<T: PassTimer>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        shared: &Buffers,
        (plan, seat): (&FramePlan, usize),
        (recorded, timer): (&mut Recorded, &mut T),
    ) {
        let stages = || {
            let all = self.extrusion.iter().zip(self.seats[seat].extrusion.iter().map(Vec::as_slice));
            all.filter(|(stage, _)| plan.has_stage(stage.stage()))
        };
        encode_stages(encoder, stages, shared, (&plan.pages, 1), (recorded, timer));
    }
}

/// Where its shape lies in a bundle's record.
const SHAPE_OFFSET: u64 = std::mem::offset_of!(ViewBundle, shape) as u64;

/// Records stages, in one pass where nobody times them.
fn encode_stages<'a, T: PassTimer, I: Iterator<Item = (&'a Arc<StagePipeline>, &'a [wgpu::BindGroup])>>(
    encoder: &mut wgpu::CommandEncoder,
    stages: impl Fn() -> I,
    shared: &Buffers,
    (pages, views): (&[PagePlan], u32),
    (recorded, timer): (&mut Recorded, &mut T),
) {
    if stages().next().is_none() {
        return;
    }
    if !T::TIMES_STAGES {
        let mut pass =
            encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("stages"), timestamp_writes: None });
        stages().for_each(|(stage, groups)| stage.encode(&mut pass, groups, shared, (pages, views), recorded));
        return;
    }
    for (stage, groups) in stages() {
        let name = stage.stage().name();
        let query = timer.begin(name, encoder);
        {
            let mut pass = encoder.begin_compute_pass(&wgpu::ComputePassDescriptor {
                label: Some(name),
                timestamp_writes: T::compute_writes(&query),
            });
            stage.encode(&mut pass, groups, shared, (pages, views), recorded);
        }
        timer.end(query, encoder);
    }
}

/// How 1, 2, 4 and 8 seats share the lists of each page, as far as there are so many.
pub(crate) fn shapes(plan: &FramePlan) -> Vec<[BundleShape; 4]> {
    let stride = |kind: BufferKind, page: usize| {
        let is_it = |listed: &&BufferPlan| listed.kind == kind && (listed.page == page || !kind.is_paged());
        let listed = plan.buffers.iter().find(is_it);
        listed.map_or(0, |listed| (listed.stride() / kind.item_bytes()) as u32)
    };
    let of_page = |page: usize| {
        SEAT_COUNTS.map(|seat_count| BundleShape {
            seat_count,
            seat_shift: seat_count.trailing_zeros(),
            caster_stride: stride(BufferKind::CasterLights, page),
            item_stride: stride(BufferKind::FaceItems, page),
            silhouette_stride: stride(BufferKind::Silhouettes, page),
            outline_stride: stride(BufferKind::OutlineSides, page),
            ..BundleShape::default()
        })
    };
    (0..plan.pages.len()).map(of_page).collect()
}
