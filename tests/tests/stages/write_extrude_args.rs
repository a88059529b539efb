//! Silhouette edges to dispatches.

use contrejour_layout::{Counters, DispatchArgs, LightView, SeatCounters};
use contrejour_tests::compare::compare_exact;
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use libtest_mimic::Trial;

use crate::parity::{run, stage};

pub fn trials() -> Vec<Trial> {
    vec![gpu_trial("write_extrude_args::equals_its_twin", equals_its_twin)]
}

fn equals_its_twin(gpu: &Gpu) -> Outcome {
    let stage = stage(gpu, "write_extrude_args");
    for count in COUNTS {
        for capacity in COUNTS {
            let mut frame = Frame::of_counts(view(capacity), counters(count));
            let outputs = run(gpu, &stage, &frame, 1);
            frame.run_mirror("write_extrude_args");
            let what = format!("extrude_args of {count} in {capacity}");
            compare_exact(&what, &frame.extrude_args, &outputs.get::<DispatchArgs>("extrude_args"))?;
        }
    }
    Ok(())
}

/// Around one workgroup and around the fold of dispatches.
const COUNTS: [u32; 7] = [0, 1, 32, 33, 65_535 * 64, 65_535 * 64 + 1, 1 << 30];

fn view(silhouette_capacity: u32) -> LightView {
    LightView { silhouette_capacity, ..Default::default() }
}

fn counters(count: u32) -> SeatCounters {
    let counts = Counters { silhouette_edges: count, ..Default::default() };
    SeatCounters { counts, ..Default::default() }
}
