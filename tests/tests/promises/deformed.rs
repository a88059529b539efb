//! Skins and morph targets: the device puts vertices where the CPU does, and silhouettes of what it leaves are exact.

use std::sync::Arc;

use contrejour_gpu::{
    DeformError, DeformHandle, DeformInput, Deformer, KnownPositions, Positions, SetPoseError, Untimed,
};
use contrejour_layout::{BLOCK_SIZE, DeformBlock};
use contrejour_mesh::{DeformingMesh, PartPose};
use contrejour_oracle::OracleTopology;
use contrejour_tests::deforming::{PosedMesh, check_alike, compare_positions, of_file, tube};
use contrejour_tests::exhaust::{Exhaust, OwnPositions};
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial, mesh_trial};
use contrejour_tests::many_lights::{adversarial_lights, random_lights};
use contrejour_tests::random::Random;
use glam::{DMat4, DVec3};
use libtest_mimic::Trial;

const FILES: [&str; 5] = [
    "animated/CesiumMan.glb",
    "animated/Fox.glb",
    "animated/RiggedSimple.glb",
    "animated/AnimatedMorphSphere.glb",
    "animated/MorphStressTest/MorphStressTest.gltf",
];

/// Times of each file's animation.
const POSES: u32 = 4;

pub fn trials() -> Vec<Trial> {
    let file = |name: &'static str| {
        mesh_trial(format!("deformed::silhouettes_are_exact::{name}"), move |gpu, folder| {
            are_exact(gpu, &of_file(&folder.join(name), POSES)?)
        })
    };
    let own = [
        gpu_trial("deformed::silhouettes_are_exact::tube", |gpu| are_exact(gpu, &[tube()])),
        gpu_trial("deformed::a_frame_uploads_poses_alone", uploads_poses_alone),
        gpu_trial("deformed::poses_that_do_not_fit_are_refused", misfits_are_refused),
        gpu_trial("deformed::thousands_come_and_go", thousands_come_and_go),
        gpu_trial("deformed::what_stays_is_not_uploaded", what_stays_is_not_uploaded),
    ];
    own.into_iter().chain(FILES.map(file)).collect()
}

/// Some meshes on the device, behind one that moves otherwise.
struct Deformed<'a> {
    gpu: &'a Gpu,
    deformer: Deformer,
    handles: Vec<DeformHandle>,
    other: (DeformHandle, PosedMesh),
}

impl<'a> Deformed<'a> {
    fn new(gpu: &'a Gpu, meshes: &[PosedMesh]) -> Result<Self, String> {
        let mut deformer = Deformer::new(&gpu.device).map_err(|error| error.to_string())?;
        let mut add = |mesh: &PosedMesh| deformer.add(Arc::clone(&mesh.deforming)).map_err(|error| error.to_string());
        let other = tube();
        let other = (add(&other)?, other);
        let handles = meshes.iter().map(add).collect::<Result<_, _>>()?;
        Ok(Self { gpu, deformer, handles, other })
    }

    /// Poses all meshes and returns where the device leaves them.
    fn frame(&mut self, meshes: &[PosedMesh], pose: usize) -> Result<Vec<OwnPositions>, String> {
        let Gpu { device, queue, .. } = self.gpu;
        set_pose(&mut self.deformer, self.other.0, &self.other.1.poses[2])?;
        for (caster, mesh) in self.handles.iter().zip(meshes) {
            set_pose(&mut self.deformer, *caster, &mesh.poses[pose])?;
        }
        self.deformer.prepare(device, queue).map_err(|error| error.to_string())?;
        let mut encoder = device.create_command_encoder(&Default::default());
        self.deformer.encode(&mut encoder, &mut Untimed);
        queue.submit([encoder.finish()]);
        self.handles.iter().zip(meshes).map(|(&caster, mesh)| self.positions(caster, &mesh.deforming)).collect()
    }

    fn positions(&self, caster: DeformHandle, mesh: &DeformingMesh) -> Result<OwnPositions, String> {
        let Some(Positions::InBuffer { buffer, offset, stride, known }) = self.deformer.positions(caster) else {
            return Err("a prepared mesh has no positions".into());
        };
        let first = offset as usize / 12;
        let mut positions: Vec<[f32; 3]> = self.gpu.read_back(&buffer, first + mesh.vertices().len());
        positions.drain(..first);
        check_box(&known.ok_or("a posed mesh has a box")?, &positions)?;
        Ok(OwnPositions { buffer: buffer.clone(), offset, stride, positions })
    }
}

fn input(caster: DeformHandle, pose: &PartPose) -> DeformInput<'_> {
    DeformInput { caster, joint_matrices: &pose.joint_matrices, morph_weights: &pose.morph_weights }
}

fn set_pose(deformer: &mut Deformer, caster: DeformHandle, pose: &PartPose) -> Outcome {
    deformer.set_pose(&input(caster, pose)).map_err(|error| error.to_string())
}

/// All positions are in the box that is known of them.
fn check_box(known: &KnownPositions, positions: &[[f32; 3]]) -> Outcome {
    let [min, max] = known.bounds;
    let is_out = |position: &&[f32; 3]| (0..3).any(|axis| !(min[axis]..=max[axis]).contains(&position[axis]));
    match positions.iter().find(is_out) {
        Some(position) => Err(format!("{position:?} is not in the box {min:?} {max:?}")),
        None => Ok(()),
    }
}

fn are_exact(gpu: &Gpu, meshes: &[PosedMesh]) -> Outcome {
    let mut deformed = Deformed::new(gpu, meshes)?;
    let mut random = Random::new(4);
    for pose in 0..meshes.first().ok_or("no mesh deforms")?.poses.len() {
        let moved = deformed.frame(meshes, pose)?;
        for (mesh, moved) in meshes.iter().zip(moved) {
            let PosedMesh { name, mesh, deforming, poses } = mesh;
            let at = |difference: String| format!("{name}, pose {pose}: {difference}");
            // The CPU's way shares nothing with the device's but the mesh.
            compare_positions(deforming, &poses[pose], &deforming.posed(&poses[pose]), &moved.positions).map_err(at)?;
            check_alike(deforming, &moved.positions).map_err(at)?;

            let topology = deforming.topology(&mesh.positions, &mesh.triangles).map_err(|error| error.to_string())?;
            let classes: Vec<u32> = bytemuck::pod_collect_to_vec(&deforming.weld_data());
            let oracle = OracleTopology::of_deforming(&mesh.positions, &classes, &mesh.triangles);
            let oracle = oracle.moved(&moved.positions);
            let mut exhaust = Exhaust::of_deforming(gpu, &Arc::new(topology), &oracle, moved)?;
            let faces = exhaust.faces();
            let mut lights = random_lights(&faces, 8, &mut random);
            lights.extend(adversarial_lights(&faces, 16, &mut random));
            if let Some(difference) = exhaust.run(&lights)?.first_difference {
                return Err(at(difference));
            }
        }
    }
    Ok(())
}

fn uploads_poses_alone(gpu: &Gpu) -> Outcome {
    // The same mesh in two poses.
    let mut meshes = [tube(), tube()];
    meshes[1].deforming = Arc::clone(&meshes[0].deforming);
    meshes[1].poses.rotate_left(1);
    let mut deformed = Deformed::new(gpu, &meshes)?;
    // Three tubes of three joints, 48 bytes each, and two weights.
    let expected = 3 * (3 * 48 + 2 * 4);
    let first = deformed.frame(&meshes, 1)?;
    for (PosedMesh { deforming, poses, .. }, moved) in meshes.iter().zip(&first) {
        compare_positions(deforming, &poses[1], &deforming.posed(&poses[1]), &moved.positions)?;
    }
    if deformed.deformer.upload_bytes() != expected {
        return Err(format!("{} bytes are uploaded, {expected} expected", deformed.deformer.upload_bytes()));
    }
    // What has the same pose is neither uploaded nor made again.
    let versions = |deformed: &Deformed| {
        deformed.handles.iter().map(|&handle| deformed.deformer.known(handle)).collect::<Vec<_>>()
    };
    let before = versions(&deformed);
    for (caster, mesh) in deformed.handles.iter().zip(&meshes) {
        let Some(Positions::InBuffer { buffer, offset, .. }) = deformed.deformer.positions(*caster) else {
            return Err("a prepared mesh has no positions".into());
        };
        gpu.queue.write_buffer(&buffer, offset, &vec![0; 12 * mesh.deforming.vertices().len()]);
    }
    let kept = deformed.frame(&meshes, 1)?;
    let is_made = kept.iter().any(|kept| kept.positions.as_flattened().iter().any(|&coordinate| coordinate != 0.0));
    if deformed.deformer.upload_bytes() != 0 || is_made || versions(&deformed) != before {
        return Err("a pose that a mesh has already is made again".into());
    }
    deformed.frame(&meshes, 2)?;
    let changed = deformed.deformer.upload_bytes();
    if changed != expected / 3 * 2 || versions(&deformed).iter().zip(&before).any(|(now, before)| now == before) {
        return Err(format!("{changed} bytes are uploaded for two other poses of three"));
    }
    deformed.frame(&meshes, 1)?;
    // What is left stays where it is.
    if !deformed.deformer.remove(deformed.handles[0]) || deformed.deformer.remove(deformed.handles[0]) {
        return Err("a mesh can be removed once".into());
    }
    deformed.handles.remove(0);
    let second = deformed.frame(&meshes[1..], 1)?;
    if (second[0].offset, &second[0].buffer, &second[0].positions)
        == (first[1].offset, &first[1].buffer, &first[1].positions)
    {
        return Ok(());
    }
    Err("the mesh that stays is elsewhere".into())
}

fn misfits_are_refused(gpu: &Gpu) -> Outcome {
    let meshes = [tube()];
    let mut deformed = Deformed::new(gpu, &meshes)?;
    let sound = [input(deformed.other.0, &meshes[0].poses[0]), input(deformed.handles[0], &meshes[0].poses[0])];
    let short = DeformInput { joint_matrices: &sound[1].joint_matrices[1..], ..sound[1] };
    let weightless = DeformInput { morph_weights: &[0.0], ..sound[1] };
    let not_finite = DeformInput { morph_weights: &[0.0, 1e39], ..sound[1] };
    let Gpu { device, queue, .. } = gpu;
    let deformer = &mut deformed.deformer;
    let missing = |deformer: &mut Deformer| match deformer.prepare(device, queue) {
        Err(DeformError::MissingPose { caster }) => Some(caster),
        _ => None,
    };
    let found = [
        deformer.set_pose(&sound[0]).is_ok() && missing(deformer) == Some(sound[1].caster),
        matches!(deformer.set_pose(&short), Err(SetPoseError::Count { given: 2, needed: 3, .. })),
        matches!(deformer.set_pose(&weightless), Err(SetPoseError::Count { given: 1, needed: 2, .. })),
        matches!(deformer.set_pose(&not_finite), Err(SetPoseError::NotFinite { .. })),
        missing(deformer) == Some(sound[1].caster),
        deformer.set_pose(&sound[1]).is_ok() && deformer.prepare(device, queue).is_ok(),
        deformer.remove(sound[0].caster),
        matches!(deformer.set_pose(&sound[0]), Err(SetPoseError::UnknownCaster { caster }) if caster == sound[0].caster),
    ];
    if found == [true; 8] { Ok(()) } else { Err(format!("refused as expected: {found:?}")) }
}

/// A mesh of so many vertices with some joints and morph targets, and a pose of it.
fn scattered(vertices: usize, random: &mut Random) -> Result<(Arc<DeformingMesh>, PartPose), String> {
    let [joints, morphs] = [1 + random.below(4) as u32, random.below(3) as u32];
    let mut mesh = DeformingMesh::new(joints, morphs);
    for _ in 0..vertices {
        let influences = [(); 2].map(|()| (random.below(joints as usize) as u32, 0.2 + random.signed().abs()));
        let mut vector = || [(); 3].map(|()| random.signed() as f32);
        let position = vector();
        let deltas: Vec<_> = (0..morphs).map(|morph| (morph, vector())).collect();
        mesh.push_vertex(position, &influences[..1], &deltas).map_err(|error| error.to_string())?;
    }
    let mut number = || random.signed();
    let matrix = |number: &mut dyn FnMut() -> f64| {
        let axis = DVec3::new(number(), number(), 2.0);
        DMat4::from_axis_angle(axis.normalize(), number()) * DMat4::from_translation(DVec3::splat(number()))
    };
    let joint_matrices = (0..joints).map(|_| matrix(&mut number)).collect();
    let morph_weights = (0..morphs).map(|_| number()).collect();
    Ok((Arc::new(mesh), PartPose { world_from_object: DMat4::IDENTITY, joint_matrices, morph_weights }))
}

/// Bytes of a mesh, and of the blocks of a caster of it.
fn bytes_of(mesh: &DeformingMesh) -> [u64; 2] {
    let lists = size_of_val(mesh.influences()) + size_of_val(mesh.morph_deltas());
    let blocks = mesh.vertices().len().div_ceil(BLOCK_SIZE as usize) * size_of::<DeformBlock>();
    [size_of_val(mesh.vertices()) + lists, blocks].map(|bytes| bytes as u64)
}

/// Meshes that move, each in a pose of its own.
struct Troupe<'a> {
    gpu: &'a Gpu,
    deformer: Deformer,
    /// With where its positions are, once they are known.
    members: Vec<Member>,
}

struct Member {
    handle: DeformHandle,
    mesh: Arc<DeformingMesh>,
    pose: PartPose,
    place: Option<(wgpu::Buffer, u64)>,
}

impl<'a> Troupe<'a> {
    fn new(gpu: &'a Gpu) -> Result<Self, String> {
        let deformer = Deformer::new(&gpu.device).map_err(|error| error.to_string())?;
        Ok(Self { gpu, deformer, members: Vec::new() })
    }

    fn add(&mut self, (mesh, pose): (Arc<DeformingMesh>, PartPose)) -> Outcome {
        let handle = self.deformer.add(Arc::clone(&mesh)).map_err(|error| error.to_string())?;
        self.members.push(Member { handle, mesh, pose, place: None });
        Ok(())
    }

    /// Draws a frame; each member's positions are where they were.
    fn frame(&mut self) -> Outcome {
        let Gpu { device, queue, .. } = self.gpu;
        for member in &self.members {
            set_pose(&mut self.deformer, member.handle, &member.pose)?;
        }
        self.deformer.prepare(device, queue).map_err(|error| error.to_string())?;
        let mut encoder = device.create_command_encoder(&Default::default());
        self.deformer.encode(&mut encoder, &mut Untimed);
        queue.submit([encoder.finish()]);
        for member in &mut self.members {
            let Some(Positions::InBuffer { buffer, offset, .. }) = self.deformer.positions(member.handle) else {
                return Err("a prepared mesh has no positions".into());
            };
            let place = (buffer, offset);
            if member.place.get_or_insert_with(|| place.clone()) != &place {
                return Err(format!("{:?} is elsewhere", member.handle));
            }
        }
        Ok(())
    }

    /// Those that hold positions.
    fn buffers(&self) -> Vec<&wgpu::Buffer> {
        let mut buffers: Vec<&wgpu::Buffer> = Vec::new();
        for (buffer, _) in self.members.iter().filter_map(|member| member.place.as_ref()) {
            if !buffers.contains(&buffer) {
                buffers.push(buffer);
            }
        }
        buffers
    }

    /// Compares all positions with the CPU's; returns how many there are.
    fn check(&self) -> Result<usize, String> {
        let mut count = 0;
        for Member { handle, mesh, pose, place } in &self.members {
            let (buffer, offset) = place.as_ref().ok_or("a frame was prepared")?;
            let first = *offset as usize / 4;
            let words: Vec<f32> = self.gpu.read_back(buffer, first + 3 * mesh.vertices().len());
            let found: Vec<[f32; 3]> = bytemuck::pod_collect_to_vec(&words[first..]);
            let at = |error: String| format!("{handle:?}: {error}");
            compare_positions(mesh, pose, &mesh.posed(pose), &found).map_err(at)?;
            check_box(&self.deformer.known(*handle).ok_or("a posed mesh has a box")?, &found).map_err(at)?;
            count += found.len();
        }
        Ok(count)
    }
}

fn thousands_come_and_go(gpu: &Gpu) -> Outcome {
    let mut random = Random::new(9);
    let mut troupe = Troupe::new(gpu)?;
    let (mut came, mut positions, mut most_live, mut most_bytes, mut most_buffers) = (0, 0, 0, 0, 0);
    for step in 0..4000 {
        let at = |error: String| format!("step {step}: {error}");
        let count = troupe.members.len();
        if count < 3 || count < 30 && random.below(2) == 0 {
            // Some are of a mesh that is there.
            let new = if count > 0 && random.below(4) == 0 {
                let Member { mesh, pose, .. } = &troupe.members[random.below(count)];
                (Arc::clone(mesh), pose.clone())
            } else {
                let most = if random.below(5) == 0 { 1500 } else { 100 };
                scattered(1 + random.below(most), &mut random)?
            };
            came += bytes_of(&new.0).iter().sum::<u64>();
            troupe.add(new).map_err(at)?;
        } else {
            let member = troupe.members.swap_remove(random.below(count));
            came += bytes_of(&member.mesh)[1];
            if !troupe.deformer.remove(member.handle) {
                return Err(at("a mesh can't be removed".into()));
            }
        }
        if step % 8 == 7 {
            troupe.frame().map_err(at)?;
            let set_up = troupe.deformer.set_up_bytes();
            if set_up > std::mem::take(&mut came) {
                return Err(at(format!("{set_up} bytes are uploaded for less that came")));
            }
            let live = troupe.members.iter().map(|member| 12 * member.mesh.vertices().len() as u64).sum::<u64>();
            let buffers = troupe.buffers();
            most_live = live.max(most_live);
            most_bytes = buffers.iter().map(|buffer| buffer.size()).sum::<u64>().max(most_bytes);
            most_buffers = buffers.len().max(most_buffers);
        }
        if step % 200 == 199 {
            positions += troupe.check().map_err(at)?;
        }
    }
    let found = format!("{positions} positions, {most_live} bytes at most, {most_bytes} in {most_buffers} buffers");
    eprintln!("{found}");
    if positions < 20_000 || most_bytes > 3 * most_live || most_buffers > 6 {
        return Err(found);
    }
    // A place that two meshes have.
    let (buffer, offset) = troupe.members[0].place.clone().ok_or("a frame was drawn")?;
    gpu.queue.write_buffer(&buffer, offset, bytemuck::cast_slice(&[3.0_f32; 3]));
    if troupe.check().is_ok() { Err("a position of another mesh is not found".into()) } else { Ok(()) }
}

fn what_stays_is_not_uploaded(gpu: &Gpu) -> Outcome {
    let bytes_beside = |others: usize| {
        let mut random = Random::new(10);
        let mut troupe = Troupe::new(gpu)?;
        let guest = scattered(700, &mut random)?;
        for _ in 0..others {
            troupe.add(scattered(1 + random.below(90), &mut random)?)?;
        }
        troupe.frame()?;
        let mut bytes = Vec::new();
        for step in 0..5 {
            if step % 2 == 0 {
                troupe.add(guest.clone())?;
            } else {
                let member = troupe.members.remove(others);
                troupe.deformer.remove(member.handle);
            }
            if step == 1 {
                // In the same frame it comes again.
                troupe.add(guest.clone())?;
            }
            troupe.frame()?;
            bytes.push(troupe.deformer.set_up_bytes());
        }
        troupe.check()?;
        Ok::<_, String>((bytes, bytes_of(&guest.0)))
    };
    let (few, [mesh, blocks]) = bytes_beside(10)?;
    let (many, _) = bytes_beside(1000)?;
    // The last of a buffer leaves nothing that would have to be written.
    let expected = [mesh + blocks, mesh + blocks, blocks, blocks, blocks];
    let is_as_expected = |bytes: &[u64]| {
        let mut steps = bytes.iter().zip(&expected).enumerate();
        bytes.len() == 5 && steps.all(|(step, (bytes, expected))| bytes == expected || (step, *bytes) == (3, 0))
    };
    let are_as_expected = is_as_expected(&few) && is_as_expected(&many);
    if are_as_expected { Ok(()) } else { Err(format!("{few:?}, {many:?}, {expected:?}")) }
}
