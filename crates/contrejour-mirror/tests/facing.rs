//! The three tiers of facing against exact arithmetic, on random and on hostile faces.

use contrejour_layout::{Caster, CasterLight, Counters, Face, FaceRef, LightView, WorkItem};
use contrejour_mirror::{ClassifyFaces, RefineFaces, ResolveFaces};
use num_bigint::{BigInt, Sign};
use proptest::prelude::*;

type Vector = [f32; 3];

/// One face before one light.
#[derive(Clone, Copy, Debug)]
struct Case {
    corners: [Vector; 3],
    light: Vector,
    is_point: bool,
    mirrored: bool,
}

/// Where a case was decided, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Decision {
    near: u32,
    far: u32,
    lit: bool,
}

fn decide(case: &Case) -> Decision {
    let view = LightView { face_item_count: 1, undecided_capacity: 1, ..Default::default() };
    let casters = [Caster { position_stride_words: 3, face_count: 1, ..Default::default() }];
    let [x, y, z] = case.light.map(f32::to_bits);
    let w = if case.is_point { 1.0_f32 } else { 0.0 };
    let caster_lights = [CasterLight {
        light_object: [x, y, z, w.to_bits()],
        mirrored: case.mirrored.into(),
        casts: 1,
        ..Default::default()
    }];
    let faces = [Face { a: 0, b: 1, c: 2 }];
    let positions: Vec<u32> = case.corners.as_flattened().iter().map(|coordinate| coordinate.to_bits()).collect();
    let mut lit = [u32::MAX; 2];
    let mut undecided = [FaceRef::default()];
    let mut counters = Counters::default();
    ClassifyFaces {
        view: &view,
        face_items: &[WorkItem { caster: 0, block: 0 }],
        casters: &casters,
        caster_lights: &caster_lights,
        faces: &faces,
        positions: &positions,
        lit: &mut lit,
        undecided: &mut undecided,
        counters: &mut counters,
    }
    .run();
    // The other tier decides an undecided near face too.
    let mut lit_by_full_integers = lit;
    let all_far = Counters { undecided_far: counters.undecided_near + counters.undecided_far, ..counters };
    ResolveFaces {
        view: &view,
        undecided: &undecided,
        counters: &all_far,
        casters: &casters,
        caster_lights: &caster_lights,
        faces: &faces,
        positions: &positions,
        lit: &mut lit_by_full_integers,
    }
    .run();
    RefineFaces {
        view: &view,
        undecided: &undecided,
        counters: &counters,
        casters: &casters,
        caster_lights: &caster_lights,
        faces: &faces,
        positions: &positions,
        lit: &mut lit,
    }
    .run();
    if counters.undecided_far == 0 {
        assert_eq!(lit, lit_by_full_integers, "short and full integers differ on {case:?}");
    }
    Decision { near: counters.undecided_near, far: counters.undecided_far, lit: lit_by_full_integers[0] == 1 }
}

fn is_lit_exactly(case: &Case) -> bool {
    let [a, b, c] = case.corners.map(|corner| corner.map(integer));
    let origin = if case.is_point { a.clone() } else { [0.0; 3].map(integer) };
    let minus = |x: &[BigInt; 3], y: &[BigInt; 3]| -> [BigInt; 3] { std::array::from_fn(|i| &x[i] - &y[i]) };
    let (p, q, r) = (minus(&b, &a), minus(&c, &a), minus(&case.light.map(integer), &origin));
    let determinant: BigInt =
        [(0, 1, 2), (1, 2, 0), (2, 0, 1)].iter().map(|&(x, y, z)| &p[x] * (&q[y] * &r[z] - &q[z] * &r[y])).sum();
    determinant.sign() == if case.mirrored { Sign::Minus } else { Sign::Plus }
}

/// A finite `f32` times 2^149.
fn integer(value: f32) -> BigInt {
    let mut rest = f64::from(value) * 149_f64.exp2();
    let mut shift = 0;
    while rest.abs() >= 53_f64.exp2() {
        rest /= 2.0;
        shift += 1;
    }
    BigInt::from(rest as i64) << shift
}

fn check(case: &Case) -> Result<(), TestCaseError> {
    let decision = decide(case);
    prop_assert_eq!(decision.lit, is_lit_exactly(case), "{:?} {:?}", decision, case);
    Ok(())
}

fn any_finite() -> BoxedStrategy<f32> {
    any::<u32>().prop_map(f32::from_bits).prop_filter("finite", |value| value.is_finite()).boxed()
}

fn subnormal() -> BoxedStrategy<f32> {
    any::<u32>().prop_map(|bits| f32::from_bits(bits & 0x80ff_ffff)).boxed()
}

fn mixed() -> BoxedStrategy<f32> {
    prop_oneof![
        any_finite(),
        subnormal(),
        common(),
        small_integer(),
        Just(0.0),
        Just(-0.0),
        Just(f32::MAX),
        Just(-f32::MAX),
    ]
    .boxed()
}

fn common() -> BoxedStrategy<f32> {
    (-1.0_f32..1.0).boxed()
}

/// Products of two or three of them underflow.
fn underflowing() -> BoxedStrategy<f32> {
    (-1.0_f32..1.0, -66..-38_i32).prop_map(|(value, exponent)| value * (exponent as f32).exp2()).boxed()
}

fn small_integer() -> BoxedStrategy<f32> {
    (-4..5_i8).prop_map(f32::from).boxed()
}

fn vector(coordinate: BoxedStrategy<f32>) -> BoxedStrategy<Vector> {
    [coordinate.clone(), coordinate.clone(), coordinate].boxed()
}

fn case(coordinate: BoxedStrategy<f32>) -> impl Strategy<Value = Case> {
    let corner = vector(coordinate);
    ([corner.clone(), corner.clone(), corner.clone()], corner, any::<bool>(), any::<bool>())
        .prop_map(|(corners, light, is_point, mirrored)| Case { corners, light, is_point, mirrored })
}

/// Moves the third corner to `a + s (b - a) + t (light - a)`, which is in the light's plane but for rounding, and then
/// some steps of the last place away.
fn near_plane(case: Case, s: f64, t: f64, steps: [i32; 3]) -> Case {
    let [a, b, _] = case.corners;
    let c = std::array::from_fn(|i| {
        let origin = if case.is_point { a[i] } else { 0.0 };
        let along_edge = s * (f64::from(b[i]) - f64::from(a[i]));
        let along_light = t * (f64::from(case.light[i]) - f64::from(origin));
        let exact = (f64::from(a[i]) + along_edge + along_light) as f32;
        let moved = f32::from_bits((exact.to_bits() as i32).wrapping_add(steps[i]) as u32);
        if moved.is_finite() { moved } else { a[i] }
    });
    Case { corners: [a, b, c], ..case }
}

fn case_near_plane(coordinate: BoxedStrategy<f32>) -> impl Strategy<Value = Case> {
    let weight = || prop_oneof![Just(0.0), Just(0.5), Just(1.0), Just(-2.0), -2.0_f64..2.0];
    let steps = prop_oneof![Just([0; 3]), [-3..4_i32, -3..4_i32, -3..4_i32]];
    (case(coordinate), weight(), weight(), steps).prop_map(|(case, s, t, steps)| near_plane(case, s, t, steps))
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn random_bit_patterns(case in case(any_finite())) { check(&case)?; }

    #[test]
    fn subnormal_coordinates(case in case(subnormal())) { check(&case)?; }

    #[test]
    fn mixed_exponents(case in case(mixed())) { check(&case)?; }

    #[test]
    fn small_integers(case in case(small_integer())) { check(&case)?; }

    #[test]
    fn near_the_plane_of_common_numbers(case in case_near_plane(common())) { check(&case)?; }

    #[test]
    fn near_the_plane_of_small_integers(case in case_near_plane(small_integer())) { check(&case)?; }

    #[test]
    fn near_the_plane_of_subnormals(case in case_near_plane(subnormal())) { check(&case)?; }

    #[test]
    fn near_the_plane_of_underflowing_numbers(case in case_near_plane(underflowing())) { check(&case)?; }

    #[test]
    fn near_the_plane_of_anything(case in case_near_plane(mixed())) { check(&case)?; }
}

const UPRIGHT: Case = Case {
    corners: [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
    light: [0.0, 0.0, 1.0],
    is_point: false,
    mirrored: false,
};

#[test]
fn floats_decide_plain_faces() {
    assert_eq!(decide(&UPRIGHT), Decision { near: 0, far: 0, lit: true });
    assert_eq!(decide(&Case { mirrored: true, ..UPRIGHT }), Decision { near: 0, far: 0, lit: false });
}

#[test]
fn axis_aligned_edge_on_faces_need_no_integers() {
    let edge_on = Case { light: [0.6, 0.8, 0.0], ..UPRIGHT };
    assert_eq!(decide(&edge_on), Decision { near: 0, far: 0, lit: false });
}

#[test]
fn short_integers_decide_close_exponents() {
    let tilted = Case { corners: [[0.0, 0.0, 0.0], [1.0, 2.0, 3.0], [2.0, 1.0, 1.0]], ..UPRIGHT };
    let edge_on = Case { light: [3.0, 3.0, 4.0], ..tilted };
    assert_eq!(decide(&edge_on), Decision { near: 1, far: 0, lit: false });
    let above = Case { light: [3.0_f32.next_down(), 3.0, 4.0], ..tilted };
    assert_eq!(decide(&above).lit, is_lit_exactly(&above));
    assert_ne!(decide(&above).lit, decide(&Case { mirrored: true, ..above }).lit);
}

#[test]
fn full_integers_decide_the_smallest_against_the_largest() {
    let hair = Case { light: [f32::MAX, f32::MAX, f32::from_bits(1)], is_point: true, ..UPRIGHT };
    assert_eq!(decide(&hair), Decision { near: 0, far: 1, lit: true });
}

#[test]
fn a_light_on_a_vertex_is_on_the_plane() {
    for corner in UPRIGHT.corners {
        assert!(!decide(&Case { light: corner, is_point: true, ..UPRIGHT }).lit);
    }
}
