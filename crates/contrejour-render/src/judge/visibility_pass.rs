//! The full-screen pass that asks a technique for the visibility of all receivers.

use contrejour_gpu::{LightHandle, PassTimer, ViewChoice, VisibilityKind};

use super::receiver_pass::ReceiverTarget;
use crate::Gpu;
use crate::casters::CastShadows;
use crate::full_screen::full_screen_pipeline;
use crate::scene_pipeline::EntryPoints;
use crate::shaders::JUDGED_VISIBILITY;

/// Format of visibility, 0 dark to 1 lit.
pub(super) const VISIBILITY_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R32Float;

/// The pass's name among a frame's stages.
const NAME: &str = "visibility";

const RECEIVER_GROUP: u32 = 0;
const VISIBILITY_GROUP: u32 = 1;

/// The pass, for one kind of visibility.
#[derive(Debug)]
pub(super) struct VisibilityPass {
    kind: (VisibilityKind, ViewChoice),
    light: LightHandle,
    pipeline: wgpu::RenderPipeline,
}

impl VisibilityPass {
    /// The pass for shadows that were prepared.
    pub fn new(gpu: &Gpu, cast: &CastShadows, light: LightHandle, receivers: &ReceiverTarget) -> Self {
        let CastShadows { shadows, .. } = cast;
        let wgsl = format!("{JUDGED_VISIBILITY}{}", shadows.visibility_wgsl(light, VISIBILITY_GROUP));
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("judged visibility"),
            source: wgpu::ShaderSource::Wgsl(wgsl.into()),
        });
        let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("judged visibility"),
            bind_group_layouts: &[Some(&receivers.layout), Some(shadows.visibility_layout(light))],
            immediate_size: 0,
        });
        let entry_points = EntryPoints { vertex: "vertex_judged_visibility", fragment: "fragment_judged_visibility" };
        let pipeline = full_screen_pipeline(gpu, (&layout, &module), entry_points, &[], VISIBILITY_FORMAT);
        Self { kind: cast.kind_of(light), light, pipeline }
    }

    /// Whether the pass looks up the maps that these shadows have.
    pub fn fits(&self, cast: &CastShadows) -> bool {
        self.kind == cast.kind_of(self.light)
    }

    pub fn encode<T: PassTimer>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        cast: &CastShadows,
        receivers: &ReceiverTarget,
        target: &wgpu::TextureView,
        timer: &mut T,
    ) {
        let query = timer.begin(NAME, encoder);
        {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some(NAME),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: target,
                    depth_slice: None,
                    resolve_target: None,
                    // Every pixel is written.
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::WHITE),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                timestamp_writes: T::render_writes(&query),
                ..Default::default()
            });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(RECEIVER_GROUP, &receivers.bind_group, &[]);
            pass.set_bind_group(VISIBILITY_GROUP, cast.shadows.visibility_bind_group(self.light), &[]);
            pass.draw(0..3, 0..1);
        }
        timer.end(query, encoder);
    }
}
