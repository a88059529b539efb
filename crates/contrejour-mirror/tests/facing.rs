//! The four tiers of facing against exact arithmetic, on random and on hostile faces.

use contrejour_layout::{
    BLOCK_BY_PLANES, BLOCK_BY_POSITIONS, Caster, CasterLight, Face, FaceTest, LightView, RecheckWord, SeatCounters,
    TestItem, ViewBundle,
};
use contrejour_mesh::FacePlanes;
use contrejour_mirror::{ClassifyFaces, RecheckFaces, RefineFaces, ResolveFaces};
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
    by_plane: bool,
    near: u32,
    far: u32,
    lit: bool,
}

/// Buffers of a frame with one face.
struct OneFace {
    casters: [Caster; 1],
    caster_lights: [CasterLight; 1],
    faces: [Face; 1],
    positions: Vec<u32>,
    planes: FacePlanes,
    lit: [u32; 2],
    recheck_words: [RecheckWord; 2],
    undecided: [FaceTest; 1],
    counters: [SeatCounters; 1],
}

fn bundle() -> ViewBundle {
    ViewBundle::of_one(&LightView { face_block_count: 1, undecided_capacity: 1, ..Default::default() })
}

impl OneFace {
    fn new(case: &Case) -> Self {
        let [x, y, z] = case.light.map(f32::to_bits);
        let w = if case.is_point { 1.0_f32 } else { 0.0 };
        let caster_light = CasterLight {
            light_object: [x, y, z, w.to_bits()],
            mirrored: case.mirrored.into(),
            casts: 1,
            ..Default::default()
        };
        let faces = [Face { a: 0, b: 1, c: 2 }];
        Self {
            casters: [Caster { position_stride_words: 3, face_count: 1, ..Default::default() }],
            caster_lights: [caster_light],
            faces,
            positions: case.corners.as_flattened().iter().map(|coordinate| coordinate.to_bits()).collect(),
            planes: FacePlanes::new(&case.corners, &faces),
            lit: [u32::MAX; 2],
            recheck_words: Default::default(),
            undecided: Default::default(),
            counters: [SeatCounters { face_tests: 1, ..SeatCounters::default() }],
        }
    }

    fn classify(&mut self, kind: u32) {
        ClassifyFaces {
            bundle: &bundle(),
            face_tests: &[TestItem { kind, seats: 1, ..Default::default() }],
            casters: &self.casters,
            caster_lights: &self.caster_lights,
            planes: &self.planes.planes,
            lit: &mut self.lit,
            recheck_words: &mut self.recheck_words,
            counters: &mut self.counters,
        }
        .run();
    }

    fn recheck(&mut self) {
        RecheckFaces {
            bundle: &bundle(),
            recheck_words: &self.recheck_words,
            casters: &self.casters,
            caster_lights: &self.caster_lights,
            faces: &self.faces,
            positions: &self.positions,
            lit: &mut self.lit,
            undecided: &mut self.undecided,
            counters: &mut self.counters,
        }
        .run();
    }

    fn refine(&mut self) {
        RefineFaces {
            bundle: &bundle(),
            undecided: &self.undecided,
            counters: &self.counters,
            casters: &self.casters,
            caster_lights: &self.caster_lights,
            faces: &self.faces,
            positions: &self.positions,
            lit: &mut self.lit,
        }
        .run();
    }

    /// Near faces too.
    fn resolve(&mut self) {
        let undecided_far = self.counters[0].undecided_near + self.counters[0].undecided_far;
        ResolveFaces {
            bundle: &bundle(),
            undecided: &self.undecided,
            counters: &[SeatCounters { undecided_far, ..self.counters[0] }],
            casters: &self.casters,
            caster_lights: &self.caster_lights,
            faces: &self.faces,
            positions: &self.positions,
            lit: &mut self.lit,
        }
        .run();
    }
}

fn decide(case: &Case) -> Decision {
    let mut face = OneFace::new(case);
    let fits = face.planes.block_fits(0);
    face.classify(if fits { BLOCK_BY_PLANES } else { BLOCK_BY_POSITIONS });
    let by_plane = face.counters[0].recheck_words == 0;
    face.recheck();
    let undecided = face.lit;
    face.refine();
    let lit = if face.counters[0].undecided_near > 0 { Some(face.lit) } else { None };
    face.lit = undecided;
    face.resolve();
    if let Some(lit) = lit {
        assert_eq!(lit, face.lit, "short and full integers differ on {case:?}");
    }

    // Positions alone decide alike.
    let mut by_positions = OneFace::new(case);
    by_positions.classify(BLOCK_BY_POSITIONS);
    by_positions.recheck();
    by_positions.resolve();
    assert_eq!(face.lit, by_positions.lit, "planes and positions differ on {case:?}");
    let SeatCounters { undecided_near: near, undecided_far: far, .. } = face.counters[0];
    Decision { by_plane, near, far, lit: face.lit[0] == 1 }
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

const BY_PLANE: Decision = Decision { by_plane: true, near: 0, far: 0, lit: false };
const BY_POSITIONS: Decision = Decision { by_plane: false, ..BY_PLANE };

#[test]
fn planes_decide_plain_faces() {
    assert_eq!(decide(&UPRIGHT), Decision { lit: true, ..BY_PLANE });
    assert_eq!(decide(&Case { mirrored: true, ..UPRIGHT }), BY_PLANE);
}

#[test]
fn planes_decide_axis_aligned_edge_on_faces() {
    for mirrored in [false, true] {
        assert_eq!(decide(&Case { light: [0.6, 0.8, 0.0], mirrored, ..UPRIGHT }), BY_PLANE);
    }
}

#[test]
fn positions_decide_where_no_plane_fits() {
    let mut corners = UPRIGHT.corners;
    corners[2][2] = 1e-30;
    let steep = Case { corners, ..UPRIGHT };
    assert_eq!(decide(&steep), Decision { lit: true, ..BY_POSITIONS });
    // So they do under a light whose components lie too far apart.
    let light = [1e-30, 0.0, 1.0];
    assert_eq!(decide(&Case { light, ..UPRIGHT }), Decision { lit: true, ..BY_POSITIONS });
}

#[test]
fn short_integers_decide_close_exponents() {
    let tilted = Case { corners: [[0.0, 0.0, 0.0], [1.0, 2.0, 3.0], [2.0, 1.0, 1.0]], ..UPRIGHT };
    let edge_on = Case { light: [3.0, 3.0, 4.0], ..tilted };
    assert_eq!(decide(&edge_on), Decision { near: 1, ..BY_POSITIONS });
    let above = Case { light: [3.0_f32.next_down(), 3.0, 4.0], ..tilted };
    assert_eq!(decide(&above).lit, is_lit_exactly(&above));
    assert_ne!(decide(&above).lit, decide(&Case { mirrored: true, ..above }).lit);
}

#[test]
fn full_integers_decide_the_smallest_against_the_largest() {
    let hair = Case { light: [f32::MAX, f32::MAX, f32::from_bits(1)], is_point: true, ..UPRIGHT };
    assert_eq!(decide(&hair), Decision { far: 1, lit: true, ..BY_POSITIONS });
}

#[test]
fn a_light_on_a_vertex_is_on_the_plane() {
    for corner in UPRIGHT.corners {
        assert!(!decide(&Case { light: corner, is_point: true, ..UPRIGHT }).lit);
    }
}
