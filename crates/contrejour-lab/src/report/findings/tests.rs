//! Each sentence stands where made-up figures say so, and is gone where they say the opposite.

use super::super::sample::{contestant, group, report};
use super::super::{Contestant, Report};
use crate::metrics::MotionExcess;

fn plain(rmse: f64, time_ms: f64) -> Contestant {
    contestant("shadow map", "shadow map", "shadow-map", rmse, time_ms)
}

fn smoothies(rmse: f64, time_ms: f64) -> Contestant {
    contestant("smoothies", "smoothies", "smoothies", rmse, time_ms)
}

fn pcss(rmse: f64, time_ms: f64) -> Contestant {
    contestant("PCSS 16+32", "PCSS 16+32", "pcss", rmse, time_ms)
}

/// Text about the scene `square` with these contestants.
fn scene_text(contestants: Vec<Contestant>) -> String {
    let findings = report(vec![group("square", 1024, contestants)]).findings();
    findings.scenes[0].sentences.join("\n")
}

fn summary_text(report: &Report) -> String {
    report.findings().summary.join("\n")
}

fn assert_says(text: &str, sentence: &str) {
    assert!(text.contains(sentence), "\"{sentence}\" is not in:\n{text}");
}

fn assert_silent(text: &str, about: &str) {
    assert!(!text.contains(about), "\"{about}\" is in:\n{text}");
}

#[test]
fn smoothies_that_lose_to_the_hard_shadow_are_named() {
    let mut losing = smoothies(0.14, 1.3);
    losing.errors.umbra.too_large_pixels = 1800;
    let text = scene_text(vec![plain(0.11, 1.0), losing, pcss(0.016, 2.0)]);
    assert_says(
        &text,
        "By RMSE less exact than the plain hard shadow (0.110): smoothies (0.140); PCSS 16+32 has 0.0160.",
    );
    assert_says(
        &text,
        "The umbra, which smoothies never shrink, is too large on 3.0\u{a0}% (smoothies) of the receivers.",
    );
    assert_silent(&text, "More exact than the plain");
    assert_says(
        &text,
        "Most exact: PCSS 16+32, with an RMSE of 0.0160, in 2.00 times the time of the plain shadow map.",
    );
    assert_says(&text, "Fastest: shadow map, at 1.00 ms and an RMSE of 0.110.");
    assert_says(&text, "Nothing measured is both faster and more exact than shadow map and PCSS 16+32.");
}

#[test]
fn smoothies_that_win_against_the_hard_shadow_are_named() {
    let mut winning = smoothies(0.05, 1.3);
    winning.errors.umbra.too_large_pixels = 10;
    let text = scene_text(vec![plain(0.11, 1.0), winning, pcss(0.016, 2.0)]);
    assert_says(&text, "More exact than the plain hard shadow (0.110): smoothies (0.0500).");
    assert_silent(&text, "less exact");
    assert_silent(&text, "umbra");
    assert_says(&text, "than shadow map, smoothies and PCSS 16+32.");
}

#[test]
fn an_umbra_that_is_rather_too_small_is_not_called_too_large() {
    let mut small = smoothies(0.05, 1.3);
    small.errors.umbra.too_large_pixels = 600;
    small.errors.umbra.too_small_pixels = 900;
    assert_silent(&scene_text(vec![plain(0.11, 1.0), small]), "umbra");
}

#[test]
fn differences_below_the_truths_own_error_are_no_differences() {
    // The sample's truth is exact to 0.001 in a pixel, and to 0.000004 over its 60 000 receivers.
    let text = scene_text(vec![plain(0.0500, 1.0), smoothies(0.050_003, 3.0)]);
    assert_silent(&text, "less exact");
    assert_silent(&text, "More exact");
    assert_says(&text, "smoothies can't be told from it within the noise of the truth");
    assert_silent(&scene_text(vec![plain(0.0500, 1.0), smoothies(0.050_006, 3.0)]), "can't be told");
}

#[test]
fn who_beats_whom_needs_both_error_and_time() {
    let ours_win = scene_text(vec![plain(0.11, 1.0), smoothies(0.05, 1.3), pcss(0.06, 2.0)]);
    assert_says(&ours_win, "Both more exact and faster: smoothies (0.0500) than PCSS 16+32 (0.0600).");
    let peer_wins = scene_text(vec![plain(0.11, 1.0), smoothies(0.06, 2.0), pcss(0.05, 1.3)]);
    assert_says(&peer_wins, "Both more exact and faster than smoothies (0.0600): PCSS 16+32 (0.0500).");
    // Each better in one, or faster only within the spread of 10 % each way.
    for (ours, peer) in [(smoothies(0.06, 1.3), pcss(0.05, 2.0)), (smoothies(0.05, 1.9), pcss(0.06, 2.0))] {
        assert_silent(&scene_text(vec![plain(0.11, 1.0), ours, peer]), "Both more exact");
    }
}

#[test]
fn times_within_the_spread_share_the_first_place() {
    let text = scene_text(vec![plain(0.11, 1.0), smoothies(0.05, 1.1)]);
    assert_says(
        &text,
        "Fastest: shadow map, at 1.00 ms and an RMSE of 0.110; within the spread of its frames: smoothies.",
    );
    assert_silent(&scene_text(vec![plain(0.11, 1.0), smoothies(0.05, 1.3)]), "within the spread");
}

#[test]
fn variants_on_the_front_are_counted() {
    let mut coarse = pcss(0.03, 1.5);
    coarse.label = "PCSS 16+32, narrow".into();
    assert_says(&scene_text(vec![plain(0.11, 1.0), coarse, pcss(0.016, 2.0)]), "PCSS 16+32 (2 variants)");
}

#[test]
fn jumps_are_told_both_ways() {
    let moving = |mut contestant: Contestant, mean: f64| {
        contestant.errors.motion = Some(MotionExcess { steps: 15, mean, percentile_99: mean, largest: mean });
        contestant
    };
    let text = |ours: f64| scene_text(vec![moving(plain(0.11, 1.0), 0.01), moving(smoothies(0.05, 1.3), ours)]);
    assert_says(&text(0.032), "this many times the plain shadow map's: 3.2 (smoothies).");
    assert_says(&text(0.005), "this many times the plain shadow map's: 0.50 (smoothies).");
    assert_silent(&text(0.011), "Averaged");
    let beside_peer = |ours: f64| {
        let peer = moving(pcss(0.016, 2.0), 0.14);
        scene_text(vec![moving(plain(0.11, 1.0), 0.01), moving(smoothies(0.05, 1.3), ours), peer])
    };
    for (ours, printed) in [(0.851, "0.851"), (0.02, "0.0200")] {
        assert_says(
            &beside_peer(ours),
            &format!("at most {printed} (smoothies); with the most exact other soft shadow 0.140 (PCSS 16+32)."),
        );
    }
    let mut unmeasured = smoothies(0.05, 1.3);
    unmeasured.errors.motion = None;
    assert_silent(&scene_text(vec![plain(0.11, 1.0), unmeasured]), "jumps");
}

#[test]
fn the_summary_counts_scenes() {
    let lost = || group("square", 1024, vec![plain(0.11, 1.0), smoothies(0.14, 1.3), pcss(0.016, 2.0)]);
    let won = || group("fence", 1024, vec![plain(0.11, 1.0), smoothies(0.05, 1.6), pcss(0.06, 2.0)]);
    let mixed = summary_text(&report(vec![lost(), won()]));
    assert_says(
        &mixed,
        "Smoothies are less exact than the plain hard shadow on square (RMSE 0.140 against 0.110), and more exact \
         than the plain hard shadow on fence (RMSE 0.0500 against 0.110); less exact than the most exact other soft \
         shadow on square (RMSE 0.140 against 0.0160), and more exact than the most exact other soft shadow on fence \
         (RMSE 0.0500 against 0.0600).",
    );
    assert_says(
        &mixed,
        "Smoothies take 1.3 to 1.6 times as long as the plain shadow map, the most exact other soft shadow 2.0.",
    );
    let only_lost = summary_text(&report(vec![lost()]));
    assert_says(&only_lost, "less exact than the plain hard shadow on square (RMSE 0.140 against 0.110)");
    assert_silent(&only_lost, "more exact than");
    let alike = report(vec![group("square", 1024, vec![plain(0.05, 1.0), smoothies(0.050_002, 1.3)])]);
    assert_says(&summary_text(&alike), "Smoothies are as exact as the plain hard shadow");
}

#[test]
fn a_family_that_wins_does_not_speak_for_one_that_loses() {
    let winning = contestant("smoothies 0.02", "smoothies 0.02", "smoothies", 0.05, 1.3);
    let losing = contestant("smoothies by light size", "smoothies by light size", "smoothies", 0.14, 1.3);
    let findings = report(vec![group("square", 1024, vec![plain(0.11, 1.0), winning, losing])]).findings();
    assert_eq!(
        findings.summary[..2],
        [
            "Smoothies by light size are less exact than the plain hard shadow on square (RMSE 0.140 against 0.110).",
            "Smoothies 0.02 are more exact than the plain hard shadow on square (RMSE 0.0500 against 0.110).",
        ]
    );
}

#[test]
fn software_devices_are_told() {
    let mut report =
        report(vec![group("square", 1024, vec![plain(0.11, 1.0)]), group("fence", 512, vec![plain(0.11, 1.0)])]);
    assert_silent(&summary_text(&report), "software");
    assert_says(&summary_text(&report), "the map size nearest to 1024");
    report.groups[1].machine.is_software = true;
    assert_says(&summary_text(&report), "Some of these times come from a device in software");
    report.groups[0].machine.is_software = true;
    assert_says(&summary_text(&report), "All of these times come from a device in software");
}

#[test]
fn nothing_is_said_about_what_is_not_there() {
    let without_smoothies = report(vec![group("square", 1024, vec![plain(0.11, 1.0)])]);
    assert_silent(&summary_text(&without_smoothies), "moothies");
    assert_eq!(report(Vec::new()).findings().summary, Vec::<String>::new());
    let empty = report(vec![group("square", 1024, Vec::new())]).findings();
    assert!(empty.scenes[0].sentences.is_empty());
}
