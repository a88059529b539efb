//! Every mesh under all its lights: the list that the device leaves is exact and closed.

use contrejour_gpu::ShadowOptions;
use contrejour_layout::{CasterLight, Counters, Edge, SilhouetteEdge};
use contrejour_oracle::{ManyLights, OracleTopology};
use contrejour_plan::{NearOne, Outputs, caster_light, views};
use contrejour_tests::compare::compare_exact;
use contrejour_tests::exhaust::{Exhaust, Found};
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::lights::lights;
use contrejour_tests::many_lights::adversarial_lights;
use contrejour_tests::meshes::{TestMesh, TestPart, all, shapes};
use contrejour_tests::object_light::ObjectLight;
use contrejour_tests::pipeline::Pipeline;
use contrejour_tests::random::Random;
use glam::{DMat4, DVec4};
use libtest_mimic::Trial;

use crate::{closed, exact};

/// Faces times adversarial lights in object space.
const FACE_TESTS_PER_MESH: usize = 1_000_000;

pub fn trials() -> Vec<Trial> {
    let trial = |mesh: &'static TestMesh| {
        let name = format!("silhouettes::exact_and_closed::{}", mesh.name);
        gpu_trial(name, |gpu| are_exact_and_closed(gpu, mesh))
    };
    let planted = gpu_trial("silhouettes::a_wrong_bit_and_a_wrong_edge_are_counted", wrong_bits_and_edges_are_counted);
    all().iter().map(trial).chain([planted]).collect()
}

fn are_exact_and_closed(gpu: &Gpu, mesh: &TestMesh) -> Outcome {
    let options = ShadowOptions { outputs: Outputs::Silhouettes, ..Default::default() };
    let mut pipeline = Pipeline::new(gpu, mesh, &options)?;
    let oracle = |part: &TestPart| OracleTopology::new(&part.topology.positions, &part.triangles);
    let oracles: Vec<_> = mesh.parts.iter().map(|part| ManyLights::new(&oracle(part))).collect();
    for (index, light) in lights(mesh).iter().enumerate() {
        pipeline.complete_frame(light)?;
        let silhouettes = pipeline.silhouettes();
        let view = views(light).map_err(|error| error.to_string())?[0];
        for (caster, (part, oracle)) in mesh.parts.iter().zip(&oracles).enumerate() {
            let of_caster = |edge: &&SilhouetteEdge| edge.caster == caster as u32;
            let found: Vec<_> = silhouettes.iter().filter(of_caster).copied().collect();
            let near_one = NearOne::of_box(part.topology.bounds_min, part.topology.bounds_max);
            let light = caster_light(&view, &part.world_from_object, &near_one);
            check_light(&light, &part.world_from_object, view.light_world)
                .map_err(|fault| format!("light {index}, part {caster}: {fault}"))?;
            let at = |difference: String| format!("light {index}, part {caster}: {difference}");
            exact::check(&part.topology, oracle, &light, &found).map_err(at)?;
            closed::check(&part.topology, &found).map_err(at)?;
        }
    }
    are_exact_for_hard_lights(gpu, mesh)
}

/// A little of what the command `exhaust` does at length.
fn are_exact_for_hard_lights(gpu: &Gpu, mesh: &TestMesh) -> Outcome {
    let mut exhaust = Exhaust::new(gpu, mesh)?;
    let faces = exhaust.faces();
    let count = FACE_TESTS_PER_MESH.checked_div(faces.len()).unwrap_or(0).clamp(8, 200);
    let tally = exhaust.run(&adversarial_lights(&faces, count, &mut Random::new(2)))?;
    match &tally.first_difference {
        None => Ok(()),
        Some(difference) => Err(format!("{} differences, the first: {difference}", tally.differences())),
    }
}

fn wrong_bits_and_edges_are_counted(gpu: &Gpu) -> Outcome {
    let torus = shapes().swap_remove(4);
    let exhaust = Exhaust::new(gpu, &torus)?;
    let light = ObjectLight { light_object: [0.3, 0.8, 0.5, 0.0], mirrored: false };
    let (mut lit, mut silhouettes) = (vec![0; exhaust.faces().len() / 32], Vec::new());
    let oracle = ManyLights::new(&OracleTopology::new(&torus.parts[0].topology.positions, &torus.parts[0].triangles));
    let lit_faces = oracle.lit_faces(light.light_object, light.mirrored);
    for face in (0..lit_faces.len()).filter(|&face| lit_faces[face]) {
        lit[face / 32] |= 1 << (face % 32);
    }
    for edge in oracle.silhouette(&lit_faces) {
        let is_edge = |&(_, found): &(u32, &Edge)| (found.low_vertex, found.high_vertex) == (edge.low, edge.high);
        let edge_id = (0..).zip(&torus.parts[0].topology.edges).find(is_edge).ok_or("no such edge")?.0;
        let [left, right] = [edge.left, edge.right].map(i32::cast_unsigned);
        silhouettes.push(SilhouetteEdge { caster: 0, edge_id, left, right });
    }
    let counted = |fault: fn(&mut Found)| {
        let counters = Counters::default();
        let mut found = Found { counters, lit: lit.clone(), silhouettes: silhouettes.clone() };
        fault(&mut found);
        let tally = exhaust.compare(&light, &found);
        (tally.wrong_bits, tally.wrong_edges)
    };
    let counts = [
        counted(|_| ()),
        counted(|found| found.lit[3] ^= 1 << 17),
        counted(|found| found.silhouettes.truncate(found.silhouettes.len() - 1)),
        counted(|found| found.silhouettes.push(found.silhouettes[0])),
        counted(|found| found.silhouettes[5].left += 1),
        counted(|found| found.silhouettes[5].caster = 1),
    ];
    compare_exact("counted", &[(0, 0), (1, 0), (0, 1), (0, 1), (0, 2), (0, 1)], &counts)
}

/// The light that the oracle is asked about comes from the library, so that too is held against what it should be.
fn check_light(light: &CasterLight, world_from_object: &DMat4, light_world: DVec4) -> Outcome {
    let determinant = world_from_object.determinant();
    if [light.casts, light.mirrored] != [u32::from(determinant != 0.0), u32::from(determinant < 0.0)] {
        return Err(format!("casts {}, mirrored {}: determinant {determinant}", light.casts, light.mirrored));
    }
    let back = *world_from_object * DVec4::from_array(light.light_object.map(|bits| f32::from_bits(bits).into()));
    let expected = if light_world.w == 0.0 { light_world.normalize() } else { light_world };
    let back = if light_world.w == 0.0 { back.normalize() } else { back };
    let size = expected.truncate().abs().max_element().max(world_from_object.w_axis.truncate().abs().max_element());
    let error = (back - expected).abs().max_element();
    // The smallest subnormal is what f32 can be off by near zero.
    if error <= 1e-5 * size + f64::from(f32::from_bits(1)) {
        return Ok(());
    }
    Err(format!("light {light_world} comes back as {back}"))
}
