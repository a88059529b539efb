//! The pass that draws the scene from the eye.

use contrejour_gpu::{ViewChoice, VisibilityKind};

use crate::Gpu;
use crate::casters::CastShadows;
use crate::frame_uniforms::{FrameBinding, FrameUniforms};
use crate::scene_meshes::{SceneMeshes, surface_layout};
use crate::scene_pipeline::{EntryPoints, FRAME_GROUP, SURFACE_GROUP, scene_pipeline};
use crate::shaders::SHADE;
use crate::targets::COLOR_FORMAT;

const VISIBILITY_GROUP: u32 = 2;

/// What a picture shows on its surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Shading {
    /// Light and material.
    Lit,
    /// Visibility of the light: black to white.
    Visibility,
}

impl Shading {
    fn entry_point(self) -> &'static str {
        match self {
            Self::Lit => "fragment_shade",
            Self::Visibility => "fragment_show_visibility",
        }
    }
}

/// What shapes the shader of a pass that asks for visibility.
pub(crate) fn kind_of(cast: &CastShadows) -> (VisibilityKind, ViewChoice) {
    (cast.shadows.visibility_kind(cast.light), cast.shadows.view_choice(cast.light))
}

/// Bind groups and shader of the pass, for one kind of visibility.
#[derive(Debug)]
pub(crate) struct PicturePass {
    kind: (VisibilityKind, ViewChoice),
    module: wgpu::ShaderModule,
    layout: wgpu::PipelineLayout,
    surface_layout: wgpu::BindGroupLayout,
    frame: FrameBinding,
}

impl PicturePass {
    /// The pass for shadows that were prepared.
    pub fn new(gpu: &Gpu, cast: &CastShadows) -> Self {
        let CastShadows { shadows, light, .. } = cast;
        let device = &gpu.device;
        let wgsl = format!("{SHADE}{}", shadows.visibility_wgsl(*light, VISIBILITY_GROUP));
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("shade"),
            source: wgpu::ShaderSource::Wgsl(wgsl.into()),
        });
        let frame = FrameBinding::new(gpu);
        let surface_layout = surface_layout(device);
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some("shade"),
            bind_group_layouts: &[Some(&frame.layout), Some(&surface_layout), Some(shadows.visibility_layout(*light))],
            immediate_size: 0,
        });
        Self { kind: kind_of(cast), module, layout, surface_layout, frame }
    }

    /// Whether the pass looks up the maps that these shadows have.
    pub fn fits(&self, cast: &CastShadows) -> bool {
        self.kind == kind_of(cast)
    }

    pub fn surface_layout(&self) -> &wgpu::BindGroupLayout {
        &self.surface_layout
    }

    pub fn pipeline(&self, gpu: &Gpu, shading: Shading) -> wgpu::RenderPipeline {
        let entry_points = EntryPoints { vertex: "vertex_shade", fragment: shading.entry_point() };
        scene_pipeline(gpu, &self.layout, &self.module, entry_points, &[COLOR_FORMAT])
    }

    /// Uploads camera and light; returns the number of bytes.
    pub fn upload(&self, gpu: &Gpu, uniforms: &FrameUniforms) -> u64 {
        self.frame.upload(gpu, uniforms)
    }

    pub fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        pipeline: &wgpu::RenderPipeline,
        cast: &CastShadows,
        meshes: &SceneMeshes,
    ) {
        pass.set_pipeline(pipeline);
        pass.set_bind_group(FRAME_GROUP, &self.frame.bind_group, &[]);
        pass.set_bind_group(VISIBILITY_GROUP, cast.shadows.visibility_bind_group(cast.light), &[]);
        meshes.draw(pass, SURFACE_GROUP);
    }
}
