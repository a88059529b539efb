//! Everything on the device that a frame plan lists, and the frame's commands.

use contrejour_layout::{Counters, LightView};
use contrejour_plan::{BufferKind, FramePlan, PagePlan};

use crate::compute::StagePipeline;
use crate::passes;
use crate::raster::MapPipeline;
use crate::resources::{Buffers, Textures};
use crate::stages;
use crate::timer::PassTimer;

/// Pipelines, buffers and textures of a light view. They follow the plan: what it lists is made, what it no longer
/// lists is dropped.
#[derive(Debug, Default)]
pub(crate) struct Frame {
    pub buffers: Buffers,
    pub textures: Textures,
    stages: Vec<Bound<StagePipeline>>,
    passes: Vec<Bound<MapPipeline>>,
    /// Pages that the bind groups are for.
    page_count: usize,
}

/// A pipeline with its bind groups, one for each page, which are made again when a buffer or a texture is.
#[derive(Debug)]
struct Bound<P> {
    pipeline: P,
    bind_groups: Vec<wgpu::BindGroup>,
}

impl<P> Bound<P> {
    fn new(pipeline: P) -> Self {
        Self { pipeline, bind_groups: Vec::new() }
    }
}

/// What [`Frame::follow`] made anew.
#[derive(Debug)]
pub(crate) struct Made {
    /// Kinds and pages of buffers.
    pub buffers: Vec<(BufferKind, usize)>,
    pub textures: bool,
}

impl Frame {
    /// Makes what the plan lists, drops what it does not list.
    pub fn follow(&mut self, device: &wgpu::Device, plan: &FramePlan) -> Made {
        let made = Made { buffers: self.buffers.follow(device, plan), textures: self.textures.follow(device, plan) };

        self.stages.retain(|bound| plan.has_stage(bound.pipeline.stage()));
        for (description, order) in stages::ALL.iter().filter(|stage| plan.has_stage(stage.stage)).zip(0..) {
            if self.stages.get(order).is_none_or(|bound| bound.pipeline.stage() != description.stage) {
                self.stages.insert(order, Bound::new(StagePipeline::new(device, description)));
            }
        }
        self.passes.retain(|bound| plan.has_pass(bound.pipeline.pass()));
        for (description, order) in passes::ALL.iter().filter(|pass| plan.has_pass(pass.pass)).zip(0..) {
            if self.passes.get(order).is_none_or(|bound| bound.pipeline.pass() != description.pass) {
                self.passes.insert(order, Bound::new(MapPipeline::new(device, description, plan)));
            }
        }

        let page_count = plan.pages.len();
        let is_stale = !made.buffers.is_empty() || made.textures || page_count != self.page_count;
        self.page_count = page_count;
        for stage in &mut self.stages {
            if is_stale || stage.bind_groups.is_empty() {
                stage.bind_groups =
                    (0..page_count).map(|page| stage.pipeline.bind(device, &self.buffers, page)).collect();
            }
        }
        for pass in &mut self.passes {
            if is_stale || pass.bind_groups.is_empty() {
                pass.bind_groups = pass.pipeline.bind(device, &self.buffers, &self.textures, page_count);
            }
        }
        made
    }

    /// Records the stages and the passes over the maps.
    pub fn encode<T: PassTimer>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        pages: &[PagePlan],
        view: &LightView,
        timer: &mut T,
    ) {
        for counters in self.buffers.all(BufferKind::Counters) {
            encoder.clear_buffer(counters, 0, Some(size_of::<Counters>() as u64));
        }
        for Bound { pipeline, bind_groups } in &self.stages {
            pipeline.encode(encoder, bind_groups, &self.buffers, pages, timer);
        }
        for Bound { pipeline, bind_groups } in &self.passes {
            pipeline.encode(encoder, bind_groups, (&self.buffers, &self.textures), (pages, view), timer);
        }
    }
}
