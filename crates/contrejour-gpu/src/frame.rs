//! What a light has of its own on the device, and the commands that fill its maps.

use std::sync::Arc;

use contrejour_layout::{Counters, LightView};
use contrejour_plan::{BufferKind, FramePlan};

use crate::compute::StagePipeline;
use crate::pipelines::Pipelines;
use crate::raster::{DrawnView, MapPipeline};
use crate::readback::{Copying, Page};
use crate::resources::{Bindings, Buffers, Textures};
use crate::slots::Key;
use crate::timer::PassTimer;

/// Records, maps and bind groups of a light. They follow its plan: what it lists is made, what it no longer lists is
/// dropped.
#[derive(Debug, Default)]
pub(crate) struct Frame {
    pub buffers: Buffers,
    pub textures: Textures,
    stages: Vec<Arc<StagePipeline>>,
    passes: Vec<Arc<MapPipeline>>,
    views: Vec<ViewGroups>,
    page_count: usize,
}

/// The bind groups of a view.
#[derive(Debug)]
struct ViewGroups {
    /// For each stage one for each page.
    stages: Vec<Vec<wgpu::BindGroup>>,
    /// For each pass one for each page, level by level.
    passes: Vec<Vec<wgpu::BindGroup>>,
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

fn is_same<T>(old: &[Arc<T>], new: &[Arc<T>]) -> bool {
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
        let (stages, passes) = (pipelines.stages(device, plan), pipelines.passes(device, plan));
        let page_count = plan.pages.len();
        let binds_the_same = !has_new_buffers
            && !made.buffers
            && !made.textures
            && is_same(&self.stages, &stages)
            && is_same(&self.passes, &passes)
            && (self.views.len(), self.page_count) == (view_count, page_count);
        if binds_the_same {
            return made;
        }
        (self.stages, self.passes, self.page_count) = (stages, passes, page_count);
        let groups = |view: usize| {
            let bindings = Bindings { shared, of_light: &self.buffers, view };
            let of_stage =
                |stage: &Arc<StagePipeline>| (0..page_count).map(|page| stage.bind(device, &bindings, page)).collect();
            let of_pass = |pass: &Arc<MapPipeline>| pass.bind(device, &bindings, &self.textures, page_count);
            ViewGroups {
                stages: self.stages.iter().map(of_stage).collect(),
                passes: self.passes.iter().map(of_pass).collect(),
            }
        };
        self.views = (0..view_count).map(groups).collect();
        made
    }

    /// Records the stages and the passes over the maps, view by view, and copies what each counted. `records` are those of
    /// the views on the first page; `after` is called behind each view.
    pub fn encode<T: PassTimer>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        (plan, shared, records): (&FramePlan, &Buffers, &[LightView]),
        (light, mut counted): (Key, Option<&mut Copying<'_>>),
        timer: &mut T,
        mut after: impl FnMut(&mut wgpu::CommandEncoder, usize),
    ) -> Recorded {
        let mut recorded = Recorded::default();
        for ((groups, record), view) in self.views.iter().zip(records).zip(0..) {
            for counters in shared.all(BufferKind::Counters) {
                encoder.clear_buffer(counters, 0, Some(size_of::<Counters>() as u64));
            }
            self.encode_stages(encoder, plan, shared, groups, &mut recorded, timer);
            let drawn = DrawnView { view, record, pages: &plan.pages };
            for (pipeline, bind_groups) in self.passes.iter().zip(&groups.passes) {
                pipeline.encode(encoder, bind_groups, (shared, &self.textures), &drawn, &mut recorded, timer);
            }
            if let Some(counted) = &mut counted {
                for (counters, page) in shared.all(BufferKind::Counters).zip(&plan.pages) {
                    counted.copy(encoder, counters, Page { light, capacity: page.capacity() });
                }
            }
            after(encoder, view);
        }
        recorded
    }

    fn encode_stages<T: PassTimer>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        plan: &FramePlan,
        shared: &Buffers,
        groups: &ViewGroups,
        recorded: &mut Recorded,
        timer: &mut T,
    ) {
        let stages = || self.stages.iter().zip(&groups.stages);
        if !T::TIMES_STAGES {
            if !self.stages.is_empty() {
                let mut pass = encoder
                    .begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("stages"), timestamp_writes: None });
                stages().for_each(|(stage, groups)| stage.encode(&mut pass, groups, shared, &plan.pages, recorded));
            }
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
                stage.encode(&mut pass, groups, shared, &plan.pages, recorded);
            }
            timer.end(query, encoder);
        }
    }
}
