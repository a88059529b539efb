//! What a light has of its own on the device, and the passes that fill its maps.

use std::sync::Arc;

use contrejour_layout::LightView;
use contrejour_plan::{FramePlan, Pass};

use crate::buffers::Buffers;
use crate::pipelines::Pipelines;
use crate::raster::{DrawnView, MapPipeline};
use crate::resources::{Bindings, Textures, Whose};
use crate::seats::Seats;
use crate::timer::PassTimer;

/// Records, maps and bind groups of a light. They follow its plan: what it lists is made, what it no longer lists is
/// dropped.
#[derive(Debug, Default)]
pub(crate) struct Frame {
    pub buffers: Buffers,
    pub textures: Textures,
    passes: Vec<Arc<MapPipeline>>,
    /// For each view and each pass.
    views: Vec<Vec<PassGroups>>,
    page_count: usize,
}

/// What a pass binds for a view.
#[derive(Debug)]
struct PassGroups {
    /// Buffers, page by page; none where the pass binds those that the view's seat has.
    of_pages: Vec<wgpu::BindGroup>,
    /// The map that it reads, level by level.
    of_levels: Vec<wgpu::BindGroup>,
}

/// How many commands were recorded.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Recorded {
    pub dispatches: u32,
    pub draws: u32,
}

/// What [`Frame::follow`] made anew.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Made {
    pub buffers: bool,
    pub textures: bool,
}

/// Whether they are the same objects.
pub(crate) fn is_same<T>(old: &[Arc<T>], new: &[Arc<T>]) -> bool {
    old.len() == new.len() && old.iter().zip(new).all(|(old, new)| Arc::ptr_eq(old, new))
}

impl Frame {
    /// Makes what the plan lists, drops what it does not list. Bind groups stay where all that they bind is what it was;
    /// `has_new_buffers` says whether that is so for the shared buffers.
    pub fn follow(
        &mut self,
        device: &wgpu::Device,
        plan: &FramePlan,
        view_count: usize,
        (shared, pipelines): (&Buffers, &mut Pipelines),
        has_new_buffers: bool,
    ) -> Made {
        let of_light = plan.buffers.iter().filter(|buffer| buffer.kind.is_of_light());
        let made = Made {
            buffers: !self.buffers.follow(device, of_light).is_empty(),
            textures: self.textures.follow(device, plan),
        };
        let passes = pipelines.passes(device, plan);
        let page_count = plan.pages.len();
        let binds_the_same = !has_new_buffers
            && !made.buffers
            && !made.textures
            && is_same(&self.passes, &passes)
            && (self.views.len(), self.page_count) == (view_count, page_count);
        if binds_the_same {
            return made;
        }
        (self.passes, self.page_count) = (passes, page_count);
        let groups = |view: usize| {
            let bindings = Bindings { shared, whose: Whose::View(&self.buffers, view) };
            let of_pass = |pass: &Arc<MapPipeline>| {
                let is_of_seat = pass.is_of_seat();
                let of_pages = if is_of_seat { Vec::new() } else { pass.bind_buffers(device, &bindings, page_count) };
                PassGroups { of_pages, of_levels: pass.bind_map(device, &self.textures, view) }
            };
            self.passes.iter().map(of_pass).collect()
        };
        self.views = (0..view_count).map(groups).collect();
        made
    }

    /// Records the passes over the maps of a view that has a seat.
    pub fn encode<T: PassTimer>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        (plan, record): (&FramePlan, &LightView),
        (shared, seats): (&Buffers, &Seats),
        (view, seat): (usize, usize),
        (recorded, timer): (&mut Recorded, &mut T),
    ) {
        let drawn = DrawnView { view, seat, record, pages: &plan.pages };
        for (pipeline, of_pages, of_levels) in self.bound_passes(seats, (view, seat)) {
            pipeline.encode(encoder, (of_pages, of_levels), (shared, &self.textures), &drawn, recorded, timer);
        }
    }

    /// Draws the triangles of a pass with fragments of the caller's; says whether there is that pass.
    pub fn draw_again(
        &self,
        device: &wgpu::Device,
        (pass, fragment, into): (Pass, &wgpu::FragmentState<'_>, &mut wgpu::RenderPass<'_>),
        (plan, record): (&FramePlan, &LightView),
        (shared, seats): (&Buffers, &Seats),
        (view, seat): (usize, usize),
    ) -> bool {
        let drawn = DrawnView { view, seat, record, pages: &plan.pages };
        let found = self.bound_passes(seats, (view, seat)).find(|(pipeline, ..)| pipeline.pass() == pass);
        let Some((pipeline, of_pages, of_levels)) = found else { return false };
        pipeline.draw_again(device, (fragment, into), (of_pages, of_levels.first()), shared, &drawn);
        true
    }

    /// The passes with what they bind for a view that has a seat: buffers page by page, and maps level by level.
    fn bound_passes<'a>(
        &'a self,
        seats: &'a Seats,
        (view, seat): (usize, usize),
    ) -> impl Iterator<Item = (&'a MapPipeline, &'a [wgpu::BindGroup], &'a [wgpu::BindGroup])> {
        self.passes.iter().zip(&self.views[view]).map(move |(pipeline, own)| {
            let of_pages = if pipeline.is_of_seat() { seats.of_pass(pipeline, seat) } else { &own.of_pages };
            (&**pipeline, of_pages, &own.of_levels[..])
        })
    }
}
