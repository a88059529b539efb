//! Every mesh under all its lights: the list that the device leaves is exact and closed.

use contrejour_gpu::ShadowOptions;
use contrejour_layout::{CasterLight, SilhouetteEdge};
use contrejour_oracle::OracleTopology;
use contrejour_plan::{Outputs, caster_light, position_scale, views};
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::lights::lights;
use contrejour_tests::meshes::{TestMesh, TestPart, all};
use contrejour_tests::pipeline::Pipeline;
use glam::{DMat4, DVec4};
use libtest_mimic::Trial;

use crate::{closed, exact};

pub fn trials() -> Vec<Trial> {
    let trial = |mesh: TestMesh| {
        let name = format!("silhouettes::exact_and_closed::{}", mesh.name);
        gpu_trial(name, move |gpu| are_exact_and_closed(gpu, &mesh))
    };
    all().into_iter().map(trial).collect()
}

fn are_exact_and_closed(gpu: &Gpu, mesh: &TestMesh) -> Outcome {
    let options = ShadowOptions { outputs: Outputs::Silhouettes, ..Default::default() };
    let mut pipeline = Pipeline::new(gpu, mesh, &options)?;
    let oracle = |part: &TestPart| OracleTopology::new(&part.topology.positions, &part.triangles);
    let oracles: Vec<_> = mesh.parts.iter().map(oracle).collect();
    for (index, light) in lights(mesh).iter().enumerate() {
        let counters = pipeline.complete_frame(light)?;
        let silhouettes = pipeline.silhouettes(&counters);
        let view = views(light).map_err(|error| error.to_string())?[0];
        for (caster, (part, oracle)) in mesh.parts.iter().zip(&oracles).enumerate() {
            let of_caster = |edge: &&SilhouetteEdge| edge.caster == caster as u32;
            let found: Vec<_> = silhouettes.iter().filter(of_caster).copied().collect();
            let scale = position_scale(part.topology.bounds_min, part.topology.bounds_max);
            let light = caster_light(&view, &part.world_from_object, scale);
            check_light(&light, &part.world_from_object, view.light_world)
                .map_err(|fault| format!("light {index}, part {caster}: {fault}"))?;
            let at = |difference: String| format!("light {index}, part {caster}: {difference}");
            exact::check(&part.topology, oracle, &light, &found).map_err(at)?;
            closed::check(&part.topology, &found).map_err(at)?;
        }
    }
    Ok(())
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
