//! What the stages read, as the library itself leaves it for eight lights.

use std::sync::Arc;
use std::time::Duration;

use bytemuck::cast_slice;
use contrejour_gpu::{CasterInput, Positions, ShadowOptions, Shadows, Untimed};
use contrejour_lab::{Triangles, torus};
use contrejour_layout::{Counters, LightView};
use contrejour_mesh::{BuildOptions, TopologyAwareMesh};
use contrejour_plan::{BufferKind, Light, LightKind, Outputs, ShadowSettings};
use contrejour_render::{Gpu, copied_buffer, read_buffer};
use glam::{DMat4, DVec3};
use wgpu::util::{BufferInitDescriptor, DeviceExt};

use crate::MAX_LIGHTS;
use crate::kernel::time;

/// Silhouettes of closed meshes have far fewer edges than one in so many.
const EDGES_OF_SILHOUETTE: u32 = 4;

/// Whole frames that are timed.
const FRAMES: usize = 3;

/// A scene that eight lights see.
pub struct Scene {
    shadows: Shadows,
    pub face_count: usize,
    /// Blocks that every light sees, and nothing else.
    pub counters: Counters,
    pub view: LightView,
    view_buffer: wgpu::Buffer,
    /// The lights as each caster sees them, light after light.
    caster_lights: Vec<Vec<u8>>,
    /// The lit bits that the library finds, light after light.
    lit: Vec<Vec<u32>>,
}

impl Scene {
    pub fn new(gpu: &Gpu, triangles: &Triangles) -> Self {
        let small = small();
        let mut shadows = shadows(gpu, &[(triangles, DMat4::IDENTITY), (&small, beside())]);
        let options = ShadowOptions { outputs: Outputs::Silhouettes, ..ShadowOptions::default() };
        let lights = lights(triangles);
        let handle = shadows.add_light(&lights[0], &options).expect("the light is good");
        let (mut caster_lights, mut lit) = (Vec::new(), Vec::new());
        let mut counters = Counters::default();
        for light in &lights {
            shadows.set_light(handle, light).expect("the light is good");
            shadows.prepare(&gpu.device, &gpu.queue).expect("the frame can be prepared");
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            shadows.encode(&mut encoder, &mut Untimed);
            let kinds = [BufferKind::CasterLights, BufferKind::Lit];
            let copies = kinds.map(|kind| copied_buffer(gpu, &mut encoder, shadows.buffer(kind).expect("it is there")));
            gpu.queue.submit([encoder.finish()]);
            let [of_casters, bits] = copies.map(|copy| read_buffer(gpu, &copy, copy.size()).expect("it can be read"));
            caster_lights.push(of_casters);
            lit.push(bytemuck::pod_collect_to_vec::<_, u32>(&bits));
            counters = shadows.wait_for_counters(&gpu.device).expect("the frame is counted");
            assert_eq!(counters.casters, 2, "every light sees every caster");
        }
        let Counters { face_items, edge_items, .. } = counters;
        let counters = Counters { face_items, edge_items, ..Counters::default() };
        let silhouette_capacity = 64 * edge_items / EDGES_OF_SILHOUETTE;
        let view = LightView { silhouette_capacity, ..LightView::default() };
        let view_buffer = buffer(gpu, bytemuck::bytes_of(&view), wgpu::BufferUsages::UNIFORM);
        let face_count = triangles.triangles.len() + small.triangles.len();
        Self { shadows, face_count, counters, view, view_buffer, caster_lights, lit }
    }

    /// What all lights read alike.
    pub fn buffer(&self, kind: BufferKind) -> &wgpu::Buffer {
        match kind {
            BufferKind::LightView => &self.view_buffer,
            kind => self.shadows.buffer(kind).expect("the frame has it"),
        }
    }

    /// The light of an index as each caster sees it, or one light's behind the other's for a shared read.
    pub fn caster_lights(&self, gpu: &Gpu, lights: std::ops::Range<usize>) -> wgpu::Buffer {
        buffer(gpu, &self.caster_lights[lights].concat(), wgpu::BufferUsages::STORAGE)
    }

    /// The lit bits of a light.
    pub fn lit(&self, gpu: &Gpu, light: usize) -> wgpu::Buffer {
        buffer(gpu, cast_slice(&self.lit[light]), wgpu::BufferUsages::STORAGE)
    }

    /// The lit bits of all lights, a byte for each face.
    pub fn lit_bytes(&self, gpu: &Gpu) -> wgpu::Buffer {
        let is_lit = |face: usize, light: usize| self.lit[light][face / 32] >> (face % 32) & 1;
        let byte = |face| (0..MAX_LIGHTS).fold(0, |byte, light| byte | (is_lit(face, light) << light) as u8);
        let bytes: Vec<u8> = (0..self.lit_words() * 32).map(byte).collect();
        buffer(gpu, &bytes, wgpu::BufferUsages::STORAGE)
    }

    pub fn lit_words(&self) -> usize {
        self.lit[0].len()
    }
}

/// Casters that no light is on yet.
fn shadows(gpu: &Gpu, casters: &[(&Triangles, DMat4)]) -> Shadows {
    let mut shadows = Shadows::new(&gpu.device).expect("the device is good");
    for (Triangles { positions, triangles }, world_from_object) in casters {
        let mesh = TopologyAwareMesh::build(positions, triangles, &BuildOptions::default());
        let mesh = shadows.add_mesh(Arc::new(mesh.expect("a torus has a topology"))).expect("the mesh fits");
        let caster = CasterInput { mesh, world_from_object: *world_from_object, positions: Positions::OfMesh };
        shadows.add_caster(&caster).expect("the mesh is there");
    }
    shadows
}

/// A whole frame of the same lights with smoothies, from submission to completion: the least of a few.
pub fn frame_time(gpu: &Gpu, triangles: &Triangles, map_size: u32) -> Duration {
    let small = small();
    let mut shadows = shadows(gpu, &[(triangles, DMat4::IDENTITY), (&small, beside())]);
    let settings = ShadowSettings { map_size, ..ShadowSettings::default() };
    let options = ShadowOptions { settings, ..ShadowOptions::default() };
    for light in lights(triangles) {
        shadows.add_light(&light, &options).expect("the light is good");
    }
    let mut times = Vec::new();
    while times.len() < FRAMES {
        shadows.redraw();
        shadows.prepare(&gpu.device, &gpu.queue).expect("the frame can be prepared");
        let time = time(gpu, |encoder| shadows.encode(encoder, &mut Untimed));
        shadows.wait_for_counters(&gpu.device).expect("the frame is counted");
        if shadows.is_complete() {
            times.push(time);
        }
    }
    times.into_iter().min().unwrap_or_default()
}

fn small() -> Triangles {
    torus(16, 10)
}

fn beside() -> DMat4 {
    DMat4::from_translation(1.2 * DVec3::Y) * DMat4::from_scale(DVec3::new(-0.2, 0.2, 0.2))
}

pub fn buffer(gpu: &Gpu, contents: &[u8], usage: wgpu::BufferUsages) -> wgpu::Buffer {
    let usage = usage | wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
    gpu.device.create_buffer_init(&BufferInitDescriptor { label: None, contents, usage })
}

/// Eight of them, that all see what is near the origin; one lies in the plane of a face, and one on an axis.
fn lights(triangles: &Triangles) -> [Light; MAX_LIGHTS] {
    let spot =
        |position| LightKind::Spot { position, target: DVec3::ZERO, cone_angle: 1.5, radius: 0.0, near: 0.1, far: 1e3 };
    let sun = |towards_light| LightKind::Directional {
        towards_light,
        center: DVec3::ZERO,
        half_extent: 4.0,
        half_depth: 4.0,
        angular_radius: 0.0,
    };
    let [a, b, _] = triangles.triangles[0].map(|vertex| {
        let position = triangles.positions[vertex as usize];
        DVec3::from(position.map(f64::from))
    });
    [
        spot(DVec3::new(2.3, 3.1, 1.7)),
        sun(DVec3::new(0.3, 0.5, 0.7)),
        spot(a + 9.0 * (b - a).normalize()),
        sun(DVec3::X),
        spot(DVec3::new(-1.9, 2.2, 3.4)),
        spot(DVec3::new(-3.0, -2.6, 1.0)),
        sun(DVec3::new(-0.2, 0.9, -0.4)),
        spot(DVec3::new(0.5, 4.0, -2.5)),
    ]
    .map(|kind| Light { kind, color: [1.0; 3] })
}
