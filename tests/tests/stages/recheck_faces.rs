//! Lit bits by positions, and the lists of faces that floats do not decide.
//!
//! Near its bound the float test may decide a face on one side and list it on the other, since devices fuse and round
//! as they like. So what must be equal is what follows from the bound: a bit that is decided is the exact one, and
//! every face is either decided or listed, once, in the tier that its exponents ask for. How many faces are listed on
//! one side only is bounded.

use std::collections::{BTreeMap, BTreeSet};

use contrejour_layout::{FaceTest, SeatCounters};
use contrejour_tests::compare::compare_exact;
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use libtest_mimic::Trial;

use crate::parity::{check_bits, for_each_case, run, stage};

/// Of the faces that one side lists, so many may be decided by the other: one, and one in fifty.
const LISTED_ON_ONE_SIDE: usize = 50;

pub fn trials() -> Vec<Trial> {
    vec![gpu_trial("recheck_faces::decides_right_or_lists", decides_right_or_lists)]
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tier {
    Near,
    Far,
}

/// A caster, and a face of it for one view.
type Face = (u32, u32);

fn decides_right_or_lists(gpu: &Gpu) -> Outcome {
    let stage = stage(gpu, "recheck_faces");
    let (mut listed_near, mut listed_far) = (0, 0);
    for_each_case("recheck_faces", |case| {
        let before = &case.frame;
        let args = before.recheck_args[0];
        let outputs = run(gpu, &stage, before, args.x * args.y);
        let mut after = before.clone();
        after.lit = outputs.get("lit");
        after.undecided = outputs.get("undecided");
        after.counters = outputs.get("counters");

        let mut twin = before.clone();
        twin.run_mirror("recheck_faces");
        let (listed, listed_by_twin) = (listed(&after)?, listed(&twin)?);
        listed_near += after.counters[0].undecided_near;
        listed_far += after.counters[0].undecided_far;
        check_seats(&after, &listed)?;
        check_tiers(&listed, &listed_by_twin)?;
        check_bits(before, "recheck_faces", &after, |caster, test| listed.contains_key(&(caster, test)))
    })?;
    if listed_near > 0 && listed_far > 0 { Ok(()) } else { Err("no case has undecided faces in both tiers".into()) }
}

/// Each view counts the faces that are listed for it.
fn check_seats(frame: &Frame, listed: &BTreeMap<Face, Tier>) -> Outcome {
    for (counters, seat) in frame.counters.iter().zip(0..) {
        let of_seat = |tier| {
            let tests =
                listed.iter().filter(|((_, test), of)| **of == tier && test % frame.bundle.shape.seat_count == seat);
            tests.count() as u32
        };
        let found = [counters.counts.undecided_near, counters.counts.undecided_far];
        compare_exact(&format!("undecided faces of {seat}"), &[of_seat(Tier::Near), of_seat(Tier::Far)], &found)?;
    }
    Ok(())
}

/// The faces of both lists; the counters must not count past them.
fn listed(frame: &Frame) -> Result<BTreeMap<Face, Tier>, String> {
    let SeatCounters { undecided_near, undecided_far, .. } = frame.counters[0];
    let (near, far) = (undecided_near as usize, undecided_far as usize);
    if near + far > frame.undecided.len() {
        return Err(format!("{near} near and {far} far faces in a list of {}", frame.undecided.len()));
    }
    let tiers = frame.undecided[..near].iter().map(|face| (face, Tier::Near));
    let tiers = tiers.chain(frame.undecided[frame.undecided.len() - far..].iter().map(|face| (face, Tier::Far)));
    let listed: BTreeMap<_, _> = tiers.map(|(&FaceTest { caster, test }, tier)| ((caster, test), tier)).collect();
    if listed.len() == near + far { Ok(listed) } else { Err("a face is listed twice".into()) }
}

fn check_tiers(listed: &BTreeMap<Face, Tier>, listed_by_twin: &BTreeMap<Face, Tier>) -> Outcome {
    let mut on_one_side: BTreeSet<_> = listed_by_twin.keys().filter(|face| !listed.contains_key(face)).collect();
    for (face, tier) in listed {
        match listed_by_twin.get(face) {
            None => drop(on_one_side.insert(face)),
            Some(twin_tier) if twin_tier == tier => {}
            Some(twin_tier) => return Err(format!("face {face:?} is {tier:?}, its twin {twin_tier:?}")),
        }
    }
    let allowed = 1 + listed.len() / LISTED_ON_ONE_SIDE;
    if on_one_side.len() <= allowed {
        return Ok(());
    }
    Err(format!("{} faces are listed on one side only, {allowed} are allowed", on_one_side.len()))
}
