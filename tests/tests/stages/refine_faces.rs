//! Undecided faces by short integers.

use contrejour_tests::compare::compare_exact;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use libtest_mimic::Trial;

use crate::parity::{for_each_case, run, stage};

pub fn trials() -> Vec<Trial> {
    vec![gpu_trial("refine_faces::equals_its_twin", equals_its_twin)]
}

fn equals_its_twin(gpu: &Gpu) -> Outcome {
    let stage = stage(gpu, "refine_faces");
    let mut decided = 0;
    for_each_case("refine_faces", |case| {
        let mut twin = case.frame.clone();
        let args = twin.refine_args[0];
        let outputs = run(gpu, &stage, &twin, args.x * args.y);
        twin.run_mirror("refine_faces");
        decided += twin.counters[0].undecided_near;
        compare_exact("lit", &twin.lit, &outputs.get::<u32>("lit"))
    })?;
    if decided > 0 { Ok(()) } else { Err("no case has a face for this stage".into()) }
}
