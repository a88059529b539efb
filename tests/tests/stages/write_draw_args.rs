//! Quads and corners to draws.

use contrejour_layout::{Counters, DrawArgs, LightView, SeatCounters};
use contrejour_tests::compare::compare_exact;
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use libtest_mimic::Trial;

use crate::parity::{run, stage};

pub fn trials() -> Vec<Trial> {
    vec![gpu_trial("write_draw_args::equals_its_twin", equals_its_twin)]
}

fn equals_its_twin(gpu: &Gpu) -> Outcome {
    let stage = stage(gpu, "write_draw_args");
    for count in COUNTS {
        for capacity in COUNTS {
            let mut frame = Frame::of_counts(view(capacity), counters(count));
            let outputs = run(gpu, &stage, &frame, 1);
            frame.run_mirror("write_draw_args");
            let what = format!("draw_args of {count} in {capacity}");
            compare_exact(&what, &frame.draw_args, &outputs.get::<DrawArgs>("draw_args"))?;
        }
    }
    Ok(())
}

/// As many as 32 bits of vertices can draw.
const COUNTS: [u32; 6] = [0, 1, 2, 1000, 1 << 20, u32::MAX / 12];

fn view(capacity: u32) -> LightView {
    LightView { quad_capacity: capacity, corner_capacity: capacity / 2, ..Default::default() }
}

fn counters(count: u32) -> SeatCounters {
    let counts = Counters { quads: count, corners: count / 3, ..Default::default() };
    SeatCounters { counts, ..Default::default() }
}
