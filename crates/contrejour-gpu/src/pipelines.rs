//! Pipelines that lights share: each is made when a light's plan first lists it, and dropped when none does.

use std::sync::Arc;

use contrejour_plan::FramePlan;

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
    /// Those of the stages that a plan lists, in order.
    pub fn stages(&mut self, device: &wgpu::Device, plan: &FramePlan) -> Vec<Arc<StagePipeline>> {
        let listed = stages::ALL.iter().filter(|stage| plan.has_stage(stage.stage));
        let pipeline = |description: &'static stages::ComputeStage| {
            if let Some(known) = self.stages.iter().find(|known| known.stage() == description.stage) {
                return Arc::clone(known);
            }
            let made = Arc::new(StagePipeline::new(device, description));
            self.stages.push(Arc::clone(&made));
            made
        };
        listed.map(pipeline).collect()
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
