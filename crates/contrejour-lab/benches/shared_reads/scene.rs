//! Scenes that some of eight lights see.

use std::collections::VecDeque;
use std::sync::Arc;
use std::time::Instant;

use contrejour_gpu::{CasterInput, LightHandle, Positions, ShadowOptions, Shadows, Untimed};
use contrejour_lab::{Triangles, torus};
use contrejour_layout::{Counters, SilhouetteEdge};
use contrejour_mesh::{BuildOptions, TopologyAwareMesh};
use contrejour_plan::{BufferKind, Light, LightKind};
use contrejour_render::{Gpu, copied_buffer, read_buffer};
use glam::{DMat4, DVec3};

use crate::RECORDING;
use crate::split::{Split, time};

/// Frames after which a frame must have had room for everything.
const MAX_FRAMES: usize = 4;

/// Casters with their lights.
pub struct Scene {
    shadows: Shadows,
    light: LightHandle,
}

impl Scene {
    pub fn new(gpu: &Gpu, triangles: &Triangles, lights: &[Light], options: &ShadowOptions) -> Self {
        let mut shadows = Shadows::new(&gpu.device).expect("the device is good");
        let beside = DMat4::from_translation(1.2 * DVec3::Y) * DMat4::from_scale(DVec3::new(-0.2, 0.2, 0.2));
        for (Triangles { positions, triangles }, world_from_object) in
            [(triangles, DMat4::IDENTITY), (&torus(16, 10), beside)]
        {
            let mesh = TopologyAwareMesh::build(positions, triangles, &BuildOptions::default());
            let mesh = shadows.add_mesh(Arc::new(mesh.expect("a torus has a topology"))).expect("the mesh fits");
            let caster = CasterInput { mesh, world_from_object, positions: Positions::OfMesh };
            shadows.add_caster(&caster).expect("the mesh is there");
        }
        let mut handles = lights.iter().map(|light| shadows.add_light(light, options).expect("the light is good"));
        let light = handles.by_ref().last().expect("there is a light");
        let mut scene = Self { shadows, light };
        for _ in 0..MAX_FRAMES {
            scene.record(gpu);
        }
        assert!(scene.shadows.is_complete(), "lists have room after a few frames");
        scene
    }

    /// Views that are tested together at most.
    pub fn seats(&self) -> usize {
        self.shadows.plan(self.light).expect("a frame was prepared").seats as usize
    }

    /// Draws a frame. Returns the time to record it. Unit: seconds.
    fn record(&mut self, gpu: &Gpu) -> f64 {
        self.shadows.redraw();
        self.shadows.prepare(&gpu.device, &gpu.queue).expect("the frame can be prepared");
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let clock = Instant::now();
        self.shadows.encode(&mut encoder, &mut Untimed);
        let seconds = clock.elapsed().as_secs_f64();
        gpu.queue.submit([encoder.finish()]);
        self.shadows.wait_for_counters(&gpu.device).expect("the frame is counted");
        seconds
    }

    /// What the parts of a frame take, in their order. Unit: seconds.
    pub fn times(&mut self, gpu: &Gpu) -> Vec<(&'static str, f64)> {
        let mut times = vec![(RECORDING, self.record(gpu))];
        self.shadows.redraw();
        self.shadows.prepare(&gpu.device, &gpu.queue).expect("the frame can be prepared");
        let mut split = Split::new(gpu);
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        self.shadows.encode(&mut encoder, &mut split);
        times.extend(split.parts.into_iter().map(|(name, commands)| (name, time(gpu, commands))));
        gpu.queue.submit([encoder.finish()]);
        self.shadows.wait_for_counters(&gpu.device).expect("the frame is counted");
        times
    }

    /// The silhouette of each view, sorted.
    pub fn silhouettes(&mut self, gpu: &Gpu) -> Vec<Vec<SilhouetteEdge>> {
        self.shadows.redraw();
        self.shadows.prepare(&gpu.device, &gpu.queue).expect("the frame can be prepared");
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let mut copies = VecDeque::new();
        self.shadows.encode_each(&mut encoder, &mut Untimed, |encoder, view| {
            for kind in [BufferKind::Counters, BufferKind::Silhouettes] {
                copies.extend(view.buffers(kind).map(|part| copied_buffer(gpu, encoder, part)));
            }
        });
        gpu.queue.submit([encoder.finish()]);
        let read = |buffer: &wgpu::Buffer| read_buffer(gpu, buffer.slice(..), buffer.size()).expect("it can be read");
        let mut silhouettes = Vec::new();
        while let Some((counters, list)) = copies.pop_front().zip(copies.pop_front()) {
            let counters: Counters = bytemuck::pod_read_unaligned(&read(&counters));
            let mut edges: Vec<SilhouetteEdge> = bytemuck::pod_collect_to_vec(&read(&list));
            edges.truncate(counters.silhouette_edges as usize);
            edges.sort_unstable_by_key(|edge| (edge.caster, edge.edge_id));
            silhouettes.push(edges);
        }
        silhouettes
    }
}

/// Eight of them, that all see what is near the origin; one lies in the plane of a face, and one on an axis.
pub fn lights(triangles: &Triangles) -> [Light; 8] {
    let spot = |position| LightKind::Spot {
        position,
        target: DVec3::ZERO,
        cone_angle: 1.5,
        radius: 0.03,
        near: 0.1,
        far: 1e3,
    };
    let sun = |towards_light| LightKind::Directional {
        towards_light,
        center: DVec3::ZERO,
        half_extent: 4.0,
        half_depth: 4.0,
        angular_radius: 0.01,
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
