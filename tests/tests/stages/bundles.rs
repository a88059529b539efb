//! Views that are tested together: each finds what it finds alone.

use std::collections::BTreeSet;

use contrejour_layout::{BLOCK_BY_POSITIONS, SilhouetteEdge, VIEW_CULLS, VIEW_TESTS, WorkItem, lit_of_seat};
use contrejour_plan::{ShadowSettings, Stage};
use contrejour_tests::chain::{Chain, Fault};
use contrejour_tests::compare::{compare_exact, compare_records};
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, cpu_trial, gpu_trial};
use contrejour_tests::meshes::TestMesh;
use libtest_mimic::Trial;

use crate::parity::{bundle_of, meshes};

/// Bundles with empty seats and without.
const COUNTS: [usize; 4] = [8, 5, 3, 2];

/// Larger meshes than these and all of them together have more blocks than faults need to be found.
const MOST_FACES: usize = 1500;

pub fn trials() -> Vec<Trial> {
    vec![
        cpu_trial("bundles::twins_find_what_each_view_finds_alone", twins_find_what_each_view_finds_alone),
        gpu_trial("bundles::each_view_finds_what_it_finds_alone", |gpu| {
            let cases = Case::all();
            check(&Chain::new(gpu, "detect_silhouette"), &cases)
        }),
        gpu_trial("bundles::seats_that_are_mixed_up_are_found", seats_that_are_mixed_up_are_found),
    ]
}

/// Views that are tested together before the first stage, and what each leaves alone.
struct Case {
    name: String,
    together: Frame,
    alone: Vec<Frame>,
}

impl Case {
    /// Of each bundle the second view sees nothing, and the last one is not tested.
    fn all() -> Vec<Self> {
        let is_tried = |mesh: &TestMesh| mesh.face_count() <= MOST_FACES || mesh.name == "crowd";
        let meshes: Vec<_> = meshes().into_iter().filter(is_tried).collect();
        let cases = meshes.iter().zip(COUNTS.into_iter().cycle()).zip(0_u32..);
        let case = |((mesh, count), index): ((&_, usize), u32)| {
            let views = bundle_of(mesh, count);
            let settings = ShadowSettings::default();
            let change = |frame: &mut Frame, seat: usize, view: usize| {
                let record = &mut frame.bundle.views[seat];
                if view == 1 {
                    record.flags |= VIEW_CULLS;
                    record.reach_ndc = -3.0;
                }
                if view + 1 == views.len() {
                    record.flags &= !VIEW_TESTS;
                    record.edge_block_count = 0;
                }
                // Of some meshes nothing is decided by planes.
                for block in frame.face_blocks.iter_mut().filter(|_| index % 3 == 1) {
                    block.kind = BLOCK_BY_POSITIONS;
                }
            };
            let mut together = Frame::of_bundle(&mesh.parts, &views, &settings);
            (0..views.len()).for_each(|view| change(&mut together, view, view));
            let alone = views.iter().enumerate().map(|(index, view)| {
                let mut alone = Frame::of_view(&mesh.parts, view, &settings);
                change(&mut alone, 0, index);
                alone.run_mirrors("place_casters", "write_extrude_args");
                alone
            });
            Self { name: format!("{} views of {}", views.len(), mesh.name), alone: alone.collect(), together }
        };
        cases.map(case).collect()
    }

    /// What the views of the bundle leave must be what each leaves alone.
    fn compare(&self, found: &Frame) -> Outcome {
        let shape = &found.bundle.shape;
        for (alone, seat) in self.alone.iter().zip(0..) {
            let what = |what: &str| format!("{}, {what} of seat {seat}", self.name);
            let part = |stride: u32, count: usize| (seat * stride) as usize..(seat * stride) as usize + count;
            let casters = part(shape.caster_stride, alone.caster_lights.len());
            compare_exact(&what("caster lights"), &alone.caster_lights, &found.caster_lights[casters])?;
            compare_exact(&what("lit bits"), &alone.lit, &lit_of_seat(&found.lit, shape.seat_count, seat))?;
            let sides = part(shape.outline_stride, alone.outline_sides.len());
            compare_exact(&what("outline sides"), &alone.outline_sides, &found.outline_sides[sides])?;
            let [expected, counted] = [alone.counts(), &found.counters[seat as usize].counts];
            let of_lists = [expected, counted].map(|counts| {
                [counts.casters, counts.face_items, counts.masked_items, counts.edge_items, counts.silhouette_edges]
            });
            compare_exact(&what("counts"), &of_lists[0], &of_lists[1])?;
            let drawn = |items: &[WorkItem]| {
                let items = items[..expected.face_items as usize].iter().map(|item| (item.caster, item.block));
                items.collect::<BTreeSet<_>>()
            };
            let begin = (seat * shape.item_stride) as usize;
            if drawn(&alone.face_items) != drawn(&found.face_items[begin..]) {
                return Err(what("blocks to draw"));
            }
            let count = expected.silhouette_edges as usize;
            let silhouettes: &[SilhouetteEdge] = &found.silhouettes[part(shape.silhouette_stride, count)];
            compare_records(&what("silhouette"), &alone.silhouettes[..count], silhouettes, 0.0)?;
        }
        Ok(())
    }
}

fn twins_find_what_each_view_finds_alone() -> Outcome {
    let (mut near, mut far, mut shared) = (0, 0, 0);
    for case in Case::all() {
        let mut found = case.together.clone();
        found.run_mirrors("place_casters", "write_extrude_args");
        case.compare(&found)?;
        let counts = |frame: &Frame| frame.counts().to_owned();
        let alone: Vec<_> = case.alone.iter().map(counts).collect();
        let together: Vec<_> = found.counters[..alone.len()].iter().map(|counters| counters.counts).collect();
        compare_exact(&format!("{}, all counts", case.name), &alone, &together)?;
        near += found.counters[0].undecided_near;
        far += found.counters[0].undecided_far;
        shared += found.listed_faces().iter().filter(|item| item.seats.count_ones() > 1).count();
    }
    if near > 0 && far > 0 && shared > 0 {
        return Ok(());
    }
    Err(format!("{near} near and {far} far faces, {shared} shared blocks"))
}

fn check(chain: &Chain<'_>, cases: &[Case]) -> Outcome {
    for case in cases {
        let mut found = case.together.clone();
        chain.run(&mut found);
        case.compare(&found)?;
    }
    Ok(())
}

fn seats_that_are_mixed_up_are_found(gpu: &Gpu) -> Outcome {
    let cases = Case::all();
    let mut chain = Chain::new(gpu, "detect_silhouette");
    for fault in &FAULTS {
        if chain.with(fault, |chain| check(chain, &cases)).is_ok() {
            return Err(format!("not found: {fault:?}"));
        }
    }
    // A stage that nobody breaks is one that nobody watches.
    let is_broken = |stage: &Stage| FAULTS.iter().any(|fault| fault.stage() == stage.name());
    match Stage::UP_TO_SILHOUETTES.iter().find(|stage| **stage != Stage::WriteItemArgs && !is_broken(stage)) {
        Some(stage) => Err(format!("no fault in {}", stage.name())),
        None => Ok(()),
    }
}

/// In each list seats that are mixed up, a bit that is lost, a stride that is another.
const FAULTS: [Fault; 28] = [
    replaced("place_casters", "seat = group.z;", "seat = 0u;"),
    replaced("place_casters", "caster_lights[place_of_caster(seat, id)]", "caster_lights[id]"),
    replaced("place_casters", "counters[seat].counts.casters", "counters[0].counts.casters"),
    replaced("list_blocks", "item.kind, tested);", "item.kind, tested & ~1u);"),
    replaced("list_blocks", "item.kind, tested);", "item.kind, tested | 2u);"),
    replaced("list_blocks", "atomicStore(&seat_places[lane], atomicAdd(", "atomicStore(&seat_places[0], atomicAdd("),
    replaced("classify_faces", "light_of(item, by_planes, seat + 1u)", "light_of(item, by_planes, seat + 2u)"),
    replaced("classify_faces", "lights_of(item, by_planes, 4u)", "lights_of(item, by_planes, 0u)"),
    replaced("classify_faces", "first.x << shift;", "first.x << i;"),
    replaced("classify_faces", "last.x << (shift + 4u)", "last.x << shift"),
    replaced("classify_faces", "let tests = face_count * seat_count();", "let tests = face_count;"),
    replaced("classify_faces", "half * seat_count + word] = verdicts.lit", "half + word] = verdicts.lit"),
    replaced("classify_faces", "item.seats & ~by_planes", "0u"),
    replaced("classify_faces", "return seats & item.seats;", "return seats;"),
    replaced("write_recheck_args", "LIT_WORDS_PER_BLOCK << bundle.shape.seat_shift", "LIT_WORDS_PER_BLOCK"),
    replaced("recheck_faces", "let seat = seat_of(test);", "let seat = 0u;"),
    replaced("recheck_faces", "faces[caster.first_face + face_of(test)]", "faces[caster.first_face + test]"),
    replaced("recheck_faces", "lit[first_lit_word(caster) + word.word]", "lit[caster.first_lit_word + word.word]"),
    replaced(
        "write_refine_args",
        "min(counters[0].undecided_far, undecided_capacity())",
        "min(counters[0].counts.undecided_far, undecided_capacity())",
    ),
    replaced("refine_faces", "place_of_caster(seat_of(test),", "place_of_caster(0u,"),
    replaced("refine_faces", "faces[caster.first_face + face_of(test)]", "faces[caster.first_face + test]"),
    replaced("resolve_faces", "place_of_caster(seat_of(test),", "place_of_caster(0u,"),
    replaced("resolve_faces", "undecided_capacity() - 1u - place", "bundle.views[0].undecided_capacity - 1u - place"),
    replaced("detect_silhouette", "find(caster, edge, item.seats)", "find(caster, edge, 255u)"),
    replaced("detect_silhouette", "silhouettes[seat * bundle.shape.silhouette_stride + place]", "silhouettes[place]"),
    replaced("detect_silhouette", "outline_sides[seat * bundle.shape.outline_stride + word]", "outline_sides[word]"),
    replaced(
        "detect_silhouette",
        "lit[first_lit_word(caster) + test / 32u]",
        "lit[caster.first_lit_word + test / 32u]",
    ),
    replaced(
        "detect_silhouette",
        "let sides = count_sides(caster, edge, seat);\n                silhouettes",
        "let sides = count_sides(caster, edge, 0u);\n                silhouettes",
    ),
];

const fn replaced(stage: &'static str, piece: &'static str, fault: &'static str) -> Fault {
    Fault::Replaced { stage, piece, fault }
}
