//! A frame's commands, part by part.

use std::time::Instant;

use contrejour_gpu::PassTimer;
use contrejour_render::Gpu;
use cpu_time::ProcessTime;

/// What lies between the stages and passes: counters are cleared and views are given their seats.
const BETWEEN: &str = "between";

/// Parts commands where a stage or a pass begins and ends.
pub struct Split {
    device: wgpu::Device,
    /// In their order.
    pub parts: Vec<(&'static str, wgpu::CommandBuffer)>,
}

impl Split {
    pub fn new(gpu: &Gpu) -> Self {
        Self { device: gpu.device.clone(), parts: Vec::new() }
    }

    fn part(&mut self, name: &'static str, encoder: &mut wgpu::CommandEncoder) {
        let rest = self.device.create_command_encoder(&Default::default());
        self.parts.push((name, std::mem::replace(encoder, rest).finish()));
    }
}

impl PassTimer for Split {
    type Query = &'static str;

    fn begin(&mut self, name: &'static str, encoder: &mut wgpu::CommandEncoder) -> &'static str {
        self.part(BETWEEN, encoder);
        name
    }

    fn compute_writes(_: &Self::Query) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        None
    }

    fn render_writes(_: &Self::Query) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        None
    }

    fn end(&mut self, name: &'static str, encoder: &mut wgpu::CommandEncoder) {
        self.part(name, encoder);
    }
}

/// From submission to completion, less that of an empty submission. Unit: seconds.
pub fn time(gpu: &Gpu, commands: wgpu::CommandBuffer) -> f64 {
    (submitted(gpu, [commands]) - submitted(gpu, [])).max(0.0)
}

fn submitted<const COUNT: usize>(gpu: &Gpu, commands: [wgpu::CommandBuffer; COUNT]) -> f64 {
    // What was written before is not part of it.
    gpu.queue.submit([]);
    gpu.wait(None).expect("the device works");
    let (clock, threads) = (Instant::now(), ProcessTime::now());
    gpu.queue.submit(commands);
    gpu.wait(None).expect("the device works");
    let time = if gpu.is_software() { threads.elapsed() } else { clock.elapsed() };
    time.as_secs_f64()
}
