//! Undecided faces to dispatches.

use contrejour_layout::{DispatchArgs, LightView, SeatCounters};
use contrejour_tests::compare::compare_exact;
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use libtest_mimic::Trial;

use crate::parity::{run, stage};

pub fn trials() -> Vec<Trial> {
    vec![gpu_trial("write_refine_args::equals_its_twin", equals_its_twin)]
}

fn equals_its_twin(gpu: &Gpu) -> Outcome {
    let stage = stage(gpu, "write_refine_args");
    for count in COUNTS {
        for capacity in COUNTS {
            let mut frame = Frame::of_counts(view(capacity), counters(count));
            let outputs = run(gpu, &stage, &frame, 1);
            frame.run_mirror("write_refine_args");
            let what = format!("refine_args of {count} in {capacity}");
            compare_exact(&what, &frame.refine_args, &outputs.get::<DispatchArgs>("refine_args"))?;
        }
    }
    Ok(())
}

/// Around one workgroup and around the fold of dispatches.
const COUNTS: [u32; 8] = [0, 1, 64, 65, 65_535 * 64, 65_535 * 64 + 1, 1 << 30, 1 << 31];

fn view(undecided_capacity: u32) -> LightView {
    LightView { undecided_capacity, ..Default::default() }
}

fn counters(count: u32) -> SeatCounters {
    SeatCounters { undecided_near: count, undecided_far: count / 3, ..Default::default() }
}
