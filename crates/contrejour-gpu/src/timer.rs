//! Timing of a frame's passes, by whatever profiler the caller has.

/// Times passes: [`Shadows::encode`](crate::Shadows::encode) tells it each pass by name.
///
/// Made to fit `wgpu-profiler`'s pass queries without depending on it.
pub trait PassTimer {
    /// Whether each stage is to be a pass of its own. Where nobody looks, all stages of a view share one, which costs the CPU
    /// less.
    const TIMES_STAGES: bool = true;

    /// What stands for one pass while it is recorded.
    type Query;

    /// Called before a pass is begun.
    fn begin(&mut self, name: &'static str, encoder: &mut wgpu::CommandEncoder) -> Self::Query;

    /// Timestamps that a compute pass writes.
    fn compute_writes(query: &Self::Query) -> Option<wgpu::ComputePassTimestampWrites<'_>>;

    /// Timestamps that a render pass writes.
    fn render_writes(query: &Self::Query) -> Option<wgpu::RenderPassTimestampWrites<'_>>;

    /// Called after a pass has ended.
    fn end(&mut self, query: Self::Query, encoder: &mut wgpu::CommandEncoder);
}

/// Times nothing.
#[derive(Clone, Copy, Debug, Default)]
pub struct Untimed;

impl PassTimer for Untimed {
    type Query = ();

    const TIMES_STAGES: bool = false;

    fn begin(&mut self, _name: &'static str, _encoder: &mut wgpu::CommandEncoder) {}

    fn compute_writes((): &()) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        None
    }

    fn render_writes((): &()) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        None
    }

    fn end(&mut self, (): (), _encoder: &mut wgpu::CommandEncoder) {}
}
