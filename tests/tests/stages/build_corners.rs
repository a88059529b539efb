//! Ends of quads to wedges and caps, from the twin's quads.
//!
//! Two directions that are as far apart as the limit below which they count as one, a wedge of exactly half a turn, an
//! edge that is nearly a point: there the twin and the device may decide differently. Such ends are told apart by
//! bounds on the rounding of 32-bit floats, they are counted, and few. All other ends must agree.

use std::collections::BTreeMap;
use std::f64::consts::TAU;

use contrejour_layout::{Corner, Counters, MAX_SEARCHED_VALENCE, OUTLINE_NONE, OWN_END_HIGH, OWN_END_LOW, Quad};
use contrejour_plan::ViewCounts;
use contrejour_tests::compare::{Record, compare_record};
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, cpu_trial, gpu_trial};
use libtest_mimic::Trial;

use crate::outline_balls::{Direction, Image, image};
use crate::parity::{counts_of, for_each_case, for_each_smooth_case, run, stage};

/// Of the ends of all cases together, one in so many may be decided by rounding.
const DECIDED_BY_ROUNDING: usize = 100;

/// Directions closer than this can't be told apart, as a pseudo-angle 1 - cos and as an angle.
const COINCIDENT: f64 = 1e-4;

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("build_corners::equals_its_twin", equals_its_twin),
        gpu_trial("build_corners::counts_past_a_full_list", counts_past_a_full_list),
        cpu_trial("build_corners::comparer_finds_planted_faults", comparer_finds_planted_faults),
    ]
}

fn equals_its_twin(gpu: &Gpu) -> Outcome {
    let stage = stage(gpu, "build_corners");
    let (mut corners, mut different) = (0, 0);
    for_each_case("build_corners", |case| {
        let mut twin = case.frame.clone();
        let args = twin.extrude_args[1];
        let outputs = run(gpu, &stage, &twin, args.x * args.y);
        twin.run_mirror("build_corners");
        let counters = counts_of(&outputs);
        let found: Vec<Corner> = outputs.get("corners");
        let expected = twin.made_corners();
        corners += expected.len();
        different += compare(&twin, expected, &found[..counters.corners as usize])?;
        let without = |counters: Counters| Counters { corners: 0, ..counters };
        if without(counters) == without(*twin.counts()) {
            return Ok(());
        }
        Err(format!("other counters changed: {counters:?}"))
    })?;
    if different > corners / DECIDED_BY_ROUNDING {
        return Err(format!("rounding decides {different} of {corners} corners"));
    }
    Ok(())
}

/// The number of corners that the two sides make differently by rounding.
fn compare(frame: &Frame, expected: &[Corner], found: &[Corner]) -> Result<usize, String> {
    let by_key = |corners: &[Corner]| corners.iter().map(|corner| (corner.key(), *corner)).collect::<BTreeMap<_, _>>();
    let (expected_by_key, found_by_key) = (by_key(expected), by_key(found));
    if found_by_key.len() != found.len() {
        return Err("an end has two corners".into());
    }
    let mut different = 0;
    for quad in frame.made_quads() {
        for (end, vertex) in [(OWN_END_LOW, quad.low_vertex), (OWN_END_HIGH, quad.high_vertex)] {
            let key = [quad.caster, quad.edge_id, vertex];
            let (expected, found) = (expected_by_key.get(&key), found_by_key.get(&key));
            let tolerance = if quad.own_ends & end == 0 { Some(0.0) } else { tolerance(frame, quad, vertex) };
            let same = match (expected, found) {
                (None, None) => Ok(()),
                (Some(expected), Some(found)) => {
                    compare_record("corner", expected, found, tolerance.unwrap_or(2.0) as f32)
                }
                (Some(_), None) => Err(format!("the corner {key:?} is missing")),
                (None, Some(_)) => Err(format!("there is a corner {key:?}")),
            };
            match (same, tolerance) {
                (Err(difference), Some(_)) => return Err(difference),
                (Err(_), None) => different += 1,
                (Ok(()), _) => {}
            }
        }
    }
    Ok(different)
}

/// How far the directions at an end may be apart; `None` where rounding may decide what is built there.
fn tolerance(frame: &Frame, quad: &Quad, vertex: u32) -> Option<f64> {
    let caster = &frame.casters[quad.caster as usize];
    let other = if vertex == quad.low_vertex { quad.high_vertex } else { quad.low_vertex };
    let own = line(frame, quad.caster, vertex, other)?;
    // The twin takes its direction from the quad, which the other end made.
    let from_quad = line(frame, quad.caster, quad.low_vertex, quad.high_vertex)?;
    let mut error = own.error + from_quad.error;

    let offset = (caster.first_vertex_offset_word + vertex) as usize;
    let (first, last) = (frame.vertex_edges[offset], frame.vertex_edges[offset + 1]);
    if last - first > MAX_SEARCHED_VALENCE {
        return Some(4.0 * error);
    }
    let mut angles = Vec::new();
    for index in first..last {
        let word = (caster.first_vertex_edge_word + 2 * index) as usize;
        let (edge_id, other) = (frame.vertex_edges[word], frame.vertex_edges[word + 1]);
        let side_word = frame.outline_sides
            [frame.begin(frame.bundle.shape.outline_stride) + (caster.first_outline_word + edge_id / 16) as usize];
        if edge_id != quad.edge_id && side_word >> (edge_id % 16 * 2) & 3 != OUTLINE_NONE {
            let direction = line(frame, quad.caster, vertex, other)?;
            error = error.max(own.error + from_quad.error + direction.error);
            angles.push((direction.angle - own.angle).rem_euclid(TAU));
        }
    }
    let coincident = (1.0 - COINCIDENT).acos();
    let limits = [coincident, TAU - coincident, TAU / 2.0];
    let near = |a: f64, b: f64| (a - b).abs() <= 2.0 * error + pseudo_angle_error(a);
    let at_a_limit = angles.iter().any(|&angle| limits.iter().any(|&limit| near(angle, limit)));
    angles.sort_by(f64::total_cmp);
    let tied = angles.windows(2).any(|pair| near(pair[0], pair[1]));
    (!at_a_limit && !tied).then_some(4.0 * error)
}

/// Rounding of a pseudo-angle 1 - cos, as an angle: where the cosine is flat a small error is a large angle.
fn pseudo_angle_error(angle: f64) -> f64 {
    1e-6 / angle.sin().abs().max(1e-3)
}

fn line(frame: &Frame, caster: u32, vertex: u32, other: u32) -> Option<Direction> {
    match image(frame, caster, vertex, other) {
        Image::Line(direction) => Some(direction),
        Image::Point | Image::Either => None,
    }
}

fn counts_past_a_full_list(gpu: &Gpu) -> Outcome {
    let stage = stage(gpu, "build_corners");
    for_each_case("build_corners", |case| {
        let args = case.frame.extrude_args[1];
        let complete = run(gpu, &stage, &case.frame, args.x * args.y);
        let counters = counts_of(&complete);
        let Some(room) = counters.corners.checked_sub(1) else { return Ok(()) };
        let all: Vec<Corner> = complete.get("corners");

        let mut frame = case.frame.clone();
        frame.set_room(ViewCounts { corners: room, quads: frame.view().quad_capacity, ..Default::default() });
        frame.quads.clone_from(&case.frame.quads);
        let outputs = run(gpu, &stage, &frame, args.x * args.y);
        if counts_of(&outputs) != counters {
            return Err("the counters depend on the room".into());
        }
        let found: Vec<Corner> = outputs.get("corners");
        if found.iter().all(|corner| all[..counters.corners as usize].contains(corner)) {
            return Ok(());
        }
        Err("a corner is not in the complete list".into())
    })
}

/// Of faults in single corners at least nine in ten are found: the bounds are no excuse for everything.
fn comparer_finds_planted_faults() -> Outcome {
    let faults: [fn(&mut Vec<Corner>, usize); 5] = [
        |corners, index| corners.truncate(index),
        |corners, index| corners[index].begin[0] += 1e-2,
        |corners, index| corners[index].end[1] += 1e-2,
        |corners, index| corners[index].kind ^= 1,
        |corners, index| corners[index].middle[1] = f32::NAN,
    ];
    let (mut planted, mut found) = ([0; 5], [0; 5]);
    for_each_smooth_case("build_corners", |case| {
        let mut twin = case.frame.clone();
        twin.run_mirror("build_corners");
        let expected = twin.made_corners();
        for (index, fault) in (0..expected.len()).step_by(7).zip((0..faults.len()).cycle()) {
            let mut faulty = expected.to_vec();
            faults[fault](&mut faulty, index);
            planted[fault] += 1;
            found[fault] += usize::from(compare(&twin, expected, &faulty) != Ok(0));
        }
        Ok(())
    })?;
    if planted.iter().zip(found).all(|(&planted, found)| planted > 10 && found >= planted * 9 / 10) {
        return Ok(());
    }
    Err(format!("of {planted:?} faults of each kind {found:?} were found"))
}
