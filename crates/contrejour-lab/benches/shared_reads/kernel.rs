//! A compute shader with the bindings of a stage.

use std::time::{Duration, Instant};

use contrejour_gpu::stages::ComputeStage;
use contrejour_layout::MAX_GROUPS_X;
use contrejour_plan::BufferKind;
use contrejour_render::Gpu;
use cpu_time::ProcessTime;

pub struct Kernel {
    layout: wgpu::BindGroupLayout,
    pipeline: wgpu::ComputePipeline,
}

impl Kernel {
    pub fn new(gpu: &Gpu, stage: &ComputeStage, wgsl: &str) -> Self {
        let device = &gpu.device;
        let entry = |(kind, binding): (&BufferKind, u32)| {
            let ty = match kind {
                BufferKind::LightView => wgpu::BufferBindingType::Uniform,
                kind => wgpu::BufferBindingType::Storage { read_only: !stage.writes.contains(kind) },
            };
            wgpu::BindGroupLayoutEntry {
                binding,
                visibility: wgpu::ShaderStages::COMPUTE,
                ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
                count: None,
            }
        };
        let entries: Vec<_> = stage.stage.buffers().iter().zip(0..).map(entry).collect();
        let layout =
            device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor { label: None, entries: &entries });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let source = wgpu::ShaderSource::Wgsl(wgsl.into());
        let pipeline = device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
            label: None,
            layout: Some(&pipeline_layout),
            module: &device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source }),
            entry_point: Some(stage.stage.name()),
            compilation_options: Default::default(),
            cache: None,
        });
        Self { layout, pipeline }
    }

    /// With these buffers, in the order of the bindings.
    pub fn bind(&self, gpu: &Gpu, buffers: &[&wgpu::Buffer]) -> wgpu::BindGroup {
        let entries = buffers.iter().zip(0..);
        let entries: Vec<_> = entries
            .map(|(buffer, binding)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let layout = &self.layout;
        gpu.device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout, entries: &entries })
    }

    pub fn dispatch(&self, pass: &mut wgpu::ComputePass<'_>, bind_group: &wgpu::BindGroup, groups: u32) {
        pass.set_pipeline(&self.pipeline);
        pass.set_bind_group(0, bind_group, &[]);
        pass.dispatch_workgroups(groups.min(MAX_GROUPS_X), groups.div_ceil(MAX_GROUPS_X), 1);
    }
}

/// From submission to completion.
pub fn time(gpu: &Gpu, record: impl FnOnce(&mut wgpu::CommandEncoder)) -> Duration {
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    record(&mut encoder);
    let commands = encoder.finish();
    // What was written before is not part of it.
    gpu.queue.submit([]);
    gpu.wait(None).expect("the device works");
    let (clock, threads) = (Instant::now(), ProcessTime::now());
    gpu.queue.submit([commands]);
    gpu.wait(None).expect("the device works");
    if gpu.is_software() { threads.elapsed() } else { clock.elapsed() }
}
