//! Silhouette edges drawn over the light of a picture.

use contrejour_layout::SilhouetteEdge;
use glam::DVec3;

use crate::Gpu;
use crate::casters::Casters;
use crate::scene_pipeline::depth_state;
use crate::shaders::SILHOUETTE_LINES;
use crate::targets::RADIANCE_FORMAT;

/// Lines and the pipelines that draw them.
#[derive(Debug)]
pub(crate) struct SilhouetteLines {
    visible: wgpu::RenderPipeline,
    hidden: wgpu::RenderPipeline,
    bind_group: wgpu::BindGroup,
    lines: wgpu::Buffer,
    line_count: u32,
}

/// `Overlay` in `shaders/raster/silhouette_lines.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
pub(crate) struct Overlay {
    eye_clip_from_local: [f32; 16],
    half_size: [f32; 2],
    half_width_pixels: f32,
    padding: u32,
}

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
struct Line {
    begin_local: [f32; 3],
    end_local: [f32; 3],
    color: [f32; 4],
}

/// Edges with faces on one side: they get smoothies.
const OUTLINE_COLOR: [f32; 4] = [1.0, 0.2, 0.02, 1.0];

/// Edges with faces on both sides, more on one: in the set, but without smoothies.
const INNER_COLOR: [f32; 4] = [0.05, 0.3, 1.0, 1.0];

const HALF_WIDTH_PIXELS: f32 = 1.0;

const VERTICES_PER_LINE: u32 = 6;

impl SilhouetteLines {
    pub fn new(
        gpu: &Gpu,
        casters: &Casters,
        edges: &[SilhouetteEdge],
        eye_clip_from_local: [f32; 16],
        size: [u32; 2],
    ) -> Self {
        let device = &gpu.device;
        let mut lines: Vec<Line> = edges.iter().filter_map(|edge| line(casters, edge)).collect();
        let line_count = lines.len() as u32;
        // A buffer must not be empty, also where nothing is drawn.
        lines.push(Line { begin_local: [0.0; 3], end_local: [0.0; 3], color: [0.0; 4] });
        let lines = gpu.upload("silhouette lines", bytemuck::cast_slice(&lines), wgpu::BufferUsages::VERTEX);
        let overlay = Overlay {
            eye_clip_from_local,
            half_size: size.map(|side| 0.5 * side as f32),
            half_width_pixels: HALF_WIDTH_PIXELS,
            padding: 0,
        };
        let overlay = gpu.upload("overlay", bytemuck::bytes_of(&overlay), wgpu::BufferUsages::UNIFORM);
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("silhouette lines"),
            source: wgpu::ShaderSource::Wgsl(SILHOUETTE_LINES.into()),
        });
        // Reversed depth: what is greater is nearer.
        let visible = pipeline(gpu, &module, "fragment_visible_line", wgpu::CompareFunction::GreaterEqual);
        let hidden = pipeline(gpu, &module, "fragment_hidden_line", wgpu::CompareFunction::Less);
        let bind_group = device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("overlay"),
            layout: &visible.get_bind_group_layout(0),
            entries: &[wgpu::BindGroupEntry { binding: 0, resource: overlay.as_entire_binding() }],
        });
        Self { visible, hidden, bind_group, lines, line_count }
    }

    pub fn draw(&self, pass: &mut wgpu::RenderPass<'_>) {
        pass.set_vertex_buffer(0, self.lines.slice(..));
        for pipeline in [&self.hidden, &self.visible] {
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &self.bind_group, &[]);
            pass.draw(0..VERTICES_PER_LINE, 0..self.line_count);
        }
    }
}

fn line(casters: &Casters, silhouette: &SilhouetteEdge) -> Option<Line> {
    let caster = casters.placed.get(silhouette.caster as usize)?;
    let topology = casters.topology(caster);
    let edge = topology.edges.get(silhouette.edge_id as usize)?;
    let end_local = |vertex: u32| {
        let position = match casters.deforming(caster) {
            Some(deforming) => deforming.posed[vertex as usize],
            None => DVec3::from(topology.positions[vertex as usize].map(f64::from)),
        };
        caster.local_from_object.transform_point3(position).as_vec3().to_array()
    };
    let is_outline = silhouette.left == 0 || silhouette.right == 0;
    Some(Line {
        begin_local: end_local(edge.low_vertex),
        end_local: end_local(edge.high_vertex),
        color: if is_outline { OUTLINE_COLOR } else { INNER_COLOR },
    })
}

fn pipeline(
    gpu: &Gpu,
    module: &wgpu::ShaderModule,
    fragment: &str,
    compare: wgpu::CompareFunction,
) -> wgpu::RenderPipeline {
    let buffer = wgpu::VertexBufferLayout {
        array_stride: size_of::<Line>() as u64,
        step_mode: wgpu::VertexStepMode::Instance,
        attributes: &wgpu::vertex_attr_array![0 => Float32x3, 1 => Float32x3, 2 => Float32x4],
    };
    let target = wgpu::ColorTargetState {
        format: RADIANCE_FORMAT,
        blend: Some(wgpu::BlendState::ALPHA_BLENDING),
        write_mask: wgpu::ColorWrites::ALL,
    };
    // Both pipelines have the same one bind group, so that either's layout fits both.
    let bind_group_layout = gpu.device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("overlay"),
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX,
            ty: wgpu::BindingType::Buffer {
                ty: wgpu::BufferBindingType::Uniform,
                has_dynamic_offset: false,
                min_binding_size: None,
            },
            count: None,
        }],
    });
    let layout = gpu.device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
        label: Some("silhouette lines"),
        bind_group_layouts: &[Some(&bind_group_layout)],
        immediate_size: 0,
    });
    gpu.device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some(fragment),
        layout: Some(&layout),
        vertex: wgpu::VertexState {
            module,
            entry_point: Some("vertex_line"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            buffers: &[Some(buffer)],
        },
        primitive: wgpu::PrimitiveState::default(),
        depth_stencil: Some(depth_state(compare, false)),
        multisample: wgpu::MultisampleState { count: gpu.sample_count, ..Default::default() },
        fragment: Some(wgpu::FragmentState {
            module,
            entry_point: Some(fragment),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(target)],
        }),
        multiview_mask: None,
        cache: None,
    })
}
