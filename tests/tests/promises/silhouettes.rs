//! Every mesh under all its lights: the list that the device leaves is exact and closed.

use contrejour_gpu::ShadowOptions;
use contrejour_layout::SilhouetteEdge;
use contrejour_plan::{Outputs, caster_light, position_scale, views};
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::lights::lights;
use contrejour_tests::meshes::{TestMesh, TestPart, all};
use contrejour_tests::oracle::OracleTopology;
use contrejour_tests::pipeline::Pipeline;
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
            let at = |difference: String| format!("light {index}, part {caster}: {difference}");
            exact::check(&part.topology, oracle, &light, &found).map_err(at)?;
            closed::check(&part.topology, &found).map_err(at)?;
        }
    }
    Ok(())
}
