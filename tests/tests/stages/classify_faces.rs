//! Lit bits by stored planes, and the list of words with faces that planes do not decide.
//!
//! As for `recheck_faces`, what must be equal is what follows from the bound: a bit that is decided is the exact one, and
//! every face is either decided or listed, once. How many faces are listed on one side only is bounded.

use std::collections::BTreeMap;

use contrejour_layout::{BLOCK_BY_PLANES, BLOCK_BY_POSITIONS, BLOCK_SIZE, LIT_WORDS_PER_BLOCK};
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use libtest_mimic::Trial;

use crate::parity::{check_bits, for_each_case, run, stage};

/// Of the faces that one side lists, so many may be decided by the other: one, and one in fifty.
const LISTED_ON_ONE_SIDE: u32 = 50;

pub fn trials() -> Vec<Trial> {
    vec![gpu_trial("classify_faces::decides_right_or_lists", decides_right_or_lists)]
}

fn decides_right_or_lists(gpu: &Gpu) -> Outcome {
    let stage = stage(gpu, "classify_faces");
    let (mut by_planes, mut by_positions) = (0, 0);
    for_each_case("classify_faces", |case| {
        let mut before = case.frame.clone();
        before.lit.fill(u32::MAX);
        let groups = before.counters.face_items.div_ceil(BLOCK_SIZE / LIT_WORDS_PER_BLOCK);
        let outputs = run(gpu, &stage, &before, groups);
        let mut after = before.clone();
        after.lit = outputs.get("lit");
        after.recheck_words = outputs.get("recheck_words");
        after.counters = outputs.get("counters")[0];

        let mut twin = before.clone();
        twin.run_mirror("classify_faces");
        let (listed, listed_by_twin) = (listed(&after)?, listed(&twin)?);
        check_listed(&listed, &listed_by_twin)?;
        by_positions += before.listed_faces().iter().filter(|item| item.kind == BLOCK_BY_POSITIONS).count();
        by_planes += before.listed_faces().iter().filter(|item| item.kind == BLOCK_BY_PLANES).count();
        let is_listed = |caster, face_id: u32| {
            listed.get(&(caster, face_id / 32)).is_some_and(|faces| faces >> (face_id % 32) & 1 == 1)
        };
        check_bits(&before, "classify_faces", &after, is_listed)
    })?;
    if by_planes > 0 && by_positions > 0 { Ok(()) } else { Err("all blocks are tested in one way".into()) }
}

/// The bits of the listed faces by caster and word.
fn listed(frame: &Frame) -> Result<BTreeMap<(u32, u32), u32>, String> {
    let count = frame.counters.recheck_words as usize;
    let words = frame.recheck_words.get(..count).ok_or_else(|| format!("{count} words do not fit the list"))?;
    let listed: BTreeMap<_, _> = words.iter().map(|word| ((word.caster, word.word), word.faces)).collect();
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
