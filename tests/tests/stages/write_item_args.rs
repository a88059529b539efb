//! Numbers of listed blocks to dispatches and draws.

use contrejour_layout::{Counters, DispatchArgs, DrawArgs, LightView, SeatCounters};
use contrejour_tests::compare::compare_exact;
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use libtest_mimic::Trial;

use crate::parity::{run, stage};

/// Around one workgroup and around the fold of dispatches; as many as 32 bits of vertices can draw.
const COUNTS: [u32; 8] = [0, 1, 31, 33, 65_535, 65_536, 1 << 20, u32::MAX / 192];

pub fn trials() -> Vec<Trial> {
    vec![gpu_trial("write_item_args::equals_its_twin", equals_its_twin)]
}

fn equals_its_twin(gpu: &Gpu) -> Outcome {
    let stage = stage(gpu, "write_item_args");
    for items in COUNTS {
        for blocks in COUNTS {
            let view = LightView { face_block_count: blocks, edge_block_count: blocks / 2, ..Default::default() };
            let counts = Counters { face_items: items, masked_items: items / 2, ..Default::default() };
            let counters = SeatCounters { counts, face_tests: items, edge_tests: items / 3, ..Default::default() };
            let mut frame = Frame::of_counts(view, counters);
            let outputs = run(gpu, &stage, &frame, 1);
            frame.run_mirror("write_item_args");
            let what = format!("of {items} listed in {blocks}");
            compare_exact(&format!("item_args {what}"), &frame.item_args, &outputs.get::<DispatchArgs>("item_args"))?;
            compare_exact(&format!("draw_args {what}"), &frame.draw_args, &outputs.get::<DrawArgs>("draw_args"))?;
        }
    }
    Ok(())
}
