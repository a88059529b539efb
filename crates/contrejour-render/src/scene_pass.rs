//! The pass that draws the scene from the eye: depth and ambient light, then one light after the other.

use std::collections::HashMap;

use contrejour_gpu::{LightHandle, ViewChoice, VisibilityKind};

use crate::Gpu;
use crate::casters::CastShadows;
use crate::frame_uniforms::{FrameBinding, FrameUniforms};
use crate::scene_meshes::{Parts, SceneMeshes};
use crate::scene_pipeline::{EntryPoints, FRAME_GROUP, SURFACE_GROUP, ScenePipelines, depth_state, mesh_pipeline};
use crate::shaders::{AMBIENT, SHADE, UNSHADOWED};
use crate::surface::surface_layout;
use crate::surface_light::SurfaceLight;
use crate::targets::{COLOR_FORMAT, RADIANCE_FORMAT};

const VISIBILITY_GROUP: u32 = 2;

/// What shapes the shader that adds a light: its visibility function; `None` where it throws no shadow.
type ShadeKind = Option<(VisibilityKind, ViewChoice)>;

/// Pipelines, uniforms and what they bind. Lights that ask for visibility in the same way share pipelines.
#[derive(Debug)]
pub(crate) struct ScenePass {
    surface_layout: wgpu::BindGroupLayout,
    frame: FrameBinding,
    ambient: ScenePipelines,
    has_cuts: bool,
    shades: HashMap<ShadeKind, Shade>,
}

/// What adds lights of one kind.
#[derive(Debug)]
struct Shade {
    module: wgpu::ShaderModule,
    layout: wgpu::PipelineLayout,
    /// For lights of even index, then of odd.
    adding: [Option<wgpu::RenderPipeline>; 2],
}

impl ScenePass {
    /// For so many lights, and for meshes that alpha cuts or not.
    pub fn new(gpu: &Gpu, light_count: usize, has_cuts: bool) -> Self {
        let surface_layout = surface_layout(&gpu.device);
        let frame = FrameBinding::new(gpu, light_count);
        let layouts = [Some(&frame.layout), Some(&surface_layout)];
        let layout = pipeline_layout(gpu, "ambient", &layouts);
        let module = module(gpu, "ambient", AMBIENT.into());
        let entry_points = EntryPoints { vertex: "vertex_shade", fragment: "fragment_ambient" };
        // Where faces coincide the first one is seen; so it is when lights are added.
        let how = (wgpu::CompareFunction::Greater, has_cuts);
        let ambient = ScenePipelines::new(gpu, (&layout, &module), entry_points, &[RADIANCE_FORMAT], how);
        Self { surface_layout, frame, ambient, has_cuts, shades: HashMap::new() }
    }

    pub fn surface_layout(&self) -> &wgpu::BindGroupLayout {
        &self.surface_layout
    }

    /// Makes what these lights need and is not there; their shadows were prepared.
    pub fn prepare(&mut self, gpu: &Gpu, cast: &CastShadows, lights: &[Option<LightHandle>]) {
        for (index, light) in lights.iter().enumerate() {
            let layouts = [Some(&self.frame.layout), Some(&self.surface_layout)];
            let new = || Shade::new(gpu, cast, *light, layouts);
            let shade = self.shades.entry(kind_of(cast, *light)).or_insert_with(new);
            shade.prepare(gpu, index);
        }
    }

    /// Uploads what changed of camera and lights; returns the number of bytes.
    pub fn upload(&mut self, gpu: &Gpu, uniforms: &FrameUniforms, lights: &[SurfaceLight]) -> u64 {
        self.frame.upload(gpu, uniforms, lights)
    }

    /// Draws the scene in the lights that were prepared.
    pub fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        cast: &CastShadows,
        lights: &[Option<LightHandle>],
        meshes: &SceneMeshes,
    ) {
        self.frame.bind(pass, FRAME_GROUP, 0);
        self.ambient.draw(pass, meshes);
        for (index, light) in lights.iter().enumerate() {
            let shade = self.shades.get(&kind_of(cast, *light));
            let Some(pipeline) = shade.and_then(|shade| shade.adding[index % 2].as_ref()) else { continue };
            pass.set_pipeline(pipeline);
            self.bind(pass, cast, index, *light);
            // Where alpha cuts there is no equal depth.
            meshes.draw(pass, SURFACE_GROUP, Parts::All);
        }
    }

    /// Draws the visibility of one light, black to white, into a picture.
    pub fn draw_visibility(
        &self,
        gpu: &Gpu,
        pass: &mut wgpu::RenderPass<'_>,
        cast: &CastShadows,
        (index, light): (usize, LightHandle),
        meshes: &SceneMeshes,
    ) {
        let Some(shade) = self.shades.get(&kind_of(cast, Some(light))) else { return };
        let entry_points = EntryPoints { vertex: "vertex_shade", fragment: "fragment_show_visibility" };
        let how = (wgpu::CompareFunction::GreaterEqual, self.has_cuts);
        self.bind(pass, cast, index, Some(light));
        ScenePipelines::new(gpu, (&shade.layout, &shade.module), entry_points, &[COLOR_FORMAT], how).draw(pass, meshes);
    }

    fn bind(&self, pass: &mut wgpu::RenderPass<'_>, cast: &CastShadows, index: usize, light: Option<LightHandle>) {
        self.frame.bind(pass, FRAME_GROUP, index);
        if let Some(light) = light {
            pass.set_bind_group(VISIBILITY_GROUP, cast.shadows.visibility_bind_group(light), &[]);
        }
    }
}

fn kind_of(cast: &CastShadows, light: Option<LightHandle>) -> ShadeKind {
    light.map(|light| cast.kind_of(light))
}

impl Shade {
    fn new(
        gpu: &Gpu,
        cast: &CastShadows,
        light: Option<LightHandle>,
        [frame, surface]: [Option<&wgpu::BindGroupLayout>; 2],
    ) -> Self {
        let (visibility, layout) = match light {
            Some(light) => {
                let layout = cast.shadows.visibility_layout(light);
                let layouts = [frame, surface, Some(layout)];
                (cast.shadows.visibility_wgsl(light, VISIBILITY_GROUP), pipeline_layout(gpu, "shade", &layouts))
            }
            None => (UNSHADOWED.to_owned(), pipeline_layout(gpu, "shade", &[frame, surface])),
        };
        Self { module: module(gpu, "shade", format!("{SHADE}{visibility}").into()), layout, adding: [None, None] }
    }

    fn prepare(&mut self, gpu: &Gpu, index: usize) {
        let Self { module, layout, adding } = self;
        adding[index % 2].get_or_insert_with(|| {
            let target = wgpu::ColorTargetState {
                format: RADIANCE_FORMAT,
                blend: Some(add_once(index)),
                write_mask: wgpu::ColorWrites::ALL,
            };
            let entry_points = EntryPoints { vertex: "vertex_shade", fragment: "fragment_shade" };
            let depth = depth_state(wgpu::CompareFunction::Equal, false);
            mesh_pipeline(gpu, (layout, module), entry_points, &[target], (depth, false))
        });
    }
}

/// Adds a light once to each sample, also where faces coincide: alpha says whether it was added. It is 0 before the first
/// light; each light finds it as the one before left it, and leaves it the other way.
fn add_once(index: usize) -> wgpu::BlendState {
    use wgpu::BlendFactor::{DstAlpha, One, OneMinusDstAlpha, Zero};
    let (to_add, alpha) = if index.is_multiple_of(2) { (OneMinusDstAlpha, One) } else { (DstAlpha, Zero) };
    let operation = wgpu::BlendOperation::Add;
    wgpu::BlendState {
        color: wgpu::BlendComponent { src_factor: to_add, dst_factor: One, operation },
        alpha: wgpu::BlendComponent { src_factor: alpha, dst_factor: Zero, operation },
    }
}

fn module(gpu: &Gpu, label: &str, wgsl: std::borrow::Cow<'_, str>) -> wgpu::ShaderModule {
    gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some(label),
        source: wgpu::ShaderSource::Wgsl(wgsl),
    })
}

fn pipeline_layout(
    gpu: &Gpu,
    label: &str,
    bind_group_layouts: &[Option<&wgpu::BindGroupLayout>],
) -> wgpu::PipelineLayout {
    gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some(label),
        bind_group_layouts,
        immediate_size: 0,
    })
}
