//! Skins and morph targets: the device puts vertices where the CPU does, and silhouettes of what it leaves are exact.

use std::sync::Arc;

use contrejour_gpu::{DeformError, DeformHandle, DeformInput, Deformer, Positions, Untimed};
use contrejour_mesh::{DeformingMesh, PartPose};
use contrejour_oracle::OracleTopology;
use contrejour_tests::deforming::{PosedMesh, check_alike, compare_positions, of_file, tube};
use contrejour_tests::exhaust::{Exhaust, OwnPositions};
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial, mesh_trial};
use contrejour_tests::many_lights::{adversarial_lights, random_lights};
use contrejour_tests::random::Random;
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
        let mut inputs = vec![input(self.other.0, &self.other.1.poses[2])];
        inputs.extend(self.handles.iter().zip(meshes).map(|(&caster, mesh)| input(caster, &mesh.poses[pose])));
        self.deformer.prepare(device, queue, &inputs).map_err(|error| error.to_string())?;
        let mut encoder = device.create_command_encoder(&Default::default());
        self.deformer.encode(&mut encoder, &mut Untimed);
        queue.submit([encoder.finish()]);
        self.handles.iter().zip(meshes).map(|(&caster, mesh)| self.positions(caster, &mesh.deforming)).collect()
    }

    fn positions(&self, caster: DeformHandle, mesh: &DeformingMesh) -> Result<OwnPositions, String> {
        let Some(Positions::InBuffer { buffer, offset, stride }) = self.deformer.positions(caster) else {
            return Err("a prepared mesh has no positions".into());
        };
        let first = offset as usize / 12;
        let mut positions: Vec<[f32; 3]> = self.gpu.read_back(&buffer, first + mesh.vertices().len());
        positions.drain(..first);
        Ok(OwnPositions { buffer: buffer.clone(), offset, stride, positions })
    }
}

fn input(caster: DeformHandle, pose: &PartPose) -> DeformInput<'_> {
    DeformInput { caster, joint_matrices: &pose.joint_matrices, morph_weights: &pose.morph_weights }
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
    // What is left moves into the place of what has gone.
    if !deformed.deformer.remove(deformed.handles[0]) || deformed.deformer.remove(deformed.handles[0]) {
        return Err("a mesh can be removed once".into());
    }
    if deformed.deformer.positions(deformed.handles[1]).is_some() {
        return Err("there are positions of a frame that was not prepared".into());
    }
    deformed.handles.remove(0);
    let second = deformed.frame(&meshes[1..], 1)?;
    if (second[0].offset, &second[0].positions) == (first[0].offset, &first[1].positions) {
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
    let mut refused = |inputs: &[DeformInput]| deformed.deformer.prepare(device, queue, inputs).err();
    let found = [
        matches!(refused(&sound[..1]), Some(DeformError::MissingPose { caster }) if caster == sound[1].caster),
        matches!(refused(&[sound[0], short]), Some(DeformError::Count { given: 2, needed: 3, .. })),
        matches!(refused(&[sound[0], weightless]), Some(DeformError::Count { given: 1, needed: 2, .. })),
        matches!(refused(&[sound[0], not_finite]), Some(DeformError::NotFinite { .. })),
        refused(&sound).is_none(),
    ];
    deformed.deformer.remove(sound[0].caster);
    let gone = deformed.deformer.prepare(device, queue, &sound);
    match gone {
        Err(DeformError::UnknownCaster { caster }) if caster == sound[0].caster && found == [true; 5] => Ok(()),
        _ => Err(format!("refused as expected: {found:?}, and then {gone:?}")),
    }
}
