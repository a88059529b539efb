//! How receivers ask for visibility: a bind group and a WGSL function for forward renderers, a full-screen texture
//! for deferred ones.

use contrejour_layout::EyeView;
use contrejour_plan::{BufferKind, MapSampler, TextureKind, ViewChoice, VisibilityKind};

use crate::buffers::Buffers;
use crate::resources::{DEPTH, DEPTH_LAYERS, FILTERED_LAYERS, Textures, UNFILTERED_LAYERS};
use crate::timer::PassTimer;
use crate::visibility_wgsl::pass_wgsl;

/// The layout of a kind's bind group: the receiver views, the maps, a sampler.
fn layout(device: &wgpu::Device, kind: VisibilityKind) -> wgpu::BindGroupLayout {
    let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
        binding,
        visibility: wgpu::ShaderStages::FRAGMENT | wgpu::ShaderStages::COMPUTE,
        ty,
        count: None,
    };
    let maps = kind.textures().iter().map(|map| match map {
        TextureKind::ShadowHardwareDepth | TextureKind::SmoothieDepth => DEPTH_LAYERS,
        // Moments are of a format that the device's samplers weigh: the plan chose it so.
        TextureKind::Moments => FILTERED_LAYERS,
        _ => UNFILTERED_LAYERS,
    });
    let sampler = kind.sampler().map(|sampler| {
        wgpu::BindingType::Sampler(match sampler {
            MapSampler::CompareNearest | MapSampler::CompareLinear => wgpu::SamplerBindingType::Comparison,
            MapSampler::Trilinear => wgpu::SamplerBindingType::Filtering,
        })
    });
    let types = std::iter::once(UNIFORM).chain(maps).chain(sampler);
    let entries: Vec<_> = types.zip(0..).map(|(ty, binding)| entry(binding, ty)).collect();
    device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
        label: Some("contrejour visibility"),
        entries: &entries,
    })
}

fn bind(
    device: &wgpu::Device,
    kind: VisibilityKind,
    layout: &wgpu::BindGroupLayout,
    sampler: Option<&wgpu::Sampler>,
    (buffers, textures): (&Buffers, &Textures),
) -> wgpu::BindGroup {
    let view = buffers.get(BufferKind::ReceiverView, 0).as_entire_binding();
    let maps = kind.textures().iter().map(|map| wgpu::BindingResource::TextureView(textures.whole(*map)));
    let sampler = sampler.map(wgpu::BindingResource::Sampler);
    let resources = std::iter::once(view).chain(maps).chain(sampler);
    let entries: Vec<_> =
        resources.zip(0..).map(|(resource, binding)| wgpu::BindGroupEntry { binding, resource }).collect();
    device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("contrejour visibility"),
        layout,
        entries: &entries,
    })
}

fn create_sampler(device: &wgpu::Device, sampler: MapSampler) -> wgpu::Sampler {
    let filter = match sampler {
        MapSampler::CompareNearest => wgpu::FilterMode::Nearest,
        MapSampler::CompareLinear | MapSampler::Trilinear => wgpu::FilterMode::Linear,
    };
    device.create_sampler(&wgpu::SamplerDescriptor {
        label: Some("contrejour map"),
        mag_filter: filter,
        min_filter: filter,
        mipmap_filter: match sampler {
            MapSampler::Trilinear => wgpu::MipmapFilterMode::Linear,
            _ => wgpu::MipmapFilterMode::Nearest,
        },
        compare: match sampler {
            MapSampler::Trilinear => None,
            // A receiver as deep as its own texel is lit.
            _ => Some(wgpu::CompareFunction::LessEqual),
        },
        ..Default::default()
    })
}

/// The visibility function of the current plan, bound.
#[derive(Debug)]
pub(crate) struct Visibility {
    pub kind: VisibilityKind,
    pub choice: ViewChoice,
    pub layout: wgpu::BindGroupLayout,
    pub bind_group: wgpu::BindGroup,
    sampler: Option<wgpu::Sampler>,
    pass: Option<VisibilityPass>,
}

impl Visibility {
    pub fn new(
        device: &wgpu::Device,
        kind: VisibilityKind,
        choice: ViewChoice,
        buffers: &Buffers,
        textures: &Textures,
    ) -> Self {
        let layout = layout(device, kind);
        let sampler = kind.sampler().map(|sampler| create_sampler(device, sampler));
        let bind_group = bind(device, kind, &layout, sampler.as_ref(), (buffers, textures));
        Self { kind, choice, layout, bind_group, sampler, pass: None }
    }

    /// Binds maps that were made anew.
    pub fn bind_again(&mut self, device: &wgpu::Device, buffers: &Buffers, textures: &Textures) {
        self.bind_group = bind(device, self.kind, &self.layout, self.sampler.as_ref(), (buffers, textures));
    }

    /// The full-screen pass, made when it is first used.
    pub fn pass(&mut self, device: &wgpu::Device, format: wgpu::TextureFormat) -> (&VisibilityPass, &wgpu::BindGroup) {
        let new = || VisibilityPass::new(device, self.kind, self.choice, &self.layout, format);
        let pass = self.pass.get_or_insert_with(new);
        (pass, &self.bind_group)
    }

    /// Drops a pass that could not be made; the next use makes it again.
    pub fn drop_pass(&mut self) {
        self.pass = None;
    }
}

const UNIFORM: wgpu::BindingType = wgpu::BindingType::Buffer {
    ty: wgpu::BufferBindingType::Uniform,
    has_dynamic_offset: false,
    min_binding_size: None,
};

/// The eye's view of a deferred renderer, for [`Shadows::encode_visibility`](crate::Shadows::encode_visibility).
#[derive(Clone, Copy, Debug)]
pub struct EyeInput<'a> {
    /// The eye's depth buffer, single-sampled; needs `TEXTURE_BINDING`.
    pub depth: &'a wgpu::TextureView,
    /// World space from the eye's clip space, for the depths that the buffer holds: reversed z needs nothing more.
    pub world_from_eye_clip: glam::DMat4,
    /// Depth-buffer value where nothing was drawn: 1, or 0 with reversed z.
    pub background_depth: f32,
    /// Where visibility goes, of the depth buffer's size: a colour attachment of the format given as
    /// [`visibility_format`](crate::ShadowOptions::visibility_format). Red holds visibility, 0 dark to 1 lit.
    pub target: &'a wgpu::TextureView,
}

/// The full-screen pass.
#[derive(Debug)]
pub(crate) struct VisibilityPass {
    eye_layout: wgpu::BindGroupLayout,
    eye_view: wgpu::Buffer,
    pipeline: wgpu::RenderPipeline,
}

impl VisibilityPass {
    pub fn new(
        device: &wgpu::Device,
        kind: VisibilityKind,
        choice: ViewChoice,
        visibility_layout: &wgpu::BindGroupLayout,
        format: wgpu::TextureFormat,
    ) -> Self {
        let label = Some("visibility");
        let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::FRAGMENT,
            ty,
            count: None,
        };
        let eye_layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label,
            entries: &[entry(0, UNIFORM), entry(1, DEPTH)],
        });
        let eye_view = device.create_buffer(&wgpu::BufferDescriptor {
            label,
            size: size_of::<EyeView>() as u64,
            usage: wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label,
            source: wgpu::ShaderSource::Wgsl(pass_wgsl(kind, choice).into()),
        });
        let layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label,
            bind_group_layouts: &[Some(&eye_layout), Some(visibility_layout)],
            immediate_size: 0,
        });
        let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
            label,
            layout: Some(&layout),
            vertex: wgpu::VertexState {
                module: &module,
                entry_point: Some("vertex_visibility"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                buffers: &[],
            },
            primitive: wgpu::PrimitiveState::default(),
            depth_stencil: None,
            multisample: wgpu::MultisampleState::default(),
            fragment: Some(wgpu::FragmentState {
                module: &module,
                entry_point: Some("fragment_visibility"),
                compilation_options: wgpu::PipelineCompilationOptions::default(),
                targets: &[Some(format.into())],
            }),
            multiview_mask: None,
            cache: None,
        });
        Self { eye_layout, eye_view, pipeline }
    }

    /// Uploads the eye's view and binds it with the eye's depth buffer.
    pub fn bind_eye(&self, device: &wgpu::Device, queue: &wgpu::Queue, eye: &EyeInput<'_>) -> wgpu::BindGroup {
        let record = EyeView {
            world_from_eye_clip: eye.world_from_eye_clip.as_mat4().to_cols_array(),
            background_depth: eye.background_depth,
            ..EyeView::default()
        };
        queue.write_buffer(&self.eye_view, 0, bytemuck::bytes_of(&record));
        device.create_bind_group(&wgpu::BindGroupDescriptor {
            label: Some("visibility"),
            layout: &self.eye_layout,
            entries: &[
                wgpu::BindGroupEntry { binding: 0, resource: self.eye_view.as_entire_binding() },
                wgpu::BindGroupEntry { binding: 1, resource: wgpu::BindingResource::TextureView(eye.depth) },
            ],
        })
    }

    pub fn encode<T: PassTimer>(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        eye: &EyeInput<'_>,
        [eye_group, shadow_group]: [&wgpu::BindGroup; 2],
        timer: &mut T,
    ) {
        let query = timer.begin("visibility", encoder);
        {
            let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
                label: Some("visibility"),
                color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                    view: eye.target,
                    depth_slice: None,
                    resolve_target: None,
                    ops: wgpu::Operations {
                        load: wgpu::LoadOp::Clear(wgpu::Color::WHITE),
                        store: wgpu::StoreOp::Store,
                    },
                })],
                depth_stencil_attachment: None,
                timestamp_writes: T::render_writes(&query),
                occlusion_query_set: None,
                multiview_mask: None,
            });
            pass.set_pipeline(&self.pipeline);
            pass.set_bind_group(0, eye_group, &[]);
            pass.set_bind_group(1, shadow_group, &[]);
            pass.draw(0..3, 0..1);
        }
        timer.end(query, encoder);
    }
}
