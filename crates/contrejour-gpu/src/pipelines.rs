//! Pipelines that lights share: each is made when a light's plan first lists it, and dropped when none does.

use std::sync::Arc;

use contrejour_plan::{EntryPoints, FramePlan, PipelinePlan};

use crate::compute::StagePipeline;
use crate::passes;
use crate::raster::MapPipeline;
use crate::stages;

#[derive(Debug, Default)]
pub(crate) struct Pipelines {
    stages: Vec<Arc<StagePipeline>>,
    passes: Vec<Arc<MapPipeline>>,
}

impl Pipelines {
    /// Those of the stages that some plan lists, in order.
    pub fn stages(&mut self, device: &wgpu::Device, plans: &[FramePlan]) -> Vec<Arc<StagePipeline>> {
        let pipeline = |description: &'static stages::ComputeStage| {
            let is_of_stage = |planned: &&PipelinePlan| planned.entry_points == EntryPoints::Compute(description.stage);
            let plan = plans.iter().find(|plan| plan.has_stage(description.stage))?;
            let planned: Vec<_> = plan.pipelines.iter().filter(is_of_stage).cloned().collect();
            if let Some(known) = self.stages.iter().find(|known| known.fits(description, &planned)) {
                return Some(Arc::clone(known));
            }
            let made = Arc::new(StagePipeline::new(device, description, planned));
            self.stages.push(Arc::clone(&made));
            Some(made)
        };
        stages::ALL.iter().filter_map(pipeline).collect()
    }

    /// Those of the passes that a plan lists, in order.
    pub fn passes(&mut self, device: &wgpu::Device, plan: &FramePlan) -> Vec<Arc<MapPipeline>> {
        let listed = passes::ALL.iter().filter(|pass| plan.has_pass(pass.pass));
        let pipeline = |description: &'static passes::MapPass| {
            if let Some(known) = self.passes.iter().find(|known| known.fits(description, plan)) {
                return Arc::clone(known);
            }
            let made = Arc::new(MapPipeline::new(device, description, plan));
            self.passes.push(Arc::clone(&made));
            made
        };
        listed.map(pipeline).collect()
    }

    /// Drops those that no light uses any more.
    pub fn drop_unused(&mut self) {
        self.stages.retain(|pipeline| Arc::strong_count(pipeline) > 1);
        self.passes.retain(|pipeline| Arc::strong_count(pipeline) > 1);
    }
}
