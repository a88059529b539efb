//! What exact facing costs: its stages against the fastest test by bare floats, which errs.
//!
//! `cargo bench -p contrejour-lab --bench facing [-- ROUNDS]`
//!
//! Bare is a stored plane and one dot product a face, its bits written to the same words; of several forms the fastest
//! counts. Times are from submission to completion, less those of empty dispatches of the same shape; all take turns, and
//! the least of each are compared, since whatever else the machine does only adds. Software devices compute on this
//! process's threads: there it is the time that these ran, on all cores together.
//!
//! The column `first` is `classify_faces` alone, `all` is every stage up to `resolve_faces`; bars are for `all`.
//! `../shared/meshes` beside the checkout, or the folder that `CONTREJOUR_MESHES` names, has the mechanical parts.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use contrejour_gpu::{CasterInput, LightHandle, PassTimer, Positions, ShadowOptions, Shadows};
use contrejour_lab::{Triangles, torus};
use contrejour_layout::Counters;
use contrejour_mesh::{BuildOptions, TopologyAwareMesh, load};
use contrejour_plan::{BufferKind, Light, LightKind, Outputs, views};
use contrejour_render::Gpu;
use cpu_time::ProcessTime;
use glam::{DMat4, DVec3};
use wgpu::util::{BufferInitDescriptor, DeviceExt};

fn main() {
    // cargo passes `--bench` as well.
    let rounds = std::env::args().skip(1).find_map(|argument| argument.parse().ok()).unwrap_or(31);
    let gpu = Gpu::open().expect("a device can be opened");
    println!("{}, {rounds} rounds", gpu.description());
    println!(
        "{:<34} {:>9} {:>9}  {:<20} {:>7} {:>6} {:>6} {:>6}",
        "", "faces", "left over", "fastest bare form", "ns/face", "first", "all", "bar"
    );
    let mut all_hold = true;
    for (around, across) in [(1000, 500), (2000, 1000)] {
        let mesh = torus(around, across);
        let lights = [point(DVec3::new(2.3, 3.1, 1.7)), point(DVec3::new(-1.9, 2.2, 3.4))];
        all_hold &= measure(&gpu, "torus, a point light", &mesh, &lights, Some(1.15), rounds);
    }
    for file in ["nasty/Brass.obj", "open/EZ_Control_valve.obj"] {
        match read(file) {
            Some(mesh) => {
                let name = format!("{file}, suns on axes");
                let suns = [DVec3::X, DVec3::Y, DVec3::Z].map(sun);
                all_hold &= measure(&gpu, &name, &mesh, &suns, Some(2.0), rounds);
            }
            None => println!("{file}: not there, so not measured"),
        }
    }
    let grid = tilted_grid(354);
    for (name, lights) in [
        ("grid, lights in its plane", [point(DVec3::new(900.5, -200.25, -700.25)), sun(DVec3::new(3.0, -2.0, -1.0))]),
        ("grid, coordinates far apart", [1e-28, -1e-28].map(|z| sun(DVec3::new(1.0, -1.0, z)))),
    ] {
        measure(&gpu, name, &grid, &lights, None, (rounds / 10).max(3));
    }
    gpu.check().expect("the device reports no error");
    println!("{}", if all_hold { "All bars hold." } else { "NOT ALL BARS HOLD." });
}

/// Prints a row; says whether the bar holds, where there is one.
fn measure(gpu: &Gpu, name: &str, mesh: &Triangles, lights: &[Light], bar: Option<f64>, rounds: usize) -> bool {
    let mut stages = Stages::new(gpu, mesh);
    stages.prepare(&lights[0]);
    let planes = stages.shadows.buffer(BufferKind::Planes).expect("a rigid mesh has planes").buffer().clone();
    let face_count = mesh.triangles.len();
    let bare: Vec<_> = forms().into_iter().map(|form| Bare::new(gpu, &form, &planes, face_count)).collect();
    let own_shape = Bare::new(gpu, &WORD_BY_LANE, &planes, face_count);

    let mut times = vec![Vec::new(); 2 * bare.len() + 4];
    let mut counters = Counters::default();
    for round in 0..rounds {
        let light = &lights[round % lights.len()];
        for (form, times) in bare.iter().zip(times.chunks_mut(2)) {
            times[0].push(form.time(gpu, light));
            times[1].push(form.time_empty(gpu, &[form.groups]));
        }
        let own = &mut times[2 * bare.len()..];
        own[0].push(stages.time(gpu, light, "write_recheck_args").0);
        own[1].push(own_shape.time_empty(gpu, &[own_shape.groups]));
        let (time, counted) = stages.time(gpu, light, "detect_silhouette");
        own[2].push(time);
        // Stages that turn counts into dispatches have one workgroup, those over empty lists none.
        own[3].push(own_shape.time_empty(gpu, &[own_shape.groups, 1, 0, 1, 0, 0]));
        counters = counted;
    }

    let least: Vec<f64> = times.into_iter().map(least).collect();
    let mut nets = least.chunks(2).map(|pair| pair[0] - pair[1]);
    let of_forms: Vec<f64> = nets.by_ref().take(bare.len()).collect();
    let [Some(first), Some(all)] = [nets.next(), nets.next()] else { unreachable!("two pairs follow the forms") };
    let (fastest, form) =
        of_forms.into_iter().zip(forms()).min_by(|x, y| x.0.total_cmp(&y.0)).expect("there are forms");
    let left_over = counters.undecided_near + counters.undecided_far;
    let holds = bar.is_none_or(|bar| all <= bar * fastest);
    println!(
        "{name:<34} {face_count:>9} {left_over:>9}  {:<20} {:>7.1} {:>6.2} {:>6.2} {:>6} {}",
        form.name,
        1e9 * all / face_count as f64,
        first / fastest,
        all / fastest,
        bar.map_or("-".to_owned(), |bar| bar.to_string()),
        if holds { "" } else { "missed" },
    );
    holds
}

fn least(times: Vec<Duration>) -> f64 {
    times.into_iter().min().unwrap_or_default().as_secs_f64()
}

/// The library's stages on one mesh.
struct Stages {
    device: wgpu::Device,
    queue: wgpu::Queue,
    shadows: Shadows,
    light: Option<LightHandle>,
}

impl Stages {
    fn new(gpu: &Gpu, mesh: &Triangles) -> Self {
        let mut shadows = Shadows::new(&gpu.device).expect("the device is good");
        let mesh = TopologyAwareMesh::build(&mesh.positions, &mesh.triangles, &BuildOptions::default());
        let mesh = shadows.add_mesh(Arc::new(mesh.expect("the mesh has a topology"))).expect("the mesh fits");
        let caster = CasterInput { mesh, world_from_object: DMat4::IDENTITY, positions: Positions::OfMesh };
        shadows.add_caster(&caster).expect("the mesh is there");
        Self { device: gpu.device.clone(), queue: gpu.queue.clone(), shadows, light: None }
    }

    fn prepare(&mut self, light: &Light) {
        match self.light {
            Some(handle) => self.shadows.set_light(handle, light).expect("the light is good"),
            None => {
                let options = ShadowOptions { outputs: Outputs::Silhouettes, ..ShadowOptions::default() };
                let handle = self.shadows.add_light(light, &options);
                self.light = Some(handle.expect("the light is good"));
            }
        }
        self.shadows.prepare(&self.device, &self.queue).expect("the frame can be prepared");
    }

    /// Time of the stages before the one of this name, and what the frame counted.
    fn time(&mut self, gpu: &Gpu, light: &Light, before: &'static str) -> (Duration, Counters) {
        // A frame like the one before records nothing.
        self.prepare(&sun(DVec3::new(0.3, 0.5, 0.7)));
        self.prepare(light);
        let mut cut = Cut { device: self.device.clone(), before, stages: None };
        let mut encoder = self.device.create_command_encoder(&Default::default());
        self.shadows.encode(&mut encoder, &mut cut);
        let time = time(gpu, cut.stages.expect("the frame has stages"));
        self.queue.submit([encoder.finish()]);
        (time, self.shadows.wait_for_counters(&self.device).expect("the frame is counted"))
    }
}

/// Parts a frame's commands where a stage begins.
struct Cut {
    device: wgpu::Device,
    before: &'static str,
    stages: Option<wgpu::CommandBuffer>,
}

impl PassTimer for Cut {
    type Query = ();

    fn begin(&mut self, name: &'static str, encoder: &mut wgpu::CommandEncoder) {
        if name == self.before {
            let rest = self.device.create_command_encoder(&Default::default());
            self.stages = Some(std::mem::replace(encoder, rest).finish());
        }
    }

    fn compute_writes((): &()) -> Option<wgpu::ComputePassTimestampWrites<'_>> {
        None
    }

    fn render_writes((): &()) -> Option<wgpu::RenderPassTimestampWrites<'_>> {
        None
    }

    fn end(&mut self, (): (), _encoder: &mut wgpu::CommandEncoder) {}
}

/// A way to test by bare floats.
#[derive(Clone, Copy)]
struct Form {
    name: &'static str,
    group_size: u32,
    faces_per_group: u32,
    body: &'static str,
}

const WORD_BY_LANE: Form = Form {
    name: "a word a lane, 64",
    group_size: 64,
    faces_per_group: 64 * 32,
    body: "
        var bits = 0u;
        for (var i = 0u; i < 32u; i++) {
            bits |= select(0u, 1u << i, dot_product(32u * index + i) > 0.0);
        }
        if index < arrayLength(&lit) { lit[index] = bits; }",
};

fn forms() -> [Form; 5] {
    const FACE_BY_LANE: &str = "
        if dot_product(index) > 0.0 { atomicOr(&group_lit[lane / 32u], 1u << (lane % 32u)); }
        workgroupBarrier();
        let word = index / 32u;
        if lane % 32u == 0u && word < arrayLength(&lit) { lit[word] = atomicLoad(&group_lit[lane / 32u]); }";
    let face_by_lane = Form { name: "a face a lane, 64", group_size: 64, faces_per_group: 64, body: FACE_BY_LANE };
    [
        WORD_BY_LANE,
        Form { name: "a word a lane, 32", group_size: 32, faces_per_group: 32 * 32, ..WORD_BY_LANE },
        Form { name: "a word a lane, 256", group_size: 256, faces_per_group: 256 * 32, ..WORD_BY_LANE },
        face_by_lane,
        Form { name: "a face a lane, 256", group_size: 256, faces_per_group: 256, ..face_by_lane },
    ]
}

/// A form on a mesh's planes.
struct Bare {
    full: wgpu::ComputePipeline,
    empty: wgpu::ComputePipeline,
    bind_group: wgpu::BindGroup,
    light: wgpu::Buffer,
    groups: u32,
}

impl Bare {
    fn new(gpu: &Gpu, form: &Form, planes: &wgpu::Buffer, face_count: usize) -> Self {
        let device = &gpu.device;
        let Form { group_size, faces_per_group, body, .. } = *form;
        let wgsl = format!(
            "@group(0) @binding(0) var<storage, read> planes: array<vec4f>;
            @group(0) @binding(1) var<storage, read_write> lit: array<u32>;
            @group(0) @binding(2) var<uniform> light: vec4f;
            var<workgroup> group_lit: array<atomic<u32>, 8>;
            fn dot_product(face: u32) -> f32 {{
                let plane = planes[face];
                return plane.x * light.x + plane.y * light.y + plane.z * light.z + plane.w * light.w;
            }}
            @compute @workgroup_size({group_size})
            fn full(
                @builtin(workgroup_id) group: vec3u,
                @builtin(num_workgroups) groups: vec3u,
                @builtin(local_invocation_index) lane: u32,
            ) {{
                let index = (group.y * groups.x + group.x) * {group_size}u + lane;
                {body}
            }}
            @compute @workgroup_size({group_size})
            fn empty() {{}}"
        );
        let source = wgpu::ShaderSource::Wgsl(wgsl.into());
        let module = device.create_shader_module(wgpu::ShaderModuleDescriptor { label: None, source });
        let entry = |binding, ty| wgpu::BindGroupLayoutEntry {
            binding,
            visibility: wgpu::ShaderStages::COMPUTE,
            ty: wgpu::BindingType::Buffer { ty, has_dynamic_offset: false, min_binding_size: None },
            count: None,
        };
        let layout = device.create_bind_group_layout(&wgpu::BindGroupLayoutDescriptor {
            label: None,
            entries: &[
                entry(0, wgpu::BufferBindingType::Storage { read_only: true }),
                entry(1, wgpu::BufferBindingType::Storage { read_only: false }),
                entry(2, wgpu::BufferBindingType::Uniform),
            ],
        });
        let pipeline_layout = device.create_pipeline_layout(&wgpu::PipelineLayoutDescriptor {
            label: None,
            bind_group_layouts: &[Some(&layout)],
            immediate_size: 0,
        });
        let pipeline = |entry_point| {
            device.create_compute_pipeline(&wgpu::ComputePipelineDescriptor {
                label: None,
                layout: Some(&pipeline_layout),
                module: &module,
                entry_point: Some(entry_point),
                compilation_options: Default::default(),
                cache: None,
            })
        };
        let buffer = |bytes: &[u8], usage| {
            device.create_buffer_init(&BufferInitDescriptor { label: None, contents: bytes, usage })
        };
        let lit = buffer(&vec![0; face_count.div_ceil(32) * 4], wgpu::BufferUsages::STORAGE);
        let light = buffer(&[0; 16], wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST);
        let entries = [planes, &lit, &light].into_iter().zip(0..);
        let entries: Vec<_> = entries
            .map(|(buffer, binding)| wgpu::BindGroupEntry { binding, resource: buffer.as_entire_binding() })
            .collect();
        let bind_group =
            device.create_bind_group(&wgpu::BindGroupDescriptor { label: None, layout: &layout, entries: &entries });
        let groups = (face_count as u32).div_ceil(faces_per_group);
        Self { full: pipeline("full"), empty: pipeline("empty"), bind_group, light, groups }
    }

    fn time(&self, gpu: &Gpu, light: &Light) -> Duration {
        let light = views(light).expect("the light is good")[0].light_world.as_vec4();
        gpu.queue.write_buffer(&self.light, 0, bytemuck::cast_slice(&light.to_array()));
        gpu.queue.submit([]);
        gpu.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device works");
        self.time_passes(gpu, &self.full, &[self.groups])
    }

    /// A pass for each number of workgroups.
    fn time_empty(&self, gpu: &Gpu, groups: &[u32]) -> Duration {
        self.time_passes(gpu, &self.empty, groups)
    }

    fn time_passes(&self, gpu: &Gpu, pipeline: &wgpu::ComputePipeline, groups: &[u32]) -> Duration {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        for &groups in groups {
            let mut pass = encoder.begin_compute_pass(&Default::default());
            pass.set_pipeline(pipeline);
            pass.set_bind_group(0, &self.bind_group, &[]);
            pass.dispatch_workgroups(groups.min(65_535), groups.div_ceil(65_535), 1);
        }
        time(gpu, encoder.finish())
    }
}

/// From submission to completion.
fn time(gpu: &Gpu, commands: wgpu::CommandBuffer) -> Duration {
    let (clock, threads) = (Instant::now(), ProcessTime::now());
    let submission = gpu.queue.submit([commands]);
    let wait = wgpu::PollType::Wait { submission_index: Some(submission), timeout: None };
    gpu.device.poll(wait).expect("the device works");
    if gpu.is_software() { threads.elapsed() } else { clock.elapsed() }
}

fn point(position: DVec3) -> Light {
    let kind = LightKind::Spot { position, target: DVec3::ZERO, cone_angle: 1.0, radius: 0.0, near: 0.1, far: 1e4 };
    Light { kind, color: [1.0; 3] }
}

fn sun(towards_light: DVec3) -> Light {
    let kind = LightKind::Directional {
        towards_light,
        center: DVec3::ZERO,
        half_extent: 1.0,
        half_depth: 1.0,
        angular_radius: 0.0,
    };
    Light { kind, color: [1.0; 3] }
}

/// Twice `size` squared faces in the plane x + y + z = 0, their corners whole numbers.
fn tilted_grid(size: u32) -> Triangles {
    let columns = size + 1;
    let positions = (0..columns * columns).map(|vertex| {
        let (u, v) = ((vertex / columns) as f32, (vertex % columns) as f32);
        [u + v, u - v, -2.0 * u]
    });
    let triangles = (0..size * size).flat_map(|cell| {
        let a = cell / size * columns + cell % size;
        [[a, a + 1, a + columns], [a + 1, a + columns + 1, a + columns]]
    });
    Triangles { positions: positions.collect(), triangles: triangles.collect() }
}

/// A file of the shared meshes, all its nodes as one; `None` when it is not there.
fn read(file: &str) -> Option<Triangles> {
    let beside_workspace = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/meshes");
    let path = std::env::var_os("CONTREJOUR_MESHES").map_or(beside_workspace, PathBuf::from).join(file);
    let meshes = path.is_file().then(|| load(&path).expect("the shared meshes can be read"))?.meshes;
    let mut all = Triangles::default();
    for mesh in meshes {
        let first = all.positions.len() as u32;
        all.triangles.extend(mesh.triangles.iter().map(|corners| corners.map(|index| first + index)));
        all.positions.extend(mesh.positions);
    }
    Some(all)
}
