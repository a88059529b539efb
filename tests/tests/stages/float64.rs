//! Products and sums of 64-bit floats by integers, bit by bit.

use bytemuck::{Pod, Zeroable, cast_slice};
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::planted::check_each_is_found;
use contrejour_tests::random::Random;
use contrejour_tests::stage_run::StageRun;
use libtest_mimic::Trial;

const WGSL: &str = concat!(
    "@group(0) @binding(0) var<storage, read> numbers: array<vec2u>;
@group(0) @binding(1) var<storage, read_write> results: array<Float64>;

@compute @workgroup_size(64)
fn calculate(@builtin(global_invocation_id) id: vec3u) {
    let x = float64(numbers[2u * id.x]);
    let y = float64(numbers[2u * id.x + 1u]);
    results[2u * id.x] = product(x, y);
    results[2u * id.x + 1u] = sum(x, y);
}
",
    include_str!("../../../shaders/shared/float64.wgsl"),
    include_str!("../../../shaders/shared/wide_integer.wgsl"),
);

/// A piece of the text, and a fault.
const FAULTS: [(&str, &str); 6] = [
    ("rest == HALF_UNIT && (mantissa.x & UNIT) != 0u", "rest == HALF_UNIT"),
    ("rest > HALF_UNIT ||", "rest > HALF_UNIT + 1u ||"),
    ("vec2u(low | trace, high)", "vec2u(low, high)"),
    ("let trace = u32(x.x << (32u - bits) != 0u);", "let trace = 0u;"),
    ("x.y >> (bits - 32u) | u32((x.x | lost_high) != 0u)", "x.y >> (bits - 32u)"),
    ("if high.y == 1u {", "if high.y == 2u {"),
];

const PAIRS: usize = 64 * 2048;

#[repr(C)]
#[derive(Clone, Copy, Debug, PartialEq, Pod, Zeroable)]
struct Float64 {
    sign: u32,
    exponent: i32,
    mantissa: [u32; 2],
}

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("float64::equals_the_cpu", |gpu| check(gpu, WGSL)),
        gpu_trial("float64::a_wrong_rounding_is_found", a_wrong_rounding_is_found),
    ]
}

fn a_wrong_rounding_is_found(gpu: &Gpu) -> Outcome {
    check_each_is_found(WGSL, &FAULTS, |wgsl| check(gpu, wgsl))
}

fn check(gpu: &Gpu, wgsl: &str) -> Outcome {
    let mut random = Random::new(21);
    let numbers: Vec<[f64; 2]> = (0..PAIRS).map(|index| pair(&mut random, index)).collect();
    let results = vec![Float64::zeroed(); 2 * PAIRS];
    let inputs: [(&str, &[u8]); 2] = [("numbers", cast_slice(&numbers)), ("results", cast_slice(&results))];
    let outputs = StageRun::new(gpu, wgsl, "calculate").run(gpu, [PAIRS as u32 / 64, 1, 1], &inputs);
    let results: Vec<Float64> = outputs.get("results");
    for ([x, y], found) in numbers.iter().zip(results.chunks_exact(2)) {
        for (operation, expected, found) in [("product", x * y, found[0]), ("sum", x + y, found[1])] {
            if value(&found) != Some(expected) {
                return Err(format!("{operation} of {x:e} and {y:e} is {expected:e}, found {found:?}"));
            }
        }
    }
    Ok(())
}

/// The smaller one ends half a unit below the larger one's last digit, but for what lies still lower.
fn nearly_tied(random: &mut Random) -> [f64; 2] {
    let shift = 12 + random.below(43);
    let mut mantissa = || random.bits() >> 11 | 1 << 52;
    let (larger, smaller) = (mantissa(), mantissa());
    let half = 1 << shift;
    let smaller = if half < 1 << 52 { smaller & !(2 * half - half / 1024) | half } else { smaller };
    [larger as f64 * 2.0_f64.powi(shift as i32 + 1), smaller as f64]
}

/// Few digits, so that ties are many; exponents near each other or far apart; now and then nearly the negative.
fn pair(random: &mut Random, index: usize) -> [f64; 2] {
    let mut number = |spread: i32| {
        let digits = [20, 26, 27, 40, 52][random.below(5)];
        let mantissa = random.bits() >> (64 - digits) | 1 << digits;
        let exponent = random.below(2 * spread as usize + 1) as i32 - spread;
        random.signed().signum() * mantissa as f64 * 2.0_f64.powi(exponent - digits)
    };
    match index % 8 {
        0 => [number(400), number(400)],
        // All digits are ones, so that rounding up carries through them.
        1 => {
            let x = f64::from_bits(number(40).to_bits() | ((1 << 52) - 1));
            [x, x * f64::EPSILON / 2.0]
        }
        2 => {
            let x = number(100);
            [x, -x * (1.0 + f64::EPSILON)]
        }
        3 => {
            let x = number(100);
            [x, -x]
        }
        4 => [number(3), 0.0],
        5 => nearly_tied(random),
        _ => [number(40), number(40)],
    }
}

/// None where the mantissa has not the form that it must have.
fn value(float: &Float64) -> Option<f64> {
    let mantissa = u64::from(float.mantissa[1]) << 32 | u64::from(float.mantissa[0]);
    if mantissa == 0 {
        return Some(0.0);
    }
    let is_normal = mantissa >> 63 == 1 && mantissa & 0x7ff == 0;
    let sign = if float.sign == 0 { 1.0 } else { -1.0 };
    is_normal.then(|| sign * (mantissa >> 11) as f64 * 2.0_f64.powi(float.exponent + 11))
}
