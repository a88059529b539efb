//! Words with faces to recheck to a dispatch.

use contrejour_layout::{DispatchArgs, LightView, SeatCounters};
use contrejour_tests::compare::compare_exact;
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use libtest_mimic::Trial;

use crate::parity::{run, stage};

/// Around one workgroup and around the fold of dispatches.
const COUNTS: [u32; 8] = [0, 1, 2, 3, 65_535 * 2, 65_535 * 2 + 1, 1 << 20, 1 << 26];

pub fn trials() -> Vec<Trial> {
    vec![gpu_trial("write_recheck_args::equals_its_twin", equals_its_twin)]
}

fn equals_its_twin(gpu: &Gpu) -> Outcome {
    let stage = stage(gpu, "write_recheck_args");
    for recheck_words in COUNTS {
        for face_block_count in COUNTS {
            let view = LightView { face_block_count, ..Default::default() };
            let counters = SeatCounters { recheck_words, ..Default::default() };
            let mut frame = Frame::of_counts(view, counters);
            let outputs = run(gpu, &stage, &frame, 1);
            frame.run_mirror("write_recheck_args");
            let what = format!("recheck_args of {recheck_words} words in {face_block_count} blocks");
            compare_exact(&what, &frame.recheck_args, &outputs.get::<DispatchArgs>("recheck_args"))?;
        }
    }
    Ok(())
}
