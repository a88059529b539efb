//! Everything on the device that a frame plan lists, and the frame's commands.

use contrejour_layout::{Counters, LightView};
use contrejour_plan::{BufferKind, FramePlan, ViewCounts};

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
}

/// A pipeline with its bind groups, which are made again when a buffer or a texture is.
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
    pub buffers: Vec<BufferKind>,
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

        let is_stale = !made.buffers.is_empty() || made.textures;
        for stage in &mut self.stages {
            if is_stale || stage.bind_groups.is_empty() {
                stage.bind_groups = vec![stage.pipeline.bind(device, &self.buffers)];
            }
        }
        for pass in &mut self.passes {
            if is_stale || pass.bind_groups.is_empty() {
                pass.bind_groups = pass.pipeline.bind(device, &self.buffers, &self.textures);
            }
        }
        made
    }

    /// Records the stages and the passes over the maps.
    pub fn encode<T: PassTimer>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        counts: &ViewCounts,
        view: &LightView,
        timer: &mut T,
    ) {
        if let Some(counters) = self.buffers.find(BufferKind::Counters) {
            encoder.clear_buffer(counters, 0, Some(size_of::<Counters>() as u64));
        }
        for Bound { pipeline, bind_groups } in &self.stages {
            for bind_group in bind_groups {
                pipeline.encode(encoder, bind_group, &self.buffers, counts, timer);
            }
        }
        for Bound { pipeline, bind_groups } in &self.passes {
            pipeline.encode(encoder, bind_groups, (&self.buffers, &self.textures), (counts, view), timer);
        }
    }
}
