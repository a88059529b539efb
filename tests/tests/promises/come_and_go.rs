//! Meshes, casters and lights come and go: what stays is not touched, what left leaves nothing, and memory does not grow.

use std::sync::Arc;

use contrejour_gpu::{CasterInput, MeshHandle, Positions, RemoveMeshError};
use contrejour_layout::{BLOCK_SIZE, BundleShape, Caster, CasterPlace, LightView, NO_CASTER, WorkItem};
use contrejour_mesh::{AlphaMask, BuildOptions, MaskImage, MaskedMesh, Motion, TextureFilter, TopologyAwareMesh};
use contrejour_plan::{BufferKind, Light};
use contrejour_scene::shapes::Shape;
use contrejour_tests::changing_scene::{ChangingScene, Left, block_bytes, compare_left, mask_bytes, mesh_bytes};
use contrejour_tests::gpu::{Gpu, gpu_with_small_buffers};
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::lights::point;
use contrejour_tests::meshes::{TestMesh, shapes, tiny};
use contrejour_tests::random::Random;
use glam::{DMat4, DVec3};
use libtest_mimic::Trial;

use crate::many_lights::{lamp, place, sun, text};

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("come_and_go::thousands_leave_what_a_fresh_scene_leaves", thousands_leave_what_a_fresh_scene_leaves),
        gpu_trial("come_and_go::pages_leave_what_a_fresh_scene_leaves", pages_leave_what_a_fresh_scene_leaves),
        gpu_trial("come_and_go::what_is_wrong_in_a_pool_or_a_list_is_found", what_is_wrong_is_found),
        gpu_trial("come_and_go::what_stays_is_not_uploaded", what_stays_is_not_uploaded),
        gpu_trial("come_and_go::maps_stand_while_others_come_and_go", maps_stand_while_others_come_and_go),
        gpu_trial("come_and_go::a_mesh_with_casters_is_not_removed", a_mesh_with_casters_is_not_removed),
        gpu_trial("come_and_go::what_is_mostly_unused_is_given_back", what_is_mostly_unused_is_given_back),
    ]
}

/// Bytes of what a caster of a mesh brings.
fn caster_bytes(mesh: &TopologyAwareMesh) -> u64 {
    size_of::<Caster>() as u64 + block_bytes(mesh)
}

fn torus(segments: u32, sides: u32) -> Arc<TopologyAwareMesh> {
    let shape = Shape::Torus { radius: 0.8, tube_radius: 0.3, segments, sides };
    let torus = shape.generate().expect("the numbers are in range");
    Arc::clone(&TestMesh::generated("torus", &torus.positions, &torus.triangles).parts[0].topology)
}

/// Meshes of all kinds and sizes, and some that deform.
struct Stock {
    meshes: Vec<Arc<TopologyAwareMesh>>,
    /// Each with positions of a caller's.
    deforming: Vec<(Arc<TopologyAwareMesh>, Positions)>,
    /// Some with the same picture.
    masked: Vec<Arc<MaskedMesh>>,
}

impl Stock {
    fn new(gpu: &Gpu) -> Result<Self, String> {
        let mut made = tiny();
        made.extend(shapes());
        let mut meshes: Vec<_> = made.iter().map(|mesh| Arc::clone(&mesh.parts[0].topology)).collect();
        meshes.extend([(3, 3), (5, 8), (9, 7), (13, 11), (17, 6), (30, 20), (40, 9)].map(|(a, b)| torus(a, b)));
        let of_part = |mesh: &TestMesh| {
            let part = &mesh.parts[0];
            let options = BuildOptions { motion: Motion::Deforming, ..Default::default() };
            let built = TopologyAwareMesh::build(&part.topology.positions, &part.triangles, &options).map_err(text)?;
            let words = built.positions.iter().flat_map(|&[x, y, z]| [1.2 * x, y, 0.9 * z, 0.0]).collect::<Vec<f32>>();
            let buffer = gpu.upload("own positions", bytemuck::cast_slice(&words), wgpu::BufferUsages::STORAGE);
            Ok((Arc::new(built), Positions::InBuffer { buffer, offset: 0, stride: 16, known: None }))
        };
        let deforming = made.iter().rev().skip(3).take(3).map(of_part).collect::<Result<_, String>>()?;
        let mut random = Random::new(1);
        let images = [[16, 9], [7, 20]].map(|size: [u32; 2]| {
            let alphas = (0..size[0] * size[1]).map(|_| random.below(256) as u8).collect();
            MaskImage::new(size, alphas, Default::default(), TextureFilter::Linear).map(Arc::new)
        });
        let [first, second] = images;
        let (first, second) = (first.map_err(text)?, second.map_err(text)?);
        let of_part = |(mesh, image): (&TestMesh, &Arc<MaskImage>)| {
            let part = &mesh.parts[0];
            let positions = &part.topology.positions;
            let mask = AlphaMask {
                coordinates: positions.iter().map(|&[x, y, z]| [x + 0.3 * y, z - 0.2 * y]).collect(),
                alphas: vec![1.0; positions.len()],
                image: Arc::clone(image),
                cutoff: 0.5,
            };
            MaskedMesh::new(positions, &part.triangles, mask).map(Arc::new).map_err(text)
        };
        let cut = made.iter().rev().skip(2).zip([&first, &first, &second, &second, &first]);
        let masked = cut.map(of_part).collect::<Result<_, String>>()?;
        Ok(Self { meshes, deforming, masked })
    }
}

/// What may be uploaded for what came and went, and how much there is and was at most.
#[derive(Debug, Default)]
struct Tally {
    bytes: u64,
    now: [u64; 4],
    most: [u64; 4],
}

/// Buffers whose room is held against what was in them.
const HELD: [BufferKind; 4] = [BufferKind::Faces, BufferKind::Edges, BufferKind::FaceBlocks, BufferKind::Positions];

impl Tally {
    fn add(&mut self, what: [u64; 4]) {
        for ((now, most), more) in self.now.iter_mut().zip(&mut self.most).zip(what) {
            *now += more;
            *most = (*now).max(*most);
        }
    }

    fn subtract(&mut self, what: [u64; 4]) {
        self.now.iter_mut().zip(what).for_each(|(now, less)| *now -= less);
    }
}

fn room_of_mesh(mesh: &TopologyAwareMesh) -> [u64; 4] {
    [mesh.faces.len() as u64, mesh.candidate_edge_count.into(), 0, 3 * mesh.positions.len() as u64]
}

fn room_of_caster(mesh: &TopologyAwareMesh, input: &CasterInput) -> [u64; 4] {
    let words = match input.positions {
        Positions::OfMesh => 0,
        Positions::InBuffer { stride, .. } => (mesh.positions.len() as u64 - 1) * stride / 4 + 3,
    };
    [0, 0, (mesh.faces.len() as u64).div_ceil(BLOCK_SIZE.into()), words]
}

/// A scene in which anything may happen, of so many things at most.
struct Bustle<'a> {
    scene: ChangingScene<'a>,
    stock: Stock,
    random: Random,
    tally: Tally,
    most: [usize; 3],
}

impl<'a> Bustle<'a> {
    /// With a light, two meshes and two casters that stay: one is cut by a mask.
    fn new(gpu: &'a Gpu, seed: u64, most: [usize; 3]) -> Result<Self, String> {
        let (stock, random) = (Stock::new(gpu)?, Random::new(seed));
        let mut bustle = Self { scene: ChangingScene::new(gpu)?, stock, random, tally: Tally::default(), most };
        bustle.scene.add_light(&point(DVec3::new(5.0, 6.0, 1.0), DVec3::ZERO, 4.0), "smoothies")?;
        let mesh = bustle.stock.meshes.last().cloned().ok_or("there are meshes")?;
        let masked = Arc::clone(&bustle.stock.masked[0]);
        for mesh in [bustle.add_mesh(&mesh)?, bustle.add_masked_mesh(&masked)?] {
            let (world_from_object, positions) = (DMat4::IDENTITY, Positions::OfMesh);
            bustle.add_caster(CasterInput { mesh, world_from_object, positions })?;
        }
        Ok(bustle)
    }

    fn add_mesh(&mut self, mesh: &Arc<TopologyAwareMesh>) -> Result<MeshHandle, String> {
        self.tally.bytes += mesh_bytes(mesh);
        self.tally.add(room_of_mesh(mesh));
        self.scene.add_mesh(mesh)
    }

    fn add_masked_mesh(&mut self, mesh: &Arc<MaskedMesh>) -> Result<MeshHandle, String> {
        self.tally.bytes += mesh_bytes(mesh.mesh()) + mask_bytes(mesh);
        self.tally.add(room_of_mesh(mesh.mesh()));
        self.scene.add_masked_mesh(mesh)
    }

    fn add_caster(&mut self, input: CasterInput) -> Outcome {
        self.scene.add_caster(input)?;
        let caster = &self.scene.casters[self.scene.casters.len() - 1];
        let mesh = self.scene.mesh_of(caster);
        self.tally.bytes += caster_bytes(mesh);
        self.tally.add(room_of_caster(mesh, &caster.input));
        Ok(())
    }

    fn remove_caster(&mut self, index: usize) -> Outcome {
        let caster = self.scene.remove_caster(index)?;
        let mesh = self.scene.mesh_of(&caster);
        self.tally.bytes += block_bytes(mesh);
        self.tally.subtract(room_of_caster(mesh, &caster.input));
        Ok(())
    }

    fn remove_mesh(&mut self, index: usize) -> Outcome {
        let (handle, mesh) = self.scene.meshes[index].clone();
        while let Some(caster) = self.scene.casters.iter().position(|caster| caster.input.mesh == handle) {
            self.remove_caster(caster)?;
        }
        self.tally.subtract(room_of_mesh(&mesh));
        self.scene.remove_mesh(index)
    }

    /// One of those that may leave: the first ones stay.
    fn guest(&mut self, count: usize, staying: usize) -> Option<usize> {
        (count > staying).then(|| staying + self.random.below(count - staying))
    }

    fn light(&mut self) -> Light {
        let [x, y, z] = [(); 3].map(|()| 4.0 * self.random.signed());
        match self.random.below(3) {
            0 => sun(DVec3::new(x, 5.0 + y, z)),
            1 => lamp(DVec3::new(x, y, z)),
            _ => point(DVec3::new(x, 6.0, z), DVec3::ZERO, 4.0),
        }
    }

    /// Lets something come, go or move.
    fn step(&mut self) -> Outcome {
        let [most_meshes, most_casters, most_lights] = self.most;
        match self.random.below(16) {
            0 if self.scene.meshes.len() < most_meshes => {
                let masked = Arc::clone(&self.stock.masked[self.random.below(self.stock.masked.len())]);
                self.add_masked_mesh(&masked).map(drop)
            }
            1 if self.scene.meshes.len() < most_meshes => {
                let mesh = self.random.below(self.stock.meshes.len());
                let mesh = Arc::clone(&self.stock.meshes[mesh]);
                self.add_mesh(&mesh).map(drop)
            }
            0..=2 => self.guest(self.scene.meshes.len(), 2).map_or(Ok(()), |index| self.remove_mesh(index)),
            // A deforming mesh comes with a caster, and mostly goes with another one.
            3 if self.scene.meshes.len() < most_meshes => {
                let mesh = self.random.below(self.stock.deforming.len());
                let (mesh, positions) = self.stock.deforming[mesh].clone();
                let (mesh, world_from_object) = (self.add_mesh(&mesh)?, place(&mut self.random));
                self.add_caster(CasterInput { mesh, world_from_object, positions })
            }
            3..=7 if self.scene.casters.len() < most_casters => {
                let mesh = self.scene.meshes[self.random.below(self.scene.meshes.len())].0;
                let world_from_object = place(&mut self.random);
                self.add_caster(CasterInput { mesh, world_from_object, positions: Positions::OfMesh })
            }
            3..=9 => self.guest(self.scene.casters.len(), 2).map_or(Ok(()), |index| self.remove_caster(index)),
            10..=13 => {
                let (index, place) = (self.random.below(self.scene.casters.len()), place(&mut self.random));
                self.scene.move_caster(index, place)
            }
            14 if self.scene.lights.len() < most_lights => {
                let technique = ["smoothies", "pcf", "evsm", "shadow-map"][self.random.below(4)];
                let light = self.light();
                self.scene.add_light(&light, technique).map(drop)
            }
            _ => self.guest(self.scene.lights.len(), 1).map_or(Ok(()), |index| self.scene.remove_light(index)),
        }
    }

    /// Compares with the same content in a fresh object.
    fn check(&mut self) -> Result<Left, String> {
        let expected = self.scene.anew()?.left()?;
        let found = self.scene.left()?;
        compare_left(&expected, &found)?;
        Ok(found)
    }
}

fn thousands_leave_what_a_fresh_scene_leaves(gpu: &Gpu) -> Outcome {
    const STEPS: usize = 4000;
    let mut bustle = Bustle::new(gpu, 5, [16, 24, 4])?;
    let (mut edges, mut replaced, mut frames, mut most_slots) = (0, 0, 0, 0);
    let mut faces: Option<wgpu::Buffer> = None;
    for step in 0..STEPS {
        let at = |error: String| format!("step {step}: {error}");
        bustle.step().map_err(at)?;
        most_slots = most_slots.max(bustle.scene.casters.iter().map(|caster| caster.handle.index()).max().unwrap_or(0));
        if step % 10 == 9 {
            bustle.scene.frame().map_err(at)?;
            frames += 1;
            let (uploaded, came) = (bustle.scene.shadows.stats().set_up_bytes, std::mem::take(&mut bustle.tally.bytes));
            if uploaded > came + GROWN_BYTES {
                return Err(format!("step {step}: {uploaded} bytes are uploaded for {came} that came"));
            }
            let buffer = bustle.scene.buffer(BufferKind::Faces);
            replaced += usize::from(faces.as_ref() != Some(buffer));
            faces = Some(buffer.clone());
        }
        if step % 400 == 399 {
            edges += bustle.check().map_err(at)?.edge_count();
        }
    }
    for (kind, most) in HELD.into_iter().zip(bustle.tally.most) {
        let room = bustle.scene.buffer(kind).size() / kind.item_bytes();
        eprintln!("{}: room for {room}, {most} were there at most", kind.name());
        if room > 2 * most {
            return Err(format!("{} has room for {room}, and there were at most {most}", kind.name()));
        }
    }
    eprintln!("{edges} silhouette edges compared; {frames} frames, {replaced} of them with new pools");
    if edges < 10_000 || replaced > frames / 20 || most_slots > 30 {
        return Err(format!("{edges} edges, {replaced} pools in {frames} frames, casters up to {most_slots}"));
    }
    Ok(())
}

/// Where a scene fills now one page, now several.
fn pages_leave_what_a_fresh_scene_leaves(_: &Gpu) -> Outcome {
    let small = gpu_with_small_buffers(180 << 10)?;
    let mut bustle = Bustle::new(&small, 6, [6, 6, 2])?;
    bustle.stock.meshes.retain(|mesh| mesh.faces.len() < 1300);
    let mut page_counts = Vec::new();
    for step in 0..400 {
        let at = |error: String| format!("step {step}: {error}");
        bustle.step().map_err(at)?;
        if step % 4 == 3 {
            bustle.scene.frame().map_err(at)?;
        }
        if step % 20 == 19 {
            bustle.check().map_err(at)?;
            let plan = bustle.scene.shadows.plan(bustle.scene.lights[0].0).ok_or("a frame was prepared")?;
            page_counts.push(plan.pages.len());
        }
    }
    eprintln!("pages: {page_counts:?}");
    let with_one = page_counts.iter().filter(|count| **count == 1).count();
    if (3..page_counts.len() - 2).contains(&with_one) { Ok(()) } else { Err("pages never change".into()) }
}

/// A block that a caster left behind, and a place that two meshes have, are what a mistake in the pools would leave.
fn what_is_wrong_is_found(gpu: &Gpu) -> Outcome {
    let mut scene = ChangingScene::new(gpu)?;
    scene.add_light(&point(DVec3::new(5.0, 6.0, 1.0), DVec3::ZERO, 4.0), "smoothies")?;
    for (index, mesh) in [torus(9, 7), torus(30, 20), torus(13, 11)].iter().enumerate() {
        let mesh = scene.add_mesh(mesh)?;
        scene.place(mesh, DMat4::from_translation(DVec3::X * (index as f64 - 1.0)))?;
    }
    scene.frame()?;
    scene.remove_caster(1)?;
    scene.remove_mesh(1)?;
    // In the place of the larger one.
    let guest = scene.add_mesh(&torus(17, 6))?;
    let guest = scene.place(guest, DMat4::from_translation(DVec3::Z))?;
    let mut anew = scene.anew()?;
    let expected = anew.left()?;
    compare_left(&expected, &scene.left()?)?;
    if guest.index() != 1 {
        return Err(format!("the guest has slot {}", guest.index()));
    }

    let blocks = scene.blocks(BufferKind::EdgeBlocks);
    let hole = blocks.iter().position(|block| block.caster == NO_CASTER).ok_or("the larger one left blocks")?;
    let stale = WorkItem { caster: guest.index() as u32, ..WorkItem::default() };
    let bytes = (hole * size_of::<WorkItem>()) as u64;
    gpu.queue.write_buffer(scene.buffer(BufferKind::EdgeBlocks), bytes, bytemuck::bytes_of(&stale));
    found("a stale block", "silhouette edge", &expected, &scene.left()?)?;
    gpu.queue.write_buffer(scene.buffer(BufferKind::EdgeBlocks), bytes, bytemuck::bytes_of(&blocks[hole]));
    compare_left(&expected, &scene.left()?)?;

    for (kind, first) in [
        (BufferKind::Faces, scene.record(guest).first_face),
        (BufferKind::Planes, scene.record(guest).first_face),
        (BufferKind::Edges, scene.record(guest).first_edge),
        (BufferKind::Positions, scene.record(guest).first_position_word),
    ] {
        let (buffer, offset) = (scene.buffer(kind), u64::from(first) * kind.item_bytes());
        let before: Vec<u32> = gpu.read_back(buffer, (buffer.size() / 4) as usize);
        // Those of the first mesh, which begins the pool.
        let length = 100 * kind.item_bytes() as usize / 4;
        gpu.queue.write_buffer(buffer, offset, bytemuck::cast_slice(&before[..length]));
        found(&format!("{} of another mesh", kind.name()), "", &expected, &scene.left()?)?;
        gpu.queue.write_buffer(scene.buffer(kind), 0, bytemuck::cast_slice(&before));
        compare_left(&expected, &scene.left()?)?;
    }
    Ok(())
}

fn found(what: &str, difference: &str, expected: &Left, left: &Left) -> Outcome {
    match compare_left(expected, left) {
        Err(found) if found.contains(difference) => Ok(()),
        other => Err(format!("{what} is not found: {other:?}")),
    }
}

/// What is uploaded where lists grow: how 1, 2, 4 and 8 views share them.
const GROWN_BYTES: u64 = 4 * size_of::<BundleShape>() as u64;

/// A caster comes with its mesh, another one without, one leaves, and one comes to its place: each uploads the same
/// whether 10 others stay or 1000, and a light far away keeps its maps.
fn what_stays_is_not_uploaded(gpu: &Gpu) -> Outcome {
    let few = bytes_beside(gpu, 10)?;
    let many = bytes_beside(gpu, 1000)?;
    let mesh = torus(13, 11);
    let (of_mesh, of_caster, left) = (mesh_bytes(&mesh), caster_bytes(&mesh), block_bytes(&mesh));
    // The lists of a first caster more have to grow.
    let expected = [of_mesh + of_caster + GROWN_BYTES, of_caster, left, of_caster, 0, of_mesh, 0];
    if few != many || few.map(|[set_up, _]| set_up) != expected {
        return Err(format!("beside 10 {few:?}, beside 1000 {many:?} bytes; {expected:?} are set up for what came"));
    }
    // Two casters leave at once, and the records of all seven views say how many blocks there are.
    let most = 2 * size_of::<CasterPlace>() + 7 * size_of::<LightView>();
    let is_much = |[_, each_frame]: &[u64; 2]| *each_frame > most as u64;
    if few.iter().any(is_much) { Err(format!("{few:?}")) } else { Ok(()) }
}

/// For each change the bytes that are set up, and those of a frame in which things move.
fn bytes_beside(gpu: &Gpu, others: usize) -> Result<[[u64; 2]; 7], String> {
    let mut scene = ChangingScene::new(gpu)?;
    let mut random = Random::new(7);
    let shapes = [torus(3, 3), torus(5, 4), torus(4, 7)];
    for index in 0..others {
        let mesh = scene.add_mesh(&shapes[index % 3])?;
        scene.place(mesh, place(&mut random))?;
    }
    scene.add_light(&point(DVec3::new(5.0, 6.0, 1.0), DVec3::ZERO, 4.0), "smoothies")?;
    scene.add_light(&lamp(DVec3::X * 100.0), "smoothies")?;
    scene.left()?;
    scene.frame()?;

    let mesh = torus(13, 11);
    let mut guest = None;
    let mut bytes = [[0; 2]; 7];
    for (step, bytes) in bytes.iter_mut().enumerate() {
        match step {
            0 => {
                let handle = scene.add_mesh(&mesh)?;
                guest = Some(handle);
                scene.place(handle, DMat4::IDENTITY)?;
            }
            1 | 3 => drop(scene.place(guest.ok_or("the mesh came")?, DMat4::from_translation(DVec3::Y))?),
            2 => drop(scene.remove_caster(others)?),
            4 => {
                scene.remove_caster(others)?;
                scene.remove_caster(others)?;
                scene.remove_mesh(others)?;
            }
            5 => drop(scene.add_mesh(&mesh)?),
            _ => scene.remove_mesh(others)?,
        }
        scene.frame()?;
        let stats = scene.shadows.stats();
        *bytes = [stats.set_up_bytes, stats.upload_bytes];
        let redone = u32::from(step < 5);
        if (stats.lights_redone, stats.lights_kept, stats.readback_waits) != (redone, 2 - redone, stats.readback_waits)
        {
            return Err(format!("change {step} beside {others}: {stats:?}"));
        }
    }
    compare_left(&scene.anew()?.left()?, &scene.left()?)?;
    Ok(bytes)
}

/// The lists grow and are other buffers, and a light far away keeps its maps; drawn anew they are the same.
fn maps_stand_while_others_come_and_go(gpu: &Gpu) -> Outcome {
    let mut scene = ChangingScene::new(gpu)?;
    let beside = DVec3::new(100.0, 0.0, 0.0);
    let mesh = scene.add_mesh(&torus(9, 7))?;
    scene.add_light(&lamp(beside), "smoothies")?;
    scene.add_light(&point(DVec3::new(5.0, 6.0, 1.0), DVec3::ZERO, 4.0), "smoothies")?;
    scene.place(mesh, DMat4::from_translation(beside + DVec3::X))?;
    scene.place(mesh, DMat4::IDENTITY)?;
    let before = scene.left()?;
    let first: Vec<_> = HELD.map(|kind| scene.buffer(kind).clone()).into();
    let mut random = Random::new(8);
    for step in 0..40 {
        let mesh = scene.add_mesh(&torus(3 + step % 5, 4))?;
        scene.place(mesh, place(&mut random))?;
        if step % 3 == 2 {
            scene.remove_caster(2)?;
        }
        scene.frame()?;
        let stats = scene.shadows.stats();
        if (stats.lights_redone, stats.lights_kept) != (1, 1) {
            return Err(format!("step {step}: {stats:?}"));
        }
    }
    if HELD.iter().zip(&first).any(|(kind, first)| scene.buffer(*kind) == first) {
        return Err("some pools never grew".into());
    }
    let after = scene.left()?;
    if !before.has_the_same_maps(&after, 0) || before.has_the_same_maps(&after, 1) {
        return Err("the light far away has other maps, or the near one has the same".into());
    }
    compare_left(&scene.anew()?.left()?, &after)
}

fn a_mesh_with_casters_is_not_removed(gpu: &Gpu) -> Outcome {
    let mut scene = ChangingScene::new(gpu)?;
    let mesh = scene.add_mesh(&torus(3, 3))?;
    scene.place(mesh, DMat4::IDENTITY)?;
    scene.place(mesh, DMat4::IDENTITY)?;
    let refused = scene.shadows.remove_mesh(mesh);
    let told = |error: &RemoveMeshError| error.to_string().contains("2 of them: remove them with `remove_caster`");
    if refused.as_ref().err() != Some(&RemoveMeshError::StillCasts { mesh, casters: 2 })
        || !refused.is_err_and(|error| told(&error))
    {
        return Err("a mesh with two casters is removed".into());
    }
    scene.remove_caster(1)?;
    scene.remove_caster(0)?;
    scene.remove_mesh(0)?;
    if scene.shadows.remove_mesh(mesh) != Err(RemoveMeshError::UnknownMesh { mesh }) {
        return Err("a mesh is removed twice".into());
    }
    let next = scene.add_mesh(&torus(3, 3))?;
    if next == mesh || scene.place(mesh, DMat4::IDENTITY).is_ok() || scene.shadows.remove_mesh(mesh).is_ok() {
        return Err("the handle of a mesh that is gone names another".into());
    }
    scene.place(next, DMat4::IDENTITY).map(drop)
}

/// A large mesh goes and a small one stays: the pools are as large as what is left, and so are lists when casters go.
fn what_is_mostly_unused_is_given_back(gpu: &Gpu) -> Outcome {
    let mut scene = ChangingScene::new(gpu)?;
    scene.add_light(&point(DVec3::new(5.0, 6.0, 1.0), DVec3::ZERO, 4.0), "smoothies")?;
    let large = scene.add_mesh(&torus(420, 210))?;
    let small = scene.add_mesh(&torus(30, 20))?;
    scene.place(large, DMat4::IDENTITY)?;
    scene.place(small, DMat4::from_translation(DVec3::Y))?;
    scene.frame()?;
    scene.remove_caster(0)?;
    scene.remove_mesh(0)?;
    compare_left(&scene.anew()?.left()?, &scene.left()?)?;
    let faces = scene.buffer(BufferKind::Faces).size() / BufferKind::Faces.item_bytes();
    let set_up = scene.shadows.stats().set_up_bytes;
    scene.frame()?;
    if faces != 1200 || scene.shadows.stats().set_up_bytes != 0 {
        return Err(format!("{set_up} bytes are set up, and there is room for {faces} faces"));
    }
    Ok(())
}
