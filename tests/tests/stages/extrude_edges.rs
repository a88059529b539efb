//! Silhouette edges to quads.
//!
//! Where a clip plane or the point tolerance meets an edge to within the rounding of 32-bit floats, the twin and the
//! device may decide differently; such edges are told apart by bounds on that rounding, they are counted, and few. Of
//! all others the same edges must have quads, with equal words and with floats within the bounds.

use std::collections::BTreeMap;

use contrejour_layout::{Counters, OWN_END_HIGH, Quad, VIEW_PANCAKES};
use contrejour_plan::ViewCounts;
use contrejour_tests::ball::Ball;
use contrejour_tests::chain::{Fault, check_each_is_found};
use contrejour_tests::compare::{Record, check_finite};
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, cpu_trial, gpu_trial};
use contrejour_tests::stage_run::StageRun;
use libtest_mimic::Trial;

use crate::outline_balls::{Clip, Image, clip_and_delta, image, ndc_of, q_of, widest_of, width_of};
use crate::parity::{counts_of, for_each_case, for_each_smooth_case, run, stage};

/// Of the edges of all cases together, one in so many may be decided by rounding.
const DECIDED_BY_ROUNDING: usize = 100;

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("extrude_edges::equals_its_twin", equals_its_twin),
        gpu_trial("extrude_edges::counts_past_a_full_list", counts_past_a_full_list),
        gpu_trial("extrude_edges::a_missing_clip_or_count_is_found", |gpu| {
            check_each_is_found(gpu, &FAULTS, compare_with_twin)
        }),
        cpu_trial("extrude_edges::comparer_finds_planted_faults", comparer_finds_planted_faults),
    ]
}

/// The part of an edge that is inside, where that is certain.
struct Clipped {
    low: Clip,
    high: Clip,
    own_low: bool,
    own_high: bool,
}

fn equals_its_twin(gpu: &Gpu) -> Outcome {
    compare_with_twin(gpu, &stage(gpu, "extrude_edges"))
}

/// Clips of an edge that leave it whole, or cut off what casts.
const FAULTS: [Fault; 6] = [
    Fault::Replaced {
        stage: "extrude_edges",
        piece: "clip_by_depth(Span(0.0, 1.0), low_clip, high_clip);",
        fault: "Span(0.0, 1.0);",
    },
    Fault::Replaced {
        stage: "extrude_edges",
        piece: "clip_by_sides(depth_span, low_clip, high_clip, 1.0 + widest_ndc(width));",
        fault: "depth_span;",
    },
    // One that cuts off what reaches into the map of a point light.
    Fault::Replaced { stage: "extrude_edges", piece: "1.0 + widest_ndc(width)", fault: "1.0 + width" },
    // One that cuts off what is in front of a cascade, and one that moves it there.
    Fault::Replaced { stage: "extrude_edges", piece: "if pancakes() {\n        return far;\n    }", fault: "" },
    Fault::Replaced {
        stage: "extrude_edges",
        piece: "clamp(depth_of_clip(clip), least_depth(), view.far_depth)",
        fault: "clamp(depth_of_clip(clip), view.near_depth, view.far_depth)",
    },
    // And an edge whose image is a point that nobody counts.
    Fault::Replaced { stage: "extrude_edges", piece: "atomicAdd(&counters.point_edges, 1u);", fault: "" },
];

fn compare_with_twin(gpu: &Gpu, stage: &StageRun) -> Outcome {
    let (mut quads, mut different) = (0, 0);
    for_each_case("extrude_edges", |case| {
        let mut twin = case.frame.clone();
        let args = twin.extrude_args[0];
        let outputs = run(gpu, stage, &twin, args.x * args.y);
        twin.run_mirror("extrude_edges");
        let counters = counts_of(&outputs);
        let found: Vec<Quad> = outputs.get("quads");
        let found = &found[..counters.quads as usize];
        let expected = &twin.quads[..twin.counts().quads as usize];
        quads += expected.len();

        let by_rounding = compare(&twin, expected, found)?;
        different += by_rounding;
        check_point_edges(&twin, counters.point_edges)?;
        let without = |counters: Counters| Counters { quads: 0, point_edges: 0, ..counters };
        if without(counters) != without(*twin.counts()) {
            return Err(format!("other counters changed: {counters:?}"));
        }
        found.iter().try_for_each(|quad| {
            let floats: Vec<_> = quad.floats().into_iter().map(|(_, float)| float).collect();
            check_finite(&format!("quad of edge {}", quad.edge_id), &floats)
        })
    })?;
    if different > quads / DECIDED_BY_ROUNDING {
        return Err(format!("rounding decides {different} of {quads} quads"));
    }
    Ok(())
}

/// Outline edges whose image is a point on the device: as many as in the twin, but for those where rounding decides,
/// many of which are out of view and have no quad either way.
fn check_point_edges(twin: &Frame, found: u32) -> Outcome {
    let first = twin.begin(twin.bundle.shape.silhouette_stride);
    let silhouettes = &twin.silhouettes[first..][..twin.counts().silhouette_edges as usize];
    let (mut certain, mut possible) = (0, 0);
    for silhouette in silhouettes.iter().filter(|silhouette| silhouette.left == 0 || silhouette.right == 0) {
        let edge = twin.edges[(twin.casters[silhouette.caster as usize].first_edge + silhouette.edge_id) as usize];
        match image(twin, silhouette.caster, edge.low_vertex, edge.high_vertex) {
            Image::Point => certain += 1,
            Image::Either => possible += 1,
            Image::Line(_) => {}
        }
    }
    let expected = certain..=certain + possible;
    for (side, count) in [("the device", found), ("the twin", twin.counts().point_edges)] {
        if !expected.contains(&count) {
            return Err(format!("{count} point edges on {side}, {expected:?} expected"));
        }
    }
    Ok(())
}

/// The number of edges that the two sides treat differently by rounding.
fn compare(frame: &Frame, expected: &[Quad], found: &[Quad]) -> Result<usize, String> {
    let by_key = |quads: &[Quad]| quads.iter().map(|quad| (quad.key(), *quad)).collect::<BTreeMap<_, _>>();
    let (expected_by_key, found_by_key) = (by_key(expected), by_key(found));
    if found_by_key.len() != found.len() {
        return Err("an edge has two quads".into());
    }
    let mut different = 0;
    for (key, quad) in expected_by_key.iter().filter(|(key, _)| !found_by_key.contains_key(*key)) {
        different += may_differ(frame, quad).then_some(1).ok_or(format!("edge {key:?} has no quad"))?;
    }
    for (key, quad) in &found_by_key {
        match expected_by_key.get(key) {
            None => different += may_differ(frame, quad).then_some(1).ok_or(format!("edge {key:?} has a quad"))?,
            Some(expected) => different += usize::from(!are_equal(frame, expected, quad)?),
        }
    }
    Ok(different)
}

fn may_differ(frame: &Frame, quad: &Quad) -> bool {
    clip(frame, quad).is_none()
}

/// Whether two quads of an edge are equal within the bounds of rounding; if not, rounding may decide.
fn are_equal(frame: &Frame, expected: &Quad, found: &Quad) -> Result<bool, String> {
    let differs = |field: &str| format!("{field}: expected {expected:?}, found {found:?}");
    let words = |quad: &Quad| [quad.low_vertex, quad.high_vertex, quad.side];
    if words(expected) != words(found) {
        return Err(differs("words"));
    }
    let Some(Clipped { low, high, own_low, own_high }) = clip(frame, expected) else {
        return Ok(expected.own_ends == found.own_ends);
    };
    if [expected, found].iter().any(|quad| quad.own_ends != u32::from(own_low) | u32::from(own_high) << 1) {
        return Err(differs("own_ends"));
    }
    let check = |field, balls: [Ball; 2], expected: [f32; 2], found: [f32; 2]| {
        let within = (0..2).all(|index| balls[index].allows(expected[index], found[index]));
        within.then_some(()).ok_or_else(|| format!("{} within {balls:?}", differs(field)))
    };
    let q = [q_of(frame.view(), &low), q_of(frame.view(), &high)];
    check("low_ndc", ndc_of(&low), expected.low_ndc, found.low_ndc)?;
    check("high_ndc", ndc_of(&high), expected.high_ndc, found.high_ndc)?;
    check("q", q, expected.q, found.q)?;
    check("width_ndc", q.map(|q| width_of(frame.view(), q)), expected.width_ndc, found.width_ndc)?;
    if let Image::Line(direction) = image(frame, expected.caster, expected.low_vertex, expected.high_vertex) {
        let outward = Ball { value: 0.0, error: direction.error };
        check("outward", [outward; 2], expected.outward, found.outward)?;
    }
    Ok(true)
}

/// Clips like the stage; `None` where rounding may decide something.
fn clip(frame: &Frame, quad: &Quad) -> Option<Clipped> {
    let Image::Line(_) = image(frame, quad.caster, quad.low_vertex, quad.high_vertex) else { return None };
    let (low, delta) = clip_and_delta(frame, quad.caster, quad.low_vertex, quad.high_vertex);
    let (high, _) = clip_and_delta(frame, quad.caster, quad.high_vertex, quad.low_vertex);
    let one = Ball::exact(1.0);
    let mut span = Span { begin: None, end: None };
    if frame.view().flags & VIEW_PANCAKES == 0 {
        span.cut(low[2], high[2])?;
    }
    span.cut(low[3] - low[2], high[3] - high[2])?;
    let (near_end, far_end) = span.ends(&low, &high, &delta);
    let width_at = |clip: &Clip| width_of(frame.view(), q_of(frame.view(), clip));
    let side = one + widest_of(frame.view(), width_at(&near_end).max(width_at(&far_end)));
    for axis in 0..2 {
        span.cut(side * low[3] + low[axis], side * high[3] + high[axis])?;
        span.cut(side * low[3] - low[axis], side * high[3] - high[axis])?;
    }
    if let (Some(begin), Some(end)) = (span.begin.or(Some(Ball::exact(0.0))), span.end.or(Some(one)))
        && (end - begin).sign() != 1
    {
        return None;
    }
    let (low_end, high_end) = span.ends(&low, &high, &delta);
    Some(Clipped { low: low_end, high: high_end, own_low: span.begin.is_none(), own_high: span.end.is_none() })
}

/// Parameters at which an edge is cut off, if it is.
struct Span {
    begin: Option<Ball>,
    end: Option<Ball>,
}

impl Span {
    fn cut(&mut self, low: Ball, high: Ball) -> Option<()> {
        match (low.sign(), high.sign()) {
            (1, 1) => {}
            (-1, 1) => {
                let crossing = low / (low - high);
                self.begin = Some(self.begin.map_or(crossing, |begin| begin.max(crossing)));
            }
            (1, -1) => {
                let crossing = low / (low - high);
                self.end = Some(self.end.map_or(crossing, |end| end.min(crossing)));
            }
            _ => return None,
        }
        Some(())
    }

    fn ends(&self, low: &Clip, high: &Clip, delta: &Clip) -> (Clip, Clip) {
        let at = |t: Ball| [0, 1, 2, 3].map(|row| low[row] + t * delta[row]);
        (self.begin.map_or(*low, at), self.end.map_or(*high, at))
    }
}

fn counts_past_a_full_list(gpu: &Gpu) -> Outcome {
    let stage = stage(gpu, "extrude_edges");
    for_each_case("extrude_edges", |case| {
        let args = case.frame.extrude_args[0];
        let complete = run(gpu, &stage, &case.frame, args.x * args.y);
        let counters = counts_of(&complete);
        let Some(room) = counters.quads.checked_sub(1) else { return Ok(()) };
        let all: Vec<Quad> = complete.get("quads");

        let mut frame = case.frame.clone();
        let silhouettes = frame.view().silhouette_capacity;
        frame.set_room(ViewCounts { quads: room, silhouettes, ..Default::default() });
        frame.silhouettes.clone_from(&case.frame.silhouettes);
        let outputs = run(gpu, &stage, &frame, args.x * args.y);
        if counts_of(&outputs) != counters {
            return Err("the counters depend on the room".into());
        }
        let found: Vec<Quad> = outputs.get("quads");
        if found.iter().all(|quad| all[..counters.quads as usize].contains(quad)) {
            return Ok(());
        }
        Err("a quad is not in the complete list".into())
    })
}

/// Of faults in single quads at least nine in ten are found: the bounds are no excuse for everything.
fn comparer_finds_planted_faults() -> Outcome {
    let faults: [fn(&mut Vec<Quad>, usize); 6] = [
        |quads, index| quads.truncate(index),
        |quads, index| quads[index].low_ndc[0] += 1e-3,
        |quads, index| quads[index].outward[1] += 1e-3,
        |quads, index| quads[index].q[1] *= 1.001,
        |quads, index| quads[index].own_ends ^= OWN_END_HIGH,
        |quads, index| quads[index].width_ndc[1] = f32::NAN,
    ];
    let (mut planted, mut found) = ([0; 6], [0; 6]);
    for_each_smooth_case("build_corners", |case| {
        let expected = &case.frame.quads[..case.frame.counts().quads as usize];
        for (index, fault) in (0..expected.len()).step_by(7).zip((0..faults.len()).cycle()) {
            let mut faulty = expected.to_vec();
            faults[fault](&mut faulty, index);
            planted[fault] += 1;
            found[fault] += usize::from(compare(&case.frame, expected, &faulty) != Ok(0));
        }
        Ok(())
    })?;
    if planted.iter().zip(found).all(|(&planted, found)| planted > 10 && found >= planted * 9 / 10) {
        return Ok(());
    }
    Err(format!("of {planted:?} faults of each kind {found:?} were found"))
}
