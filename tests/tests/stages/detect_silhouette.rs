//! Lit bits to silhouette edges.

use contrejour_layout::{SeatCounters, SilhouetteEdge};
use contrejour_plan::ViewCounts;
use contrejour_tests::compare::{compare_exact, compare_records};
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::random::Random;
use contrejour_tests::stage_run::StageRun;
use libtest_mimic::Trial;

use crate::parity::{for_each_case, run, stage};

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("detect_silhouette::equals_its_twin", equals_its_twin),
        gpu_trial("detect_silhouette::equals_its_twin_on_random_bits", equals_its_twin_on_random_bits),
        gpu_trial("detect_silhouette::counts_past_a_full_list", counts_past_a_full_list),
    ]
}

fn equals_its_twin(gpu: &Gpu) -> Outcome {
    let stage = stage(gpu, "detect_silhouette");
    for_each_case("detect_silhouette", |case| compare(gpu, &stage, &case.frame))
}

fn equals_its_twin_on_random_bits(gpu: &Gpu) -> Outcome {
    let stage = stage(gpu, "detect_silhouette");
    let mut random = Random::new(2);
    for_each_case("classify_faces", |case| {
        let mut frame = case.frame.clone();
        frame.lit.fill_with(|| random.word());
        compare(gpu, &stage, &frame)
    })
}

fn compare(gpu: &Gpu, stage: &StageRun, frame: &Frame) -> Outcome {
    let mut twin = frame.clone();
    twin.outline_sides.fill(u32::MAX);
    let outputs = run(gpu, stage, &twin, twin.counters[0].edge_tests);
    twin.run_mirror("detect_silhouette");
    compare_exact("counters", &twin.counters, &outputs.get::<SeatCounters>("counters"))?;
    compare_exact("outline_sides", &twin.outline_sides, &outputs.get("outline_sides"))?;
    let found: Vec<SilhouetteEdge> = outputs.get("silhouettes");
    for (counters, seat) in twin.counters.iter().zip(0..) {
        let begin = seat * twin.bundle.shape.silhouette_stride as usize;
        let of_seat = begin..begin + counters.counts.silhouette_edges as usize;
        compare_records(&format!("silhouette of {seat}"), &twin.silhouettes[of_seat.clone()], &found[of_seat], 0.0)?;
    }
    Ok(())
}

fn counts_past_a_full_list(gpu: &Gpu) -> Outcome {
    let stage = stage(gpu, "detect_silhouette");
    for_each_case("detect_silhouette", |case| {
        let mut complete = case.frame.clone();
        complete.run_mirror("detect_silhouette");
        let most = complete.counters.iter().map(|counters| counters.counts.silhouette_edges).max();
        let Some(room) = most.and_then(|most| most.checked_sub(1)) else { return Ok(()) };

        let mut frame = case.frame.clone();
        frame.set_room(ViewCounts { silhouettes: room, ..Default::default() });
        let outputs = run(gpu, &stage, &frame, frame.counters[0].edge_tests);
        compare_exact("counters", &complete.counters, &outputs.get::<SeatCounters>("counters"))?;
        let found: Vec<SilhouetteEdge> = outputs.get("silhouettes");
        for seat in 0..frame.counters.len() {
            let [of_complete, of_frame] =
                [&complete, &frame].map(|frame| seat * frame.bundle.shape.silhouette_stride as usize);
            let all = &complete.silhouettes[of_complete..][..complete.bundle.shape.silhouette_stride as usize];
            for edge in &found[of_frame..][..frame.bundle.shape.silhouette_stride as usize] {
                if !all.contains(edge) {
                    return Err(format!("{edge:?} is not in the complete list of {seat}"));
                }
            }
        }
        Ok(())
    })
}
