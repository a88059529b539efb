//! Rest vertices, joints and weights to positions.

use contrejour_mesh::PartPose;
use contrejour_tests::chain::{Fault, check_each_is_found};
use contrejour_tests::compare::check_finite;
use contrejour_tests::deform_frame::DeformFrame;
use contrejour_tests::deforming::{PosedMesh, check_alike, compare_positions, of_file, tube};
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, cpu_trial, gpu_trial};
use contrejour_tests::meshes::shared_folder;
use contrejour_tests::stage_run::StageRun;
use glam::{DMat4, DVec3};
use libtest_mimic::Trial;

use crate::parity::stage;

/// Files with skins, morph targets, and many meshes.
const FILES: [&str; 4] = [
    "animated/CesiumMan.glb",
    "animated/AnimatedMorphSphere.glb",
    "animated/MorphStressTest/MorphStressTest.gltf",
    "animated/robot.glb",
];

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("deform_positions::equals_its_twin", |gpu| compare_with_twin(gpu, &stage(gpu, "deform_positions"))),
        gpu_trial("deform_positions::a_fault_in_any_part_is_found", |gpu| {
            check_each_is_found(gpu, &FAULTS, compare_with_twin)
        }),
        cpu_trial("deform_positions::comparers_find_planted_faults", comparers_find_planted_faults),
    ]
}

const FAULTS: [Fault; 8] = [
    fault("skinned(block, vertex, morphed(block, vertex))", "skinned(block, vertex, vertex.position)"),
    fault("vec4f(position, 1.0)", "vec4f(position, 0.0)"),
    fault("i < vertex.influence_count", "i + 1u < vertex.influence_count"),
    fault("i < vertex.morph_delta_count", "i + 1u < vertex.morph_delta_count"),
    fault("block.first_joint + influence.joint", "influence.joint"),
    fault("block.first_morph_weight + morph.morph_id", "morph.morph_id"),
    fault("block.first_position_word + 3u * lane", "3u * (block.first_vertex + lane)"),
    fault("select((bits & 0x80000000u) | 0x7f7fffffu, bits, is_finite)", "bits"),
];

const fn fault(piece: &'static str, fault: &'static str) -> Fault {
    Fault::Replaced { stage: "deform_positions", piece, fault }
}

fn meshes() -> Result<Vec<PosedMesh>, String> {
    let mut meshes = vec![tube()];
    if let Some(folder) = shared_folder() {
        for file in FILES {
            meshes.extend(of_file(&folder.join(file), 3)?);
        }
    }
    Ok(meshes)
}

fn compare_with_twin(gpu: &Gpu, stage: &StageRun) -> Outcome {
    let meshes = meshes()?;
    // Near, far from the origin, tiny and huge.
    for (scale, offset) in [(1.0, 0.0), (1.0, 3000.0), (1e-39, 0.0), (1e30, 0.0)] {
        let place = DMat4::from_translation(DVec3::splat(offset)) * DMat4::from_scale(DVec3::splat(scale));
        let placed = |pose: &PartPose| PartPose {
            joint_matrices: pose.joint_matrices.iter().map(|matrix| place * matrix).collect(),
            ..pose.clone()
        };
        let poses = meshes.iter().flat_map(|mesh| mesh.poses.iter().map(move |pose| (mesh, pose)));
        let casters: Vec<_> = poses.map(|(mesh, pose)| (mesh, placed(pose))).collect();
        let inputs: Vec<_> = casters.iter().map(|(mesh, pose)| (&*mesh.deforming, pose)).collect();
        let mut twin = DeformFrame::new(&inputs);
        let found = run(gpu, stage, &twin);
        twin.run_mirror();
        for (index, (mesh, pose)) in casters.iter().enumerate() {
            let count = mesh.deforming.vertices().len();
            let [expected, found] = [&twin.positions, &found].map(|words| twin.positions_of(words, index, count));
            let expected: Vec<_> = expected.iter().map(|position| DVec3::from(position.map(f64::from))).collect();
            let at = |difference: String| format!("{}, scale {scale}, offset {offset}: {difference}", mesh.name);
            compare_positions(&mesh.deforming, pose, &expected, &found).map_err(at)?;
            check_alike(&mesh.deforming, &found).map_err(at)?;
        }
    }
    stay_finite(gpu, stage)
}

fn run(gpu: &Gpu, stage: &StageRun, frame: &DeformFrame) -> Vec<u32> {
    // Folded like a large dispatch, with groups left over.
    let groups = [3, (frame.blocks.len() as u32).div_ceil(3), 1];
    stage.run(gpu, groups, &frame.inputs()).get("positions")
}

fn stay_finite(gpu: &Gpu, stage: &StageRun) -> Outcome {
    let PosedMesh { deforming, poses, .. } = tube();
    let mut pose = poses[2].clone();
    pose.joint_matrices.iter_mut().for_each(|matrix| *matrix *= 3e38);
    let frame = DeformFrame::new(&[(&deforming, &pose)]);
    let found = run(gpu, stage, &frame);
    let positions = frame.positions_of(&found, 0, deforming.vertices().len());
    if !positions.as_flattened().iter().any(|coordinate| coordinate.abs() == f32::MAX) {
        return Err("no coordinate overflows".into());
    }
    check_finite("positions", positions.as_flattened())
}

fn comparers_find_planted_faults() -> Outcome {
    let PosedMesh { deforming, poses, .. } = tube();
    let expected = deforming.posed(&poses[1]);
    let sound: Vec<_> = expected.iter().map(|position| position.as_vec3().to_array()).collect();
    compare_positions(&deforming, &poses[1], &expected, &sound)?;
    check_alike(&deforming, &sound)?;
    let faults: [fn(&mut Vec<[f32; 3]>); 4] = [
        |positions| positions[20][1] += 1e-4,
        |positions| positions[20][0] = f32::NAN,
        |positions| positions.swap(3, 4),
        |positions| positions.truncate(9),
    ];
    for (index, plant) in faults.iter().enumerate() {
        let mut faulty = sound.clone();
        plant(&mut faulty);
        if compare_positions(&deforming, &poses[1], &expected, &faulty).is_ok() {
            return Err(format!("fault {index} is not found"));
        }
    }
    // The first column and the last one, which repeats it.
    let mut torn = sound.clone();
    torn[12][2] = f32::from_bits(torn[12][2].to_bits() + 1);
    if compare_positions(&deforming, &poses[1], &expected, &torn).is_err() {
        return Err("a last bit is more than the tolerance".into());
    }
    if check_alike(&deforming, &torn).is_ok() { Err("a torn seam is not found".into()) } else { Ok(()) }
}
