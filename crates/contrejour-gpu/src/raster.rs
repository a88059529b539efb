//! A raster pass over a light view's maps on the device.

use contrejour_layout::{DrawArgs, LightView};
use contrejour_plan::{BufferKind, EntryPoints, FramePlan, PagePlan, Pass, PipelinePlan, Seating, TextureKind};

use crate::buffers::Buffers;
use crate::frame::Recorded;
use crate::passes::{ClearColor, DepthKept, DrawCount, Levels, MapPass};
use crate::resources::{Bindings, Textures, UNFILTERED_FLOAT, binding_type, format};
use crate::timer::PassTimer;

/// The pipelines of a pass, one for each of its draws.
#[derive(Debug)]
pub(crate) struct MapPipeline {
    description: &'static MapPass,
    planned: Planned,
    buffers_layout: wgpu::BindGroupLayout,
    map_layout: Option<wgpu::BindGroupLayout>,
    layout: wgpu::PipelineLayout,
    module: wgpu::ShaderModule,
    pipelines: Vec<wgpu::RenderPipeline>,
}

/// What a light's plan says of a pass: lights that plan alike share its pipelines.
#[derive(Clone, Debug, PartialEq)]
struct Planned {
    pipelines: Vec<PipelinePlan>,
    color: Option<wgpu::TextureFormat>,
    depth: Option<wgpu::TextureFormat>,
    stores_depth: bool,
}

impl Planned {
    fn new(description: &MapPass, plan: &FramePlan) -> Self {
        let is_of_pass = |planned: &&PipelinePlan| matches!(planned.entry_points, EntryPoints::Raster { pass, .. } if pass == description.pass);
        Self {
            pipelines: plan.pipelines.iter().filter(is_of_pass).cloned().collect(),
            color: description.color.map(|target| planned_format(plan, target.texture)),
            depth: description.depth.map(|target| planned_format(plan, target.texture)),
            stores_depth: description.depth.is_some_and(|target| match target.kept {
                DepthKept::Never => false,
                DepthKept::Before(pass) => plan.has_pass(pass),
                DepthKept::Always => true,
            }),
        }
    }
}

/// The view that a pass draws.
#[derive(Clone, Copy, Debug)]
pub(crate) struct DrawnView<'a> {
    /// Index among those of the light.
    pub view: usize,
    /// Its seat among those that are tested together.
    pub seat: usize,
    pub record: &'a LightView,
    pub pages: &'a [PagePlan],
}

/// The buffers that a pass binds: what it draws by is not bound.
fn bound_buffers(pass: Pass) -> Vec<BufferKind> {
    pass.buffers().iter().copied().filter(|kind| *kind != BufferKind::DrawArgs).collect()
}

impl MapPipeline {
    pub fn new(device: &wgpu::Device, description: &'static MapPass, plan: &FramePlan) -> Self {
        let name = description.pass.name();
        let planned = Planned::new(description, plan);
        let buffers_layout = buffers_layout(device, description);
        let map_layout = description.reads.map(|_| map_layout(device, description));
        let layouts: Vec<_> = std::iter::once(&buffers_layout).chain(&map_layout).map(Some).collect();
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(name),
            bind_group_layouts: &layouts,
            immediate_size: 0,
        });
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(name),
            source: wgpu::ShaderSource::Wgsl(description.wgsl.into()),
        });
        let pipelines = Vec::new();
        let without = Self { description, planned, buffers_layout, map_layout, layout, module, pipelines };
        Self { pipelines: without.pipelines(device), ..without }
    }

    fn pipelines(&self, device: &wgpu::Device) -> Vec<wgpu::RenderPipeline> {
        let targets = self.description.color.zip(self.planned.color).map(|(target, format)| {
            Some(wgpu::ColorTargetState {
                format,
                blend: target.minimum.then_some(wgpu::BlendState { color: MINIMUM, alpha: MINIMUM }),
                write_mask: wgpu::ColorWrites::ALL,
            })
        });
        let depth_stencil = self.planned.depth.map(|format| wgpu::DepthStencilState {
            format,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        });
        let pipeline = |planned: &PipelinePlan| {
            let EntryPoints::Raster { fragment, .. } = planned.entry_points else { return None };
            let fragment = fragment.map(|fragment| wgpu::FragmentState {
                module: &self.module,
                entry_point: Some(fragment),
                compilation_options: constants(planned),
                targets: targets.as_slice(),
            });
            self.pipeline(device, planned, (fragment, depth_stencil.clone()))
        };
        self.planned.pipelines.iter().filter_map(pipeline).collect()
    }

    /// A pipeline with the vertices of a draw.
    fn pipeline(
        &self,
        device: &wgpu::Device,
        planned: &PipelinePlan,
        (fragment, depth_stencil): (Option<wgpu::FragmentState<'_>>, Option<wgpu::DepthStencilState>),
    ) -> Option<wgpu::RenderPipeline> {
        let EntryPoints::Raster { vertex, .. } = planned.entry_points else { return None };
        Some(device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label: Some(self.pass().name()),
            layout: Some(&self.layout),
            vertex: wgpu::VertexState {
                module: &self.module,
                entry_point: Some(vertex),
                compilation_options: constants(planned),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil,
            multisample: wgpu::MultisampleState::default(),
            fragment,
            multiview_mask: None,
            cache: None,
        }))
    }

    /// Whether a light with this plan can use it.
    pub fn fits(&self, description: &MapPass, plan: &FramePlan) -> bool {
        self.pass() == description.pass && self.planned == Planned::new(description, plan)
    }

    pub fn pass(&self) -> Pass {
        self.description.pass
    }

    /// Whether it binds buffers that the seat of a view has; else those of the view itself, whatever its seat.
    pub fn is_of_seat(&self) -> bool {
        bound_buffers(self.pass()).iter().any(|kind| kind.seating() == Seating::Apart)
    }

    /// How many of the pages it draws: what covers the whole map is drawn once.
    fn drawn_pages(&self, page_count: usize) -> usize {
        let is_drawn_once = self.description.draws.iter().any(|draw| matches!(draw, DrawCount::FullScreen));
        if is_drawn_once { 1 } else { page_count }
    }

    /// Its buffers: one bind group for each page that the pass draws.
    pub fn bind_buffers(
        &self,
        device: &wgpu::Device,
        bindings: &Bindings<'_>,
        page_count: usize,
    ) -> Vec<wgpu::BindGroup> {
        let kinds = bound_buffers(self.pass());
        let bind = |page| bindings.bind(device, self.pass().name(), &self.buffers_layout, (&kinds, page));
        (0..self.drawn_pages(page_count)).map(bind).collect()
    }

    /// The map of a view that it reads: one bind group for each level; none where it reads no map.
    pub fn bind_map(&self, device: &wgpu::Device, textures: &Textures, view: usize) -> Vec<wgpu::BindGroup> {
        let Some((kind, layout)) = self.description.reads.zip(self.map_layout.as_ref()) else { return Vec::new() };
        let levels = textures.levels(kind, view);
        let levels = match self.description.levels {
            Levels::First => &levels[..1],
            Levels::AllButFirst => &levels[..levels.len() - 1],
        };
        let bind = |level| {
            device.create_bind_group(&wgpu::BindGroupDescriptor {
                label: Some(self.pass().name()),
                layout,
                entries: &[wgpu::BindGroupEntry { binding: 0, resource: wgpu::BindingResource::TextureView(level) }],
            })
        };
        levels.iter().map(bind).collect()
    }

    /// Records the pass over all pages, once for each level that it fills; counts its draws.
    pub fn encode<T: PassTimer>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        (of_pages, of_levels): (&[wgpu::BindGroup], &[wgpu::BindGroup]),
        (buffers, textures): (&Buffers, &Textures),
        drawn: &DrawnView<'_>,
        recorded: &mut Recorded,
        timer: &mut T,
    ) {
        let levels: Vec<_> = match self.description.levels {
            Levels::First => vec![(of_levels.first(), 0)],
            Levels::AllButFirst => of_levels.iter().map(Some).zip(1..).collect(),
        };
        for (map, level) in levels {
            let query = timer.begin(self.description.pass.name(), encoder);
            let writes = T::render_writes(&query);
            recorded.draws += self.encode_level(encoder, (of_pages, map), level, (buffers, textures), drawn, writes);
            timer.end(query, encoder);
        }
    }

    fn encode_level(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        (of_pages, map): (&[wgpu::BindGroup], Option<&wgpu::BindGroup>),
        level: usize,
        (buffers, textures): (&Buffers, &Textures),
        drawn: &DrawnView<'_>,
        timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) -> u32 {
        let color = self.description.color.map(|target| {
            Some(wgpu::RenderPassColorAttachment {
                view: &textures.levels(target.texture, drawn.view)[level],
                depth_slice: None,
                resolve_target: None,
                ops: wgpu::Operations { load: load_color(target.clear, drawn.record), store: wgpu::StoreOp::Store },
            })
        });
        let depth = self.description.depth.map(|target| wgpu::RenderPassDepthStencilAttachment {
            view: &textures.levels(target.texture, drawn.view)[0],
            depth_ops: Some(wgpu::Operations {
                load: if target.is_drawn { wgpu::LoadOp::Load } else { wgpu::LoadOp::Clear(1.0) },
                store: if self.planned.stores_depth { wgpu::StoreOp::Store } else { wgpu::StoreOp::Discard },
            }),
            stencil_ops: None,
        });
        let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some(self.description.pass.name()),
            color_attachments: color.as_slice(),
            depth_stencil_attachment: depth,
            timestamp_writes,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        self.draw(&mut pass, &self.pipelines, (of_pages, map), buffers, drawn)
    }

    /// Draws its triangles with fragments of the caller's, without a depth test.
    pub fn draw_again(
        &self,
        device: &wgpu::Device,
        (fragment, into): (&wgpu::FragmentState<'_>, &mut wgpu::RenderPass<'_>),
        groups: (&[wgpu::BindGroup], Option<&wgpu::BindGroup>),
        buffers: &Buffers,
        drawn: &DrawnView<'_>,
    ) {
        let pipeline = |planned| self.pipeline(device, planned, (Some(fragment.clone()), None));
        let pipelines: Vec<_> = self.planned.pipelines.iter().filter_map(pipeline).collect();
        self.draw(into, &pipelines, groups, buffers, drawn);
    }

    /// Draws all pages; returns the number of draws.
    fn draw(
        &self,
        pass: &mut wgpu::RenderPass<'_>,
        pipelines: &[wgpu::RenderPipeline],
        (of_pages, map): (&[wgpu::BindGroup], Option<&wgpu::BindGroup>),
        buffers: &Buffers,
        drawn: &DrawnView<'_>,
    ) -> u32 {
        let mut draws = 0;
        for (count, pipeline) in self.description.draws.iter().zip(pipelines) {
            pass.set_pipeline(pipeline);
            if let Some(map) = map {
                pass.set_bind_group(1, map, &[]);
            }
            for ((page, bind_group), index) in drawn.pages.iter().zip(of_pages).zip(0..) {
                pass.set_bind_group(0, bind_group, &[]);
                match *count {
                    DrawCount::FullScreen => pass.draw(0..3, 0..1),
                    // Without a block nothing wrote the arguments.
                    DrawCount::Indirect(_) if page.counts.face_blocks + page.counts.edge_blocks == 0 => continue,
                    DrawCount::Indirect(entry) => {
                        let args = buffers.part(BufferKind::DrawArgs, index, drawn.seat);
                        let offset = args.offset() + u64::from(entry) * size_of::<DrawArgs>() as u64;
                        pass.draw_indirect(args.buffer(), offset);
                    }
                }
                draws += 1;
            }
        }
        draws
    }
}

fn constants(planned: &PipelinePlan) -> wgpu::PipelineCompilationOptions<'_> {
    wgpu::PipelineCompilationOptions { constants: &planned.constants, ..Default::default() }
}

/// The format of a target that the plan lists, since it lists the pass that fills it.
fn planned_format(plan: &FramePlan, kind: TextureKind) -> wgpu::TextureFormat {
    match plan.texture(kind) {
        Some(listed) => format(listed.format),
        None => panic!("the frame plan lists no texture `{}` for a pass that fills it", kind.name()),
    }
}

const MINIMUM: wgpu::BlendComponent = wgpu::BlendComponent {
    src_factor: wgpu::BlendFactor::One,
    dst_factor: wgpu::BlendFactor::One,
    operation: wgpu::BlendOperation::Min,
};

/// Alpha of a texel without a smoothie.
const LIT: f64 = 1.0;

/// Distance to a silhouette of a texel without one: the largest number of a 16-bit float.
const FAR_TEXELS: f64 = 65504.0;

fn load_color(clear: ClearColor, view: &LightView) -> wgpu::LoadOp<wgpu::Color> {
    let far_depth = f64::from(view.far_depth) / f64::from(view.depth_unit);
    let (r, g) = match clear {
        // What is drawn over need not be loaded: a clear is cheaper.
        ClearColor::Nothing => (0.0, 0.0),
        ClearColor::Drawn => return wgpu::LoadOp::Load,
        ClearColor::FarDepth => (far_depth, 0.0),
        ClearColor::Lit => (LIT, 0.0),
        ClearColor::FarDepthAndLit => (far_depth, LIT),
        ClearColor::FarDepthAndDistance => (far_depth, FAR_TEXELS),
    };
    wgpu::LoadOp::Clear(wgpu::Color { r, g, b: 0.0, a: 0.0 })
}

/// Group 0: buffers.
fn buffers_layout(device: &wgpu::Device, description: &MapPass) -> wgpu::BindGroupLayout {
    let entry = |(kind, binding): (&BufferKind, u32)| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: match kind {
            BufferKind::LightView | BufferKind::Masks | BufferKind::MaskWords => wgpu::ShaderStages::VERTEX_FRAGMENT,
            _ => wgpu::ShaderStages::VERTEX,
        },
        ty: wgpu::BindingType::Buffer {
            ty: binding_type(*kind, true),
            has_dynamic_offset: false,
            min_binding_size: None,
        },
        count: None,
    };
    let entries: Vec<_> = bound_buffers(description.pass).iter().zip(0..).map(entry).collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(description.pass.name()),
        entries: &entries,
    })
}

/// Group 1: a map that an earlier pass filled.
fn map_layout(device: &wgpu::Device, description: &MapPass) -> wgpu::BindGroupLayout {
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(description.pass.name()),
        entries: &[wgpu::BindGroupLayoutEntry {
            binding: 0,
            visibility: wgpu::ShaderStages::VERTEX_FRAGMENT,
            ty: UNFILTERED_FLOAT,
            count: None,
        }],
    })
}
