//! What every headless example needs and no example is about: a device, a body over a floor, a picture on disk.

use std::f64::consts::TAU;
use std::path::PathBuf;

use contrejour::glam::{DMat4, DVec3, Mat4, dcamera::rh};
use contrejour::prelude::*;
use contrejour::wgpu::{self, util::DeviceExt};

/// Result of an example.
pub type Outcome = Result<(), Box<dyn std::error::Error>>;

/// Side of the pictures in pixels.
pub const SIZE: u32 = 512;

/// Opens any device with what contrejour needs and can use.
pub fn open_device() -> Result<(wgpu::Device, wgpu::Queue), Box<dyn std::error::Error>> {
    let instance = wgpu::Instance::default();
    let adapter = pollster::block_on(instance.request_adapter(&wgpu::RequestAdapterOptions::default()))?;
    let descriptor = wgpu::DeviceDescriptor {
        required_features: Shadows::required_features() | (adapter.features() & Shadows::optional_features()),
        required_limits: Shadows::required_limits(),
        ..Default::default()
    };
    Ok(pollster::block_on(adapter.request_device(&descriptor))?)
}

/// A torus around the y axis.
pub struct Torus {
    /// Position of each vertex.
    pub positions: Vec<[f32; 3]>,
    /// Triangles, counter-clockwise from outside.
    pub triangles: Vec<[u32; 3]>,
}

impl Torus {
    /// `around` by `across` quads.
    pub fn new(around: u32, across: u32) -> Self {
        let point = |i: u32| {
            let (major, minor) = (f64::from(i / across) / f64::from(around), f64::from(i % across) / f64::from(across));
            let (major, minor) = (major * TAU, minor * TAU);
            let ring = 1.0 + 0.4 * minor.cos();
            DVec3::new(ring * major.cos(), 0.4 * minor.sin(), -ring * major.sin()).as_vec3().to_array()
        };
        let quad = |i: u32| {
            let next = |i: u32, j: u32| (i % around) * across + j % across;
            let (u, v) = (i / across, i % across);
            let [a, b, c, d] = [next(u, v), next(u + 1, v), next(u + 1, v + 1), next(u, v + 1)];
            [[a, b, c], [a, c, d]]
        };
        let count = around * across;
        Self { positions: (0..count).map(point).collect(), triangles: (0..count).flat_map(quad).collect() }
    }
}

/// A spot light that looks down at the origin.
pub fn light() -> Light {
    Light {
        kind: LightKind::Spot {
            position: DVec3::new(2.0, 6.0, 2.5),
            target: DVec3::ZERO,
            cone_angle: 0.9,
            radius: 0.4,
            near: 2.0,
            far: 12.0,
        },
        color: [1.0; 3],
    }
}

/// Where the body stands: tilted, over the floor.
pub fn world_from_body() -> DMat4 {
    DMat4::from_rotation_x(0.7) * DMat4::from_rotation_z(0.4)
}

/// Clip space of the eye from world space.
pub fn eye_clip_from_world() -> DMat4 {
    let eye = rh::view::look_at_mat4(DVec3::new(3.0, 3.5, 6.0), DVec3::new(0.0, -0.5, 0.0), DVec3::Y);
    rh::proj::directx::perspective(0.7, 1.0, 0.1, 50.0) * eye
}

/// The floor as two triangles in world space, below the body.
pub const FLOOR: [[f32; 3]; 6] =
    [[-8.0, -1.5, 8.0], [8.0, -1.5, 8.0], [8.0, -1.5, -8.0], [-8.0, -1.5, 8.0], [8.0, -1.5, -8.0], [-8.0, -1.5, -8.0]];

/// All corners of body and floor, in world space, ready to be drawn.
pub fn scene_vertices(device: &wgpu::Device, torus: &Torus) -> (wgpu::Buffer, u32) {
    let world = world_from_body().as_mat4();
    let body = torus
        .triangles
        .iter()
        .flatten()
        .map(|&vertex| world.transform_point3(torus.positions[vertex as usize].into()).to_array());
    let corners: Vec<[f32; 3]> = body.chain(FLOOR).collect();
    let buffer = device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("scene"),
        contents: bytemuck::cast_slice(&corners),
        usage: wgpu::BufferUsages::VERTEX,
    });
    (buffer, corners.len() as u32)
}

/// A uniform buffer with the eye's matrix.
pub fn eye_uniform(device: &wgpu::Device) -> wgpu::Buffer {
    let matrix: Mat4 = eye_clip_from_world().as_mat4();
    device.create_buffer_init(&wgpu::util::BufferInitDescriptor {
        label: Some("eye"),
        contents: bytemuck::bytes_of(&matrix),
        usage: wgpu::BufferUsages::UNIFORM,
    })
}

/// A texture of the picture's size.
pub fn target(device: &wgpu::Device, format: wgpu::TextureFormat, usage: wgpu::TextureUsages) -> wgpu::Texture {
    device.create_texture(&wgpu::TextureDescriptor {
        label: None,
        size: wgpu::Extent3d { width: SIZE, height: SIZE, depth_or_array_layers: 1 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format,
        usage: usage | wgpu::TextureUsages::RENDER_ATTACHMENT,
        view_formats: &[],
    })
}

/// Shader of [`draw_depth`].
const DEPTH_SHADER: &str = r#"
@group(0) @binding(0) var<uniform> eye_clip_from_world: mat4x4f;

@vertex
fn vertex_main(@location(0) position_world: vec3f) -> @builtin(position) vec4f {
    return eye_clip_from_world * vec4f(position_world, 1.0);
}
"#;

/// Draws the depth of body and floor as the eye sees it.
pub fn draw_depth(device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder, torus: &Torus, depth: &wgpu::TextureView) {
    let module = device.create_shader_module(wgpu::ShaderModuleDescriptor {
        label: Some("depth"),
        source: wgpu::ShaderSource::Wgsl(DEPTH_SHADER.into()),
    });
    let pipeline = device.create_render_pipeline(&wgpu::RenderPipelineDescriptor {
        label: Some("depth"),
        layout: None,
        vertex: wgpu::VertexState {
            module: &module,
            entry_point: Some("vertex_main"),
            compilation_options: Default::default(),
            buffers: &[Some(wgpu::VertexBufferLayout {
                array_stride: 12,
                step_mode: wgpu::VertexStepMode::Vertex,
                attributes: &wgpu::vertex_attr_array![0 => Float32x3],
            })],
        },
        primitive: Default::default(),
        depth_stencil: Some(wgpu::DepthStencilState {
            format: wgpu::TextureFormat::Depth32Float,
            depth_write_enabled: Some(true),
            depth_compare: Some(wgpu::CompareFunction::Less),
            stencil: Default::default(),
            bias: Default::default(),
        }),
        multisample: Default::default(),
        fragment: None,
        multiview_mask: None,
        cache: None,
    });
    let eye = device.create_bind_group(&wgpu::BindGroupDescriptor {
        label: Some("eye"),
        layout: &pipeline.get_bind_group_layout(0),
        entries: &[wgpu::BindGroupEntry { binding: 0, resource: eye_uniform(device).as_entire_binding() }],
    });
    let (vertices, vertex_count) = scene_vertices(device, torus);
    let mut pass = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some("depth"),
        color_attachments: &[],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: depth,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(1.0), store: wgpu::StoreOp::Store }),
            stencil_ops: None,
        }),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    });
    pass.set_pipeline(&pipeline);
    pass.set_bind_group(0, &eye, &[]);
    pass.set_vertex_buffer(0, vertices.slice(..));
    pass.draw(0..vertex_count, 0..1);
}

/// Waits for the device and brings the bytes of a part of a buffer back.
pub fn read_buffer(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    part: wgpu::BufferSlice<'_>,
) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let staging = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("read back"),
        size: part.size(),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::MAP_READ,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    encoder.copy_buffer_to_buffer(part.buffer(), part.offset(), &staging, 0, part.size());
    encoder.map_buffer_on_submit(&staging, wgpu::MapMode::Read, .., |_| {});
    queue.submit([encoder.finish()]);
    device.poll(wgpu::PollType::wait_indefinitely())?;
    Ok(staging.slice(..).get_mapped_range()?.to_vec())
}

fn color_of(texture: &wgpu::Texture) -> image::ColorType {
    if texture.format() == wgpu::TextureFormat::R8Unorm { image::ColorType::L8 } else { image::ColorType::Rgba8 }
}

/// Waits for the device and brings back a texture of the picture's size.
pub fn read_texture(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    texture: &wgpu::Texture,
) -> Result<Vec<u8>, Box<dyn std::error::Error>> {
    let bytes_per_row = SIZE * u32::from(color_of(texture).bytes_per_pixel());
    let buffer = device.create_buffer(&wgpu::BufferDescriptor {
        label: Some("picture"),
        size: u64::from(bytes_per_row * SIZE),
        usage: wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(bytes_per_row), rows_per_image: None };
    encoder.copy_texture_to_buffer(
        texture.as_image_copy(),
        wgpu::TexelCopyBufferInfo { buffer: &buffer, layout },
        texture.size(),
    );
    queue.submit([encoder.finish()]);
    read_buffer(device, queue, buffer.slice(..))
}

/// Writes a texture of the picture's size as a PNG into the temporary folder; returns its path.
pub fn save(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    texture: &wgpu::Texture,
    name: &str,
) -> Result<PathBuf, Box<dyn std::error::Error>> {
    let path = std::env::temp_dir().join(name);
    image::save_buffer(&path, &read_texture(device, queue, texture)?, SIZE, SIZE, color_of(texture))?;
    Ok(path)
}
