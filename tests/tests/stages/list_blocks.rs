//! Blocks of all casters to those of the casters that cast.

use contrejour_layout::{BLOCK_MASKED, SeatCounters, TestItem, VIEW_TESTS, WorkItem};
use contrejour_tests::chain::{Fault, check_each_is_found};
use contrejour_tests::compare::compare_exact;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::stage_run::StageRun;
use libtest_mimic::Trial;

use crate::parity::{for_each_case, run, stage};

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("list_blocks::lists_each_block_once", |gpu| check(gpu, &stage(gpu, "list_blocks"))),
        gpu_trial("list_blocks::a_lost_block_is_found", |gpu| check_each_is_found(gpu, &FAULTS, check)),
    ]
}

/// Devices may clamp an index that is too large: so does the fault.
const FAULTS: [Fault; 12] = [
    replaced(
        "(bundle.views[0].face_block_count + GROUP_SIZE - 1u) / GROUP_SIZE",
        "bundle.views[0].face_block_count / GROUP_SIZE",
    ),
    // Lists with holes, of each kind.
    replaced("face_tests[append_base + rank] = test;", "face_tests[append_base + rank - min(rank, 1u)] = test;"),
    replaced("edge_tests[append_base + rank] = test;", "edge_tests[append_base + rank - min(rank, 1u)] = test;"),
    replaced("face_block_count - 1u - atomicAdd", "face_block_count - 2u - atomicAdd"),
    // Blocks of nobody, and of casters that cast for no view.
    replaced("let caster = item.caster;", "let caster = min(item.caster, bundle.views[0].caster_count - 1u);"),
    replaced("caster_lights[place_of_caster(seat, caster)].casts != 0u", "true"),
    // Seats mixed up: in what is read, in what is drawn, in the mask, in the counters.
    replaced("caster_lights[place_of_caster(seat, caster)]", "caster_lights[place_of_caster(0u, caster)]"),
    replaced("face_items[seat * bundle.shape.item_stride + place_for", "face_items[place_for"),
    replaced("item.block, item.kind, tested)", "item.block, item.kind, 1u)"),
    replaced("(bundle.views[seat].flags & VIEW_TESTS) != 0u && ", ""),
    replaced(
        "atomicAdd(&counters[lane].counts.edge_items, seat_count)",
        "atomicAdd(&counters[0].counts.edge_items, seat_count)",
    ),
    replaced("index < count && ", ""),
];

const fn replaced(piece: &'static str, fault: &'static str) -> Fault {
    Fault::Replaced { stage: "list_blocks", piece, fault }
}

fn check(gpu: &Gpu, stage: &StageRun) -> Outcome {
    let (mut skipped, mut masked, mut shared) = (0, 0, 0);
    for_each_case("list_blocks", |case| {
        let mut frame = case.frame.clone();
        // Every third one casts nothing, for each view another one.
        let stride = frame.bundle.shape.caster_stride as usize;
        for seat in 0..frame.counters.len() {
            let of_seat = frame.caster_lights[seat * stride..].iter_mut().take(frame.casters.len());
            for light in of_seat.skip(1 + seat % 3).step_by(3) {
                light.casts = 0;
            }
        }
        // And every fifth view is not tested, and has no edges.
        for view in frame.bundle.views.iter_mut().skip(1).step_by(5) {
            view.flags &= !VIEW_TESTS;
            view.edge_block_count = 0;
        }
        for block in frame.face_blocks.iter_mut().skip(2).step_by(5) {
            block.kind = BLOCK_MASKED;
        }
        let groups = frame.face_blocks.len().div_ceil(64) + frame.edge_blocks.len().div_ceil(64);
        let outputs = run(gpu, stage, &frame, groups as u32);
        frame.run_mirror("list_blocks");
        compare_exact("counters", &frame.counters, &outputs.get::<SeatCounters>("counters"))?;
        let SeatCounters { face_tests, edge_tests, .. } = frame.counters[0];
        for (name, expected, count) in
            [("face_tests", &frame.face_tests, face_tests), ("edge_tests", &frame.edge_tests, edge_tests)]
        {
            let listed = |items: &[TestItem]| sorted(&items[..count as usize]);
            compare_exact(name, &listed(expected), &listed(&outputs.get(name)))?;
            shared += expected[..count as usize].iter().filter(|item| item.seats.count_ones() > 1).count();
        }
        let found: Vec<WorkItem> = outputs.get("face_items");
        for (SeatCounters { counts, .. }, seat) in frame.counters.iter().zip(0..) {
            let begin = seat * frame.bundle.shape.item_stride as usize;
            let blocks = frame.bundle.views[seat].face_block_count as usize;
            let listed = |items: &[WorkItem]| sorted(&items[begin..begin + counts.face_items as usize]);
            compare_exact(&format!("face_items of {seat}"), &listed(&frame.face_items), &listed(&found))?;
            let at_the_back =
                |items: &[WorkItem]| sorted(&items[begin + blocks - counts.masked_items as usize..begin + blocks]);
            compare_exact(&format!("masked items of {seat}"), &at_the_back(&frame.face_items), &at_the_back(&found))?;
            skipped += blocks - (counts.face_items + counts.masked_items) as usize;
            masked += counts.masked_items;
        }
        Ok(())
    })?;
    if skipped > 0 && masked > 0 && shared > 0 {
        return Ok(());
    }
    Err(format!("{skipped} skipped, {masked} masked and {shared} shared blocks"))
}

fn sorted<T: bytemuck::Pod>(items: &[T]) -> Vec<Vec<u32>> {
    let mut items: Vec<Vec<u32>> =
        items.iter().map(|item| bytemuck::cast_slice(bytemuck::bytes_of(item)).to_vec()).collect();
    items.sort_unstable();
    items
}
