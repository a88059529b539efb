//! Facing is exact on faces made to be hard: three tiers, one after the other as the library dispatches them, against
//! exact arithmetic bit by bit.

use std::sync::Arc;

use contrejour_gpu::{CasterInput, Positions, ShadowOptions, Shadows, Untimed};
use contrejour_layout::{BLOCK_SIZE, Counters, LIT_WORDS_PER_BLOCK};
use contrejour_mesh::{BuildOptions, TopologyAwareMesh};
use contrejour_oracle::lit;
use contrejour_plan::{BufferKind, Outputs, ShadowSettings};
use contrejour_tests::chain::{Chain, Fault};
use contrejour_tests::compare::compare_exact;
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, cpu_trial, gpu_trial};
use contrejour_tests::hostile::{Hardness, HostileCaster};
use contrejour_tests::meshes::TestMesh;
use contrejour_tests::object_light::ObjectLight;
use libtest_mimic::Trial;

/// Not a multiple of a block of faces.
const FACES_EACH: usize = 750;

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("facing::hostile_faces_are_lit_as_exact_arithmetic_says", hostile_faces_are_exact),
        gpu_trial("facing::a_fault_in_any_tier_is_found", a_fault_in_any_tier_is_found),
        cpu_trial("facing::comparer_finds_any_wrong_bit", comparer_finds_any_wrong_bit),
    ]
}

fn hostile_faces_are_exact(gpu: &Gpu) -> Outcome {
    let mut shadows = Shadows::new(&gpu.device).map_err(|error| error.to_string())?;
    let (mut faces, mut near, mut far) = (0, 0, 0);
    for kind in Hardness::ALL {
        for (is_point, mirrored) in [(true, false), (false, true), (true, true), (false, false)] {
            let caster = HostileCaster::new(kind, is_point, mirrored, FACES_EACH);
            let (found, counters) = lit_words_of_device(gpu, &mut shadows, &caster)?;
            let name = format!("lit words of {kind:?}, {:?}", caster.light);
            compare_exact(&name, &lit_words_of_oracle(&caster), &found)?;
            faces += caster.faces.len();
            near += counters.undecided_near;
            far += counters.undecided_far;
        }
    }
    // Else the exact tiers were hardly asked.
    if faces >= 20_000 && near > 2000 && far > 2000 {
        return Ok(());
    }
    Err(format!("only {near} and {far} of {faces} faces came to the exact tiers"))
}

/// Faults in the guards of the tiers.
const FAULTS: [Fault; 7] = [
    // A hundredth of the bound of planes.
    Fault::Replaced { stage: "classify_faces", piece: "0x1p-20;", fault: "0x1p-20 / 100.0;" },
    Fault::Skipped { stage: "recheck_faces" },
    // A hundredth of the bound for rounding.
    Fault::Replaced { stage: "recheck_faces", piece: "0x1p-19;", fault: "0x1p-19 / 100.0;" },
    // No bound for underflow.
    Fault::Replaced { stage: "recheck_faces", piece: "0x1p-61;", fault: "0.0;" },
    // More bits than short integers hold.
    Fault::Replaced { stage: "recheck_faces", piece: "NEAR_SPAN = 61u;", fault: "NEAR_SPAN = 70u;" },
    Fault::Skipped { stage: "refine_faces" },
    Fault::Skipped { stage: "resolve_faces" },
];

fn a_fault_in_any_tier_is_found(gpu: &Gpu) -> Outcome {
    let mut chain = Chain::new(gpu, "resolve_faces");
    let casters: Vec<_> = Hardness::ALL
        .into_iter()
        .flat_map(|kind| [true, false].map(|is_point| HostileCaster::new(kind, is_point, !is_point, FACES_EACH)))
        .map(|caster| (frame_of(&caster), lit_words_of_oracle(&caster)))
        .collect();
    let are_exact = |chain: &Chain<'_>| {
        casters.iter().try_for_each(|(frame, expected)| {
            let mut frame = frame.clone();
            chain.run(&mut frame);
            compare_exact("lit words", expected, &frame.lit)
        })
    };
    are_exact(&chain)?;
    for fault in &FAULTS {
        if chain.with(fault, are_exact).is_ok() {
            return Err(format!("not found: {fault:?}"));
        }
    }
    Ok(())
}

fn frame_of(caster: &HostileCaster) -> Frame {
    let mut mesh = TestMesh::generated("hostile faces", caster.faces.as_flattened(), &triangles(caster));
    mesh.parts[0].world_from_object = caster.light.world_from_object();
    Frame::new(&mesh.parts, &caster.light.light(), &ShadowSettings::default())
}

fn triangles(caster: &HostileCaster) -> Vec<[u32; 3]> {
    (0..caster.faces.len() as u32).map(|face| [3 * face, 3 * face + 1, 3 * face + 2]).collect()
}

fn lit_words_of_device(
    gpu: &Gpu,
    shadows: &mut Shadows,
    caster: &HostileCaster,
) -> Result<(Vec<u32>, Counters), String> {
    let mesh = TopologyAwareMesh::build(caster.faces.as_flattened(), &triangles(caster), &BuildOptions::default())
        .map_err(|error| error.to_string())?;
    let mesh = shadows.add_mesh(Arc::new(mesh)).map_err(|error| error.to_string())?;
    let world_from_object = caster.light.world_from_object();
    let input = CasterInput { mesh, world_from_object, positions: Positions::OfMesh };
    let handle = shadows.add_caster(&input).map_err(|error| error.to_string())?;
    let options = ShadowOptions { outputs: Outputs::Silhouettes, ..Default::default() };
    let light = shadows.add_light(&caster.light.light(), &options).map_err(|error| error.to_string())?;

    shadows.prepare(&gpu.device, &gpu.queue).map_err(|error| error.to_string())?;
    let mut encoder = gpu.device.create_command_encoder(&Default::default());
    shadows.encode(&mut encoder, &mut Untimed);
    gpu.queue.submit([encoder.finish()]);
    let counters = shadows.wait_for_counters(&gpu.device).map_err(|error| error.to_string())?;
    let lit = shadows.buffer(BufferKind::Lit).ok_or("a frame with faces has lit bits")?;
    let words = gpu.read_part(lit, word_count(caster));
    shadows.remove_light(light).map_err(|error| error.to_string())?;
    shadows.remove_caster(handle).map_err(|error| error.to_string())?;
    Ok((words, counters))
}

/// Words of whole blocks.
fn word_count(caster: &HostileCaster) -> usize {
    caster.faces.len().div_ceil(BLOCK_SIZE as usize) * LIT_WORDS_PER_BLOCK as usize
}

/// One bit a face; those behind the last face are clear.
fn lit_words_of_oracle(caster: &HostileCaster) -> Vec<u32> {
    let ObjectLight { light_object, mirrored } = caster.light;
    let mut words = vec![0; word_count(caster)];
    for (index, &[a, b, c]) in caster.faces.iter().enumerate() {
        words[index / 32] |= u32::from(lit(a, b, c, light_object, mirrored)) << (index % 32);
    }
    words
}

fn comparer_finds_any_wrong_bit() -> Outcome {
    let caster = HostileCaster::new(Hardness::Coplanar, true, false, 100);
    let expected = lit_words_of_oracle(&caster);
    compare_exact("lit", &expected, &expected)?;
    let lit_count: u32 = expected.iter().map(|word| word.count_ones()).sum();
    if !(20..=80).contains(&lit_count) {
        return Err(format!("{lit_count} of 100 faces are lit"));
    }
    for bit in 0..32 * expected.len() {
        let mut faulty = expected.clone();
        faulty[bit / 32] ^= 1 << (bit % 32);
        if compare_exact("lit", &expected, &faulty).is_ok() {
            return Err(format!("the wrong bit {bit} was not found"));
        }
    }
    Ok(())
}
