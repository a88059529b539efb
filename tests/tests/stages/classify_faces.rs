//! Lit bits by stored planes, and the list of words with faces that planes do not decide.
//!
//! As for `recheck_faces`, what must be equal is what follows from the bound: a bit that is decided is the exact one, and
//! every face is either decided or listed, once. How many faces are listed on one side only is bounded.

use std::collections::{BTreeMap, BTreeSet};

use contrejour_layout::{BLOCK_BY_PLANES, BLOCK_BY_POSITIONS, BLOCK_SIZE, LIT_WORDS_PER_BLOCK};
use contrejour_tests::chain::wgsl_of;
use contrejour_tests::compare::compare_exact;
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::stage_run::StageRun;
use libtest_mimic::Trial;

use crate::parity::{check_bits, for_each_case, run, stage};

/// Of the faces that one side lists, so many may be decided by the other: one, and one in fifty.
const LISTED_ON_ONE_SIDE: u32 = 50;

pub fn trials() -> Vec<Trial> {
    vec![gpu_trial("classify_faces::decides_right_or_lists", decides_right_or_lists)]
}

/// By the pipeline for any number of seats, and where there is one by its own too.
fn decides_right_or_lists(gpu: &Gpu) -> Outcome {
    let of_any = stage(gpu, "classify_faces");
    let of_one = StageRun::with_constants(gpu, wgsl_of("classify_faces"), "classify_faces", &[("one_seat", 1.0)]);
    let (mut by_planes, mut by_positions) = (0, 0);
    for_each_case("classify_faces", |case| {
        let mut before = case.frame.clone();
        before.lit.fill(u32::MAX);
        by_positions += before.listed_faces().iter().filter(|item| item.kind == BLOCK_BY_POSITIONS).count();
        by_planes += before.listed_faces().iter().filter(|item| item.kind == BLOCK_BY_PLANES).count();
        check(gpu, &of_any, &before)?;
        if before.bundle.shape.seat_count > 1 {
            return Ok(());
        }
        check(gpu, &of_one, &before).map_err(|error| format!("by the pipeline of one seat: {error}"))
    })?;
    if by_planes > 0 && by_positions > 0 { Ok(()) } else { Err("all blocks are tested in one way".into()) }
}

fn check(gpu: &Gpu, stage: &StageRun, before: &Frame) -> Outcome {
    let groups = before.counters[0].face_tests.div_ceil(BLOCK_SIZE / LIT_WORDS_PER_BLOCK);
    let outputs = run(gpu, stage, before, groups);
    let mut after = before.clone();
    after.lit = outputs.get("lit");
    after.recheck_words = outputs.get("recheck_words");
    after.counters = outputs.get("counters");

    let mut twin = before.clone();
    twin.run_mirror("classify_faces");
    let (listed, listed_by_twin) = (listed(&after)?, listed(&twin)?);
    check_listed(&listed, &listed_by_twin)?;
    check_half_blocks(&after, &listed)?;
    let is_listed =
        |caster, test: u32| listed.get(&(caster, test / 32)).is_some_and(|tests| tests >> (test % 32) & 1 == 1);
    check_bits(before, "classify_faces", &after, is_listed)
}

/// Each view counts the half blocks of which a face is listed for it.
fn check_half_blocks(frame: &Frame, listed: &BTreeMap<(u32, u32), u32>) -> Outcome {
    let seats = frame.bundle.shape.seat_count;
    let mut halves = vec![BTreeSet::new(); seats as usize];
    for (&(caster, word), tests) in listed {
        for test in (0..32).filter(|test| tests >> test & 1 == 1).map(|test| word * 32 + test) {
            halves[(test % seats) as usize].insert((caster, test / seats / 32));
        }
    }
    let expected: Vec<_> = halves.iter().map(|halves| halves.len() as u32).collect();
    let found: Vec<_> = frame.counters.iter().map(|counters| counters.counts.recheck_words).collect();
    compare_exact("half blocks with listed faces", &expected, &found)
}

/// The bits of the listed tests by caster and word.
fn listed(frame: &Frame) -> Result<BTreeMap<(u32, u32), u32>, String> {
    let count = frame.counters[0].recheck_words as usize;
    let words = frame.recheck_words.get(..count).ok_or_else(|| format!("{count} words do not fit the list"))?;
    let listed: BTreeMap<_, _> = words.iter().map(|word| ((word.caster, word.word), word.tests)).collect();
    if listed.values().any(|faces| *faces == 0) {
        return Err("a word without faces is listed".into());
    }
    if listed.len() == count { Ok(listed) } else { Err("a word is listed twice".into()) }
}

fn check_listed(listed: &BTreeMap<(u32, u32), u32>, listed_by_twin: &BTreeMap<(u32, u32), u32>) -> Outcome {
    let faces = |listed: &BTreeMap<_, u32>, word| listed.get(word).copied().unwrap_or(0);
    let words = listed.keys().chain(listed_by_twin.keys().filter(|word| !listed.contains_key(word)));
    let on_one_side: u32 = words.map(|word| (faces(listed, word) ^ faces(listed_by_twin, word)).count_ones()).sum();
    let allowed = 1 + listed.values().map(|faces| faces.count_ones()).sum::<u32>() / LISTED_ON_ONE_SIDE;
    if on_one_side <= allowed {
        return Ok(());
    }
    Err(format!("{on_one_side} faces are listed on one side only, {allowed} are allowed"))
}
