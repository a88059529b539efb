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
    layout: wgpu::BindGroupLayout,
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
        let layout = bind_group_layout(device, description);
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: Some(name),
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some(name),
            source: wgpu::ShaderSource::Wgsl(description.wgsl.into()),
        });
        let targets = description.color.zip(planned.color).map(|(target, format)| {
            Some(wgpu::ColorTargetState {
                format,
                blend: target.minimum.then_some(wgpu::BlendState { color: MINIMUM, alpha: MINIMUM }),
                write_mask: wgpu::ColorWrites::ALL,
            })
        });
        let depth_stencil = planned.depth.map(|format| wgpu::DepthStencilState {
            format,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: wgpu::StencilState::default(),
            bias: wgpu::DepthBiasState::default(),
        });
        let pipeline = |planned: &PipelinePlan| {
            let EntryPoints::Raster { vertex, fragment, .. } = planned.entry_points else { return None };
            let compilation_options =
                wgpu::PipelineCompilationOptions { constants: &planned.constants, ..Default::default() };
            Some(device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
                label: Some(name),
                layout: Some(&pipeline_layout),
                vertex: wgpu::VertexState {
                    module: &module,
                    entry_point: Some(vertex),
                    compilation_options: compilation_options.clone(),
                    buffers: &[],
                },
                primitive: wgpu::PrimitiveState::default(),
                depth_stencil: depth_stencil.clone(),
                multisample: wgpu::MultisampleState::default(),
                fragment: fragment.map(|fragment| wgpu::FragmentState {
                    module: &module,
                    entry_point: Some(fragment),
                    compilation_options,
                    targets: targets.as_slice(),
                }),
                multiview_mask: None,
                cache: None,
            }))
        };
        let pipelines = planned.pipelines.iter().filter_map(pipeline).collect();
        Self { description, planned, layout, pipelines }
    }

    /// Whether a light with this plan can use it.
    pub fn fits(&self, description: &MapPass, plan: &FramePlan) -> bool {
        self.pass() == description.pass && self.planned == Planned::new(description, plan)
    }

    pub fn pass(&self) -> Pass {
        self.description.pass
    }

    /// Whether it binds what the seat of a view has; else it binds the view's own maps, whatever its seat.
    pub fn is_of_seat(&self) -> bool {
        bound_buffers(self.pass()).iter().any(|kind| kind.seating() == Seating::Apart)
    }

    /// How many of the pages it draws: what covers the whole map is drawn once.
    fn drawn_pages(&self, page_count: usize) -> usize {
        let is_drawn_once = self.description.draws.iter().any(|draw| matches!(draw, DrawCount::FullScreen));
        if is_drawn_once { 1 } else { page_count }
    }

    /// One bind group for each page that the pass draws, level by level. What it reads are maps, of which view is said beside
    /// them; what it binds for a seat reads none.
    pub fn bind(
        &self,
        device: &wgpu::Device,
        bindings: &Bindings<'_>,
        read: Option<(&Textures, usize)>,
        page_count: usize,
    ) -> Vec<wgpu::BindGroup> {
        let kinds = bound_buffers(self.pass());
        let bind = |page: usize, read: Option<&wgpu::TextureView>| {
            let texture = read.map(|view| (kinds.len() as u32, view));
            bindings.bind(device, self.pass().name(), &self.layout, (&kinds, page), texture)
        };
        let levels = self.description.reads.zip(read).map(|(kind, (textures, view))| textures.levels(kind, view));
        let reads: Vec<_> = match (self.description.levels, levels) {
            (Levels::AllButFirst, Some(levels)) => levels[..levels.len() - 1].iter().map(Some).collect(),
            (_, levels) => vec![levels.map(|levels| &levels[0])],
        };
        let pages = 0..self.drawn_pages(page_count);
        reads.iter().flat_map(|read| pages.clone().map(|page| bind(page, *read))).collect()
    }

    /// Records the pass over all pages, once for each level that it fills; counts its draws.
    pub fn encode<T: PassTimer>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        bind_groups: &[wgpu::BindGroup],
        (buffers, textures): (&Buffers, &Textures),
        drawn: &DrawnView<'_>,
        recorded: &mut Recorded,
        timer: &mut T,
    ) {
        let first_level = if self.description.levels == Levels::First { 0 } else { 1 };
        for (bind_groups, level) in bind_groups.chunks(self.drawn_pages(drawn.pages.len())).zip(first_level..) {
            let query = timer.begin(self.description.pass.name(), encoder);
            let writes = T::render_writes(&query);
            recorded.draws += self.encode_level(encoder, bind_groups, level, (buffers, textures), drawn, writes);
            timer.end(query, encoder);
        }
    }

    fn encode_level(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        bind_groups: &[wgpu::BindGroup],
        level: usize,
        (buffers, textures): (&Buffers, &Textures),
        drawn: &DrawnView<'_>,
        timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) -> u32 {
        let mut draws = 0;
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
        for (count, pipeline) in self.description.draws.iter().zip(&self.pipelines) {
            pass.set_pipeline(pipeline);
            for ((page, bind_group), index) in drawn.pages.iter().zip(bind_groups).zip(0..) {
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

fn load_color(clear: ClearColor, view: &LightView) -> wgpu::LoadOp<wgpu::Color> {
    let far_depth = f64::from(view.far_depth) / f64::from(view.depth_unit);
    let (r, g) = match clear {
        // What is drawn over need not be loaded: a clear is cheaper.
        ClearColor::Nothing => (0.0, 0.0),
        ClearColor::Drawn => return wgpu::LoadOp::Load,
        ClearColor::FarDepth => (far_depth, 0.0),
        ClearColor::Lit => (LIT, 0.0),
        ClearColor::FarDepthAndLit => (far_depth, LIT),
    };
    wgpu::LoadOp::Clear(wgpu::Color { r, g, b: 0.0, a: 0.0 })
}

fn bind_group_layout(device: &wgpu::Device, description: &MapPass) -> wgpu::BindGroupLayout {
    let kinds = bound_buffers(description.pass);
    let buffers = kinds.iter().zip(0..).map(|(kind, binding)| wgpu::BindGroupLayoutEntry {
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
    });
    let texture = description.reads.map(|_| wgpu::BindGroupLayoutEntry {
        binding: kinds.len() as u32,
        visibility: wgpu::ShaderStages::FRAGMENT,
        ty: UNFILTERED_FLOAT,
        count: None,
    });
    let entries: Vec<_> = buffers.chain(texture).collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some(description.pass.name()),
        entries: &entries,
    })
}
