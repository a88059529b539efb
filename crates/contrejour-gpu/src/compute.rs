//! A compute stage on the device: its pipeline, its bind group, its dispatch.

use contrejour_layout::{BLOCK_SIZE, DispatchArgs, MAX_GROUPS_X};
use contrejour_plan::{PagePlan, PipelinePlan, Stage, ViewCounts};

use crate::buffers::Buffers;
use crate::frame::Recorded;
use crate::resources::{Bindings, binding_type};
use crate::stages::{ComputeStage, Dispatch};

/// The pipeline of a stage.
#[derive(Debug)]
pub(crate) struct StagePipeline {
    description: &'static ComputeStage,
    /// As plans list them.
    planned: Vec<PipelinePlan>,
    layout: wgpu::BindGroupLayout,
    /// For bundles of one view first, for larger ones last.
    pipelines: Vec<wgpu::ComputePipeline>,
}

impl StagePipeline {
    pub fn new(device: &wgpu::Device, description: &'static ComputeStage, planned: Vec<PipelinePlan>) -> Self {
        let name = description.stage.name();
        let entries: Vec<_> = description
            .stage
            .buffers()
            .iter()
            .zip(0..)
            .map(|(kind, binding)| wgpu::BindGroupLayoutEntry {
                binding,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: wgpu::BindingType::Buffer {
                    ty: binding_type(*kind, !description.writes.contains(kind)),
                    has_dynamic_offset: false,
                    min_binding_size: None,
                },
                count: None,
            })
            .collect();
        let layout =
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: Some(name), entries: &entries });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(name),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(name),
            source: wgpu::ShaderSource::Wgsl(description.wgsl.into()),
        });
        let pipeline = |planned: &PipelinePlan| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: Some(name),
                layout: Some(&pipeline_layout),
                module: &module,
                entry_point: Some(name),
                compilation_options: wgpu::PipelineCompilationOptions {
                    constants: &planned.constants,
                    ..Default::default()
                },
                cache: None,
            })
        };
        let pipelines = planned.iter().map(pipeline).collect();
        Self { description, planned, layout, pipelines }
    }

    /// Whether it has the pipelines that plans list for its stage.
    pub fn fits(&self, description: &ComputeStage, planned: &[PipelinePlan]) -> bool {
        self.stage() == description.stage && self.planned == planned
    }

    pub fn stage(&self) -> Stage {
        self.description.stage
    }

    /// The bind group of a page.
    pub fn bind(&self, device: &wgpu::Device, bindings: &Bindings<'_>, page: usize) -> wgpu::BindGroup {
        bindings.bind(device, self.stage().name(), &self.layout, (self.stage().buffers(), page))
    }

    /// Records the stage over all pages, for so many views where it works on several; counts its dispatches.
    pub fn encode(
        &self,
        pass: &mut wgpu::ComputePass<'_>,
        bind_groups: &[wgpu::BindGroup],
        buffers: &Buffers,
        (pages, views): (&[PagePlan], u32),
        recorded: &mut Recorded,
    ) {
        pass.set_pipeline(&self.pipelines[if views == 1 { 0 } else { self.pipelines.len() - 1 }]);
        for ((page, bind_group), index) in pages.iter().zip(bind_groups).zip(0..) {
            if self.description.dispatch == Dispatch::Casters && index > 0 {
                continue;
            }
            recorded.dispatches += 1;
            pass.set_bind_group(0, bind_group, &[]);
            match self.description.dispatch {
                Dispatch::Casters => {
                    let [x, y] = folded(page.counts.casters.div_ceil(BLOCK_SIZE));
                    pass.dispatch_workgroups(x, y, views);
                }
                Dispatch::Blocks => {
                    let ViewCounts { face_blocks, edge_blocks, .. } = page.counts;
                    dispatch(pass, face_blocks.div_ceil(BLOCK_SIZE) + edge_blocks.div_ceil(BLOCK_SIZE));
                }
                Dispatch::Once => pass.dispatch_workgroups(1, 1, 1),
                Dispatch::Indirect(kind, entry) => {
                    let offset = u64::from(entry) * size_of::<DispatchArgs>() as u64;
                    pass.dispatch_workgroups_indirect(buffers.get(kind, index), offset);
                }
            }
        }
    }
}

/// Folded into two dimensions.
pub(crate) fn dispatch(pass: &mut wgpu::ComputePass<'_>, groups: u32) {
    let [x, y] = folded(groups);
    pass.dispatch_workgroups(x, y, 1);
}

fn folded(groups: u32) -> [u32; 2] {
    [groups.min(MAX_GROUPS_X), groups.div_ceil(MAX_GROUPS_X)]
}
