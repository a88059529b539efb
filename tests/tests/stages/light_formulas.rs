//! The formulas by which light falls off and becomes tones: shaders and CPU say the same, over a grid.

use bytemuck::cast_slice;
use contrejour_plan::{ConeFalloff, MIN_FALLOFF_DISTANCE, distance_falloff};
use contrejour_render::tone_mapped;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::planted::check_each_is_found;
use contrejour_tests::stage_run::StageRun;
use libtest_mimic::Trial;

const WGSL: &str = concat!(
    "@group(0) @binding(0) var<storage, read> questions: array<vec4f>;
@group(0) @binding(1) var<storage, read_write> answers: array<vec4f>;

@compute @workgroup_size(64)
fn calculate(@builtin(global_invocation_id) id: vec3u) {
    let question = questions[id.x];
    if question.w >= 0.0 {
        answers[id.x] = vec4f(tone_mapped(question.rgb), 0.0);
    } else if question.w == -1.0 {
        answers[id.x].x = distance_falloff(question.x * question.x, question.y, question.z * question.z);
    } else {
        answers[id.x].x = cone_falloff(question.x, question.y, question.z);
    }
}
",
    include_str!("../../../shaders/shared/falloff.wgsl"),
    include_str!("../../../shaders/shared/tone_map.wgsl"),
);

/// A piece of the text, and a fault.
const FAULTS: [(&str, &str); 9] = [
    ("return window * window /", "return window /"),
    ("share_squared * share_squared", "share_squared"),
    ("range_inverse * range_inverse", "range_inverse"),
    ("distance_squared + least_distance_squared", "distance_squared"),
    ("return share * share;", "return share;"),
    ("cosine * scale + offset", "cosine * scale"),
    ("const DESATURATION = 0.15;", "const DESATURATION = 0.16;"),
    ("const COMPRESSED_FROM = 0.8;", "const COMPRESSED_FROM = 0.79;"),
    ("max(kept.g, kept.b)", "kept.g"),
];

/// How far a result may be off, as a share of the formulas' largest terms: some ten roundings of 2^-24, and the 2.5 units
/// in the last place that WGSL allows a division.
const TOLERANCE: f64 = 2e-6;

/// What the device is asked, what the CPU says, and how large the terms of that are.
struct Question {
    asked: [f32; 4],
    expected: [f64; 3],
    scale: f64,
}

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("light_formulas::equal_the_cpu", |gpu| check(gpu, WGSL)),
        gpu_trial("light_formulas::a_fault_in_any_of_them_is_found", a_fault_in_any_of_them_is_found),
    ]
}

fn a_fault_in_any_of_them_is_found(gpu: &Gpu) -> Outcome {
    check_each_is_found(WGSL, &FAULTS, |wgsl| check(gpu, wgsl))
}

fn check(gpu: &Gpu, wgsl: &str) -> Outcome {
    let mut questions: Vec<Question> = distances().into_iter().chain(cones()).chain(colours()).collect();
    questions.truncate(questions.len() / 64 * 64);
    let asked: Vec<[f32; 4]> = questions.iter().map(|question| question.asked).collect();
    let answers = vec![[0.0_f32; 4]; asked.len()];
    let inputs: [(&str, &[u8]); 2] = [("questions", cast_slice(&asked)), ("answers", cast_slice(&answers))];
    let outputs = StageRun::new(gpu, wgsl, "calculate").run(gpu, [asked.len() as u32 / 64, 1, 1], &inputs);
    let answers: Vec<[f32; 4]> = outputs.get("answers");
    for (Question { asked, expected, scale }, answer) in questions.iter().zip(answers) {
        for (expected, found) in expected.iter().zip(answer) {
            // Positive, so that NaN is found.
            if (expected - f64::from(found)).abs() <= TOLERANCE * scale {
                continue;
            }
            return Err(format!("{asked:?}: {expected:e} expected, {found:e} found"));
        }
    }
    Ok(())
}

/// Distances from nothing to beyond the range, and lights that never end.
fn distances() -> Vec<Question> {
    let mut questions = Vec::new();
    for step in 0..256 {
        let distance = (0.001 * 1.06_f64.powi(step) - 0.001) as f32;
        for (range_inverse, least) in [(0.0, MIN_FALLOFF_DISTANCE as f32), (0.1, 0.01), (0.4, 0.5), (20.0, 0.001)] {
            let [distance64, inverse64, least64] = [distance, range_inverse, least].map(f64::from);
            let expected = distance_falloff(distance64, inverse64.recip(), least64);
            // The window is a difference from 1.
            let scale = (distance64 * distance64 + least64 * least64).recip();
            questions.push(Question {
                asked: [distance, range_inverse, least, -1.0],
                expected: [expected, 0.0, 0.0],
                scale,
            });
        }
    }
    questions
}

/// All cosines, for wide and narrow cones, with soft rims and with none.
fn cones() -> Vec<Question> {
    let mut questions = Vec::new();
    for step in -100..=100 {
        for [inner, outer] in [[0.3, 0.7], [0.0, 1.5], [0.8, 0.8], [1.0, 2.5]] {
            let ConeFalloff { scale, offset } = ConeFalloff::from_angles(inner, outer);
            let [cosine, scale, offset] = [0.01 * f64::from(step), scale, offset].map(|value| value as f32);
            let cone = ConeFalloff { scale: scale.into(), offset: offset.into() };
            let expected = [cone.at(cosine.into()), 0.0, 0.0];
            questions.push(Question { asked: [cosine, scale, offset, -2.0], expected, scale: 1.0 + 2.0 * cone.scale });
        }
    }
    questions
}

/// Colours from black to far beyond white, of all hues.
fn colours() -> Vec<Question> {
    let channel = |index: u32| if index == 0 { 0.0 } else { 0.004 * 2.3_f64.powi(index as i32) };
    let mut questions = Vec::new();
    for number in 0..16_u32.pow(3) {
        let asked = [number / 256, number / 16 % 16, number % 16].map(|index| channel(index) as f32);
        let expected = tone_mapped(asked.map(f64::from));
        questions.push(Question { asked: [asked[0], asked[1], asked[2], 0.0], expected, scale: 1.0 });
    }
    questions
}
