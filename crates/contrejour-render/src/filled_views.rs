//! What stages and passes made for each view of each light, taken before other views fill the lists anew.

use contrejour_gpu::{FilledView, LightHandle, Untimed};
use contrejour_layout::SilhouetteEdge;
use contrejour_plan::{BufferKind, Pass, Stage};

use crate::Gpu;
use crate::error::{DrawError, MAX_REPEATS};
use crate::readback::{ReadError, copied_buffer};
use crate::renderer::Renderer;
use crate::shaders::COUNTED_TRIANGLES;
use crate::silhouettes::read_pages;
use crate::targets::target_texture;

/// What a view of a light made.
#[derive(Debug)]
pub(crate) struct Found {
    pub light: LightHandle,
    /// Its index among those of the light.
    pub view: usize,
    /// None where the light's plan does not look for them.
    pub silhouettes: Vec<SilhouetteEdge>,
    /// None where it has no silhouette map.
    pub triangles: Option<CountedTriangles>,
}

/// How many triangles of the pass that fills a silhouette map cover each of its texels.
#[derive(Debug)]
pub(crate) struct CountedTriangles {
    pub pass: Pass,
    /// One channel of [`COUNT_FORMAT`].
    pub counts: wgpu::Texture,
}

/// Copies of buffers, to be read when the frame was submitted.
struct Copied {
    light: LightHandle,
    view: usize,
    counters: Vec<wgpu::Buffer>,
    silhouettes: Vec<wgpu::Buffer>,
    triangles: Option<CountedTriangles>,
}

impl Copied {
    fn read(self, gpu: &Gpu) -> Result<Found, ReadError> {
        let Self { light, view, counters, silhouettes, triangles } = self;
        let pages = counters.iter().zip(&silhouettes).map(|(counters, list)| (counters.slice(..), list.slice(..)));
        Ok(Found { light, view, silhouettes: read_pages(gpu, pages)?, triangles })
    }
}

/// Its sums are exact up to 2048, and every device blends it.
const COUNT_FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::R16Float;

const SUM: wgpu::BlendComponent = wgpu::BlendComponent {
    src_factor: wgpu::BlendFactor::One,
    dst_factor: wgpu::BlendFactor::One,
    operation: wgpu::BlendOperation::Add,
};

impl Renderer {
    /// What all views of all lights made.
    ///
    /// # Errors
    ///
    /// [`DrawError`] when the device does not allow the frame or fails.
    pub(crate) fn find_in_views(&mut self) -> Result<Vec<Found>, DrawError> {
        for _ in 0..MAX_REPEATS {
            let found = self.find_what_fits()?;
            if self.cast.wait_until_done(&self.gpu)? {
                return Ok(found);
            }
        }
        Err(DrawError::Incomplete)
    }

    fn find_what_fits(&mut self) -> Result<Vec<Found>, DrawError> {
        let eye_local = self.eye_local();
        let Self { gpu, cast, .. } = self;
        cast.shadows.redraw();
        cast.prepare(gpu, &self.casters, self.lights.casting(), &eye_local)?;
        let mut looking = Vec::new();
        let mut maps = Vec::new();
        for &light in self.lights.handles.iter().flatten() {
            let Some(plan) = cast.shadows.plan(light) else { continue };
            if plan.has_stage(Stage::DetectSilhouette) {
                looking.push(light);
            }
            let map = cast.shadows.maps(light).silhouette_map;
            maps.extend(plan.silhouette_map_pass().zip(map).map(|(pass, map)| (light, pass, map.width())));
        }
        let counter = TriangleCounter::new(gpu);
        let mut encoder = gpu.device.create_command_encoder(&wgpu::CommandEncoderDescriptor::default());
        let mut copies = Vec::new();
        cast.shadows.encode_each(&mut encoder, &mut Untimed, |encoder, view| {
            let is_looking = looking.contains(&view.light);
            let mut copied = |kind| -> Vec<wgpu::Buffer> {
                let buffers = view.buffers(kind).filter(|_| is_looking);
                buffers.map(|buffer| copied_buffer(gpu, encoder, buffer)).collect()
            };
            let (counters, silhouettes) = (copied(BufferKind::Counters), copied(BufferKind::Silhouettes));
            let map = maps.iter().find(|(light, ..)| *light == view.light);
            let triangles = map.map(|&(_, pass, size)| CountedTriangles {
                pass,
                counts: counter.count(encoder, view, (pass, size), None),
            });
            copies.push(Copied { light: view.light, view: view.view, counters, silhouettes, triangles });
        });
        gpu.queue.submit([encoder.finish()]);
        Ok(copies.into_iter().map(|copied| copied.read(gpu)).collect::<Result<_, _>>()?)
    }
}

/// Draws the triangles of a pass once more, and counts them.
pub(crate) struct TriangleCounter<'a> {
    gpu: &'a Gpu,
    module: wgpu::ShaderModule,
}

impl<'a> TriangleCounter<'a> {
    pub fn new(gpu: &'a Gpu) -> Self {
        let module = gpu.device.create_shader_module(wgpu::ShaderModuleDescriptor {
            label: Some("counted triangles"),
            source: wgpu::ShaderSource::Wgsl(COUNTED_TRIANGLES.into()),
        });
        Self { gpu, module }
    }

    /// How many triangles cover each of so many texels along a side.
    pub fn count(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        view: &FilledView<'_>,
        (pass, size): (Pass, u32),
        timestamp_writes: Option<wgpu::RenderPassTimestampWrites<'_>>,
    ) -> wgpu::Texture {
        let Self { gpu, module } = self;
        let counts =
            target_texture(gpu, "counted triangles", [size; 2], 1, COUNT_FORMAT, wgpu::TextureUsages::COPY_SRC);
        let target = counts.create_view(&wgpu::TextureViewDescriptor::default());
        let ops = wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store };
        let mut into = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: Some("counted triangles"),
            color_attachments: &[Some(wgpu::RenderPassColorAttachment {
                view: &target,
                depth_slice: None,
                resolve_target: None,
                ops,
            })],
            timestamp_writes,
            ..Default::default()
        });
        let fragment = wgpu::FragmentState {
            module,
            entry_point: Some("fragment_counted"),
            compilation_options: wgpu::PipelineCompilationOptions::default(),
            targets: &[Some(wgpu::ColorTargetState {
                format: COUNT_FORMAT,
                blend: Some(wgpu::BlendState { color: SUM, alpha: SUM }),
                write_mask: wgpu::ColorWrites::ALL,
            })],
        };
        view.draw_again(&gpu.device, pass, &fragment, &mut into);
        drop(into);
        counts
    }
}
