//! Blocks of all casters to those of the casters that cast.

use contrejour_layout::{BLOCK_MASKED, Counters, WorkItem};
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
const FAULTS: [Fault; 6] = [
    Fault::Replaced {
        stage: "list_blocks",
        piece: "(view.face_block_count + GROUP_SIZE - 1u) / GROUP_SIZE",
        fault: "view.face_block_count / GROUP_SIZE",
    },
    Fault::Replaced {
        stage: "list_blocks",
        piece: "let slot = append_base + rank;",
        fault: "let slot = append_base + rank - min(rank, 1u);",
    },
    Fault::Replaced {
        stage: "list_blocks",
        piece: "view.face_block_count - 1u - atomicAdd",
        fault: "view.face_block_count - 2u - atomicAdd",
    },
    Fault::Replaced {
        stage: "list_blocks",
        piece: "item = edge_blocks[index];\n        casts = item.caster != NO_CASTER && caster_lights[item.caster].casts != 0u;",
        fault: "item = edge_blocks[index];\n        casts = item.caster != NO_CASTER;",
    },
    Fault::Replaced {
        stage: "list_blocks",
        piece: "item = face_blocks[index];\n        casts = item.caster != NO_CASTER && caster_lights[item.caster].casts != 0u;",
        fault: "item = face_blocks[index];\n        casts = caster_lights[min(item.caster, arrayLength(&caster_lights) - 1u)].casts != 0u;",
    },
    Fault::Replaced {
        stage: "list_blocks",
        piece: "item = edge_blocks[index];\n        casts = item.caster != NO_CASTER && caster_lights[item.caster].casts != 0u;",
        fault: "item = edge_blocks[index];\n        casts = caster_lights[min(item.caster, arrayLength(&caster_lights) - 1u)].casts != 0u;",
    },
];

fn check(gpu: &Gpu, stage: &StageRun) -> Outcome {
    let (mut skipped, mut masked) = (0, 0);
    for_each_case("list_blocks", |case| {
        let mut frame = case.frame.clone();
        // Every third one casts nothing.
        for light in frame.caster_lights.iter_mut().skip(1).step_by(3) {
            light.casts = 0;
        }
        for block in frame.face_blocks.iter_mut().skip(2).step_by(5) {
            block.kind = BLOCK_MASKED;
        }
        let groups = frame.view.face_block_count.div_ceil(64) + frame.view.edge_block_count.div_ceil(64);
        let outputs = run(gpu, stage, &frame, groups);
        frame.run_mirror("list_blocks");
        let Counters { face_items, edge_items, masked_items, .. } = frame.counters;
        compare_exact("counters", &[frame.counters], &outputs.get::<Counters>("counters"))?;
        let listed = |items: &[WorkItem], count: u32| sorted(&items[..count as usize]);
        compare_exact(
            "face_items",
            &listed(&frame.face_items, face_items),
            &listed(&outputs.get("face_items"), face_items),
        )?;
        let at_the_back = |items: &[WorkItem]| {
            let blocks = frame.view.face_block_count as usize;
            sorted(&items[blocks - masked_items as usize..blocks])
        };
        compare_exact("masked items", &at_the_back(&frame.face_items), &at_the_back(&outputs.get("face_items")))?;
        compare_exact(
            "edge_items",
            &listed(&frame.edge_items, edge_items),
            &listed(&outputs.get("edge_items"), edge_items),
        )?;
        skipped += frame.view.face_block_count - face_items - masked_items;
        masked += masked_items;
        Ok(())
    })?;
    if skipped > 0 && masked > 0 { Ok(()) } else { Err(format!("{skipped} skipped and {masked} masked blocks")) }
}

fn sorted(items: &[WorkItem]) -> Vec<[u32; 3]> {
    let mut items: Vec<_> = items.iter().map(|item| [item.caster, item.block, item.kind]).collect();
    items.sort_unstable();
    items
}
