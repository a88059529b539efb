//! The light and its clip space in each caster's space, bit by bit, and who is left out.

use contrejour_layout::{CASTER_IN_VIEW, CasterLight, SeatCounters, VIEW_CULLS, ViewBundle};
use contrejour_plan::{
    CastersInFront, NearOne, ObjectBox, Projection, ShadowSettings, View, caster_light, caster_place, views,
};
use contrejour_tests::chain::{Fault, check_each_is_found};
use contrejour_tests::compare::compare_exact;
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::lights::{cascades, lights};
use contrejour_tests::meshes::shapes;
use contrejour_tests::object_light::ObjectLight;
use contrejour_tests::random::Random;
use contrejour_tests::stage_run::StageRun;
use glam::{DMat4, DQuat, DVec3};
use libtest_mimic::Trial;

use crate::parity::{for_each_case, run_for_seats, stage};

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("place_casters::equals_its_twin", equals_its_twin),
        gpu_trial("place_casters::rounds_once_from_64_bits", |gpu| rounds_once(gpu, &stage(gpu, "place_casters"))),
        gpu_trial("place_casters::a_wrong_digit_is_found", |gpu| check_each_is_found(gpu, &WRONG_DIGITS, rounds_once)),
        gpu_trial("place_casters::leaves_out_what_no_view_sees", |gpu| culls(gpu, &stage(gpu, "place_casters"))),
        gpu_trial("place_casters::a_wrong_side_is_found", |gpu| check_each_is_found(gpu, &WRONG_SIDES, culls)),
    ]
}

/// Roundings that go wrong.
const WRONG_DIGITS: [Fault; 2] = [
    replaced("(mantissa.x != 0u || (kept & 1u) == 1u)", "(kept & 1u) == 1u"),
    replaced("along = sum(along, negative(", "along = sum(along, ("),
];

/// Casters that are left out, or are not, at the wrong place.
const WRONG_SIDES: [Fault; 5] = [
    replaced("let side = 1.0 + bundle.views[seat].reach_ndc;", "let side = 1.0;"),
    replaced("|| is_beyond(id, matrix, vec4f(-1.0, 0.0, 0.0, side))", ""),
    replaced("dot(normal, middle) + dot(abs(normal), half_size)", "dot(normal, middle)"),
    // Cascades have no front, and others have one.
    replaced("let has_front = (bundle.views[seat].flags & VIEW_PANCAKES) == 0u;", "let has_front = true;"),
    replaced("let has_front = (bundle.views[seat].flags & VIEW_PANCAKES) == 0u;", "let has_front = false;"),
];

const fn replaced(piece: &'static str, fault: &'static str) -> Fault {
    Fault::Replaced { stage: "place_casters", piece, fault }
}

fn equals_its_twin(gpu: &Gpu) -> Outcome {
    let stage = stage(gpu, "place_casters");
    let mut left_out = 0;
    for_each_case("place_casters", |case| {
        for culls in [0, VIEW_CULLS] {
            let mut frame = case.frame.clone();
            // Every other view of a bundle culls.
            for view in frame.bundle.views.iter_mut().step_by(2) {
                view.flags = view.flags & !VIEW_CULLS | culls;
            }
            compare(gpu, &stage, &mut frame)?;
            let views = frame.bundle.views.iter().zip(&frame.counters);
            left_out += views.map(|(view, counters)| view.caster_count - counters.counts.casters).sum::<u32>();
        }
        Ok(())
    })?;
    if left_out > 20 { Ok(()) } else { Err(format!("only {left_out} casters are left out")) }
}

/// Runs both on a frame, and leaves what the twin says.
fn compare(gpu: &Gpu, stage: &StageRun, frame: &mut Frame) -> Outcome {
    let outputs = run_for_seats(gpu, stage, frame, frame.view().caster_count.div_ceil(64));
    frame.run_mirror("place_casters");
    compare_exact("caster_lights", &frame.caster_lights, &outputs.get::<CasterLight>("caster_lights"))?;
    compare_exact("counters", &frame.counters, &outputs.get::<SeatCounters>("counters"))
}

/// A frame of casters without meshes.
fn frame_of(view: &View, places: impl Iterator<Item = (DMat4, NearOne)>) -> (Frame, Vec<CasterLight>) {
    let mut frame = Frame::empty();
    let mut expected = Vec::new();
    for (world_from_object, near_one) in places {
        frame.caster_places.push(caster_place(&world_from_object, &near_one, None));
        expected.push(without_signs_of_zeros(caster_light(view, &world_from_object, &near_one)));
    }
    frame.bundle = ViewBundle::of_one(&view.light_view(&ShadowSettings::default(), &Default::default()));
    frame.bundle.views[0].caster_count = expected.len() as u32;
    frame.caster_lights = vec![CasterLight::default(); expected.len()];
    (frame, expected)
}

fn without_signs_of_zeros(light: CasterLight) -> CasterLight {
    let unsigned = |bits: u32| if bits << 1 == 0 { 0 } else { bits };
    CasterLight {
        light_object: light.light_object.map(unsigned),
        light_clip_from_object: light.light_clip_from_object.map(|entry| f32::from_bits(unsigned(entry.to_bits()))),
        ..light
    }
}

/// Equal to what 64-bit floats of the CPU make of it, for matrices and lights of all sizes.
fn rounds_once(gpu: &Gpu, stage: &StageRun) -> Outcome {
    let mut random = Random::new(11);
    let mut checked = 0;
    for mesh in shapes() {
        for light in lights(&mesh) {
            let view = views(&light).map_err(|error| error.to_string())?[0];
            let places = (0..200).map(|index| place(&mut random, index)).collect::<Vec<_>>();
            checked += check_rounding(gpu, stage, &view, &places)?;
        }
    }
    // Lights whose numbers are as far apart as the type allows, in spaces that keep them as they are.
    for index in 0..300 {
        let numbers = [(); 3].map(|()| random.any_finite());
        let light_object = [numbers[0], numbers[1], numbers[2], (index % 2) as f32];
        let light = ObjectLight { light_object, mirrored: index % 3 == 0 };
        if let Ok(views) = views(&light.light()) {
            checked += check_rounding(gpu, stage, &views[0], &[(light.world_from_object(), NearOne::IDENTITY)])?;
        }
    }
    if checked > 10_000 { Ok(()) } else { Err(format!("only {checked} casters cast")) }
}

fn check_rounding(gpu: &Gpu, stage: &StageRun, view: &View, places: &[(DMat4, NearOne)]) -> Result<u32, String> {
    let (mut frame, expected) = frame_of(view, places.iter().copied());
    compare(gpu, stage, &mut frame)?;
    compare_exact("caster_lights", &expected, &frame.caster_lights)?;
    Ok(frame.counts().casters)
}

fn place(random: &mut Random, index: usize) -> (DMat4, NearOne) {
    let mut vector = || DVec3::new(random.signed(), random.signed(), random.signed());
    let size = [1.0, 1e-3, 1e6, 1e-25, 1e25, 1e-40][index % 6];
    let far = [0.0, 1.0, 1e7][index / 6 % 3];
    let turn = if index.is_multiple_of(5) {
        DQuat::IDENTITY
    } else {
        DQuat::from_rotation_arc(DVec3::Y, vector().normalize())
    };
    let scale = size * (1.0 + 0.5 * vector());
    let matrix = DMat4::from_scale_rotation_translation(scale, turn, far * vector());
    let origin = (1e3 * vector()).as_vec3().to_array();
    (matrix, NearOne { origin, scale: 2.0_f32.powi(index as i32 % 40 - 20) })
}

/// Boxes all around a view: those that the CPU sees are seen, and of the others hardly any.
fn culls(gpu: &Gpu, stage: &StageRun) -> Outcome {
    let mut random = Random::new(12);
    let (mut seen, mut unseen, mut in_front) = (0, 0, 0);
    let settings = ShadowSettings::default();
    for mesh in shapes() {
        let of_lights = lights(&mesh).into_iter().map(|light| views(&light).expect("good lights")[0]);
        for view in of_lights.chain(cascades(&mesh)) {
            let boxes: Vec<_> = (0..100).map(|_| random_box(&view, &mut random)).collect();
            let (mut frame, _) =
                frame_of(&view, boxes.iter().map(|bounds| (bounds.world_from_object, NearOne::IDENTITY)));
            for (place, bounds) in frame.caster_places.iter_mut().zip(&boxes) {
                let bounded = Some([bounds.min, bounds.max]);
                *place = caster_place(&bounds.world_from_object, &NearOne::IDENTITY, bounded);
            }
            let outputs = run_for_seats(gpu, stage, &frame, frame.view().caster_count.div_ceil(64));
            let found = outputs.get::<CasterLight>("caster_lights");
            let reach_ndc = view.reach_ndc(&settings);
            for ((light, bounds), place) in found.iter().zip(&boxes).zip(&frame.caster_places) {
                if place.casts != CASTER_IN_VIEW || light.casts == 1 && light.light_object == [0; 4] {
                    return Err(format!("{bounds:?} has a place: {place:?}"));
                }
                match light.casts {
                    0 if view.can_see(&grown(bounds, -NEARLY), reach_ndc) => {
                        return Err(format!("left out: {bounds:?}"));
                    }
                    1 if !view.can_see(&grown(bounds, NEARLY), reach_ndc) => return Err(format!("kept: {bounds:?}")),
                    1 if view.casters_in_front == CastersInFront::Pancaked => {
                        in_front += u32::from(is_in_front(&view, bounds));
                    }
                    0 => unseen += 1,
                    _ => seen += 1,
                }
            }
        }
    }
    if seen > 500 && unseen > 500 && in_front > 50 {
        return Ok(());
    }
    Err(format!("{seen} boxes are seen, {in_front} of them in front of cascades, {unseen} are not"))
}

/// Whether all of a box is nearer to the light than a view's nearest depth.
fn is_in_front(view: &View, bounds: &ObjectBox) -> bool {
    let clipped = View { casters_in_front: CastersInFront::Clipped, ..*view };
    !clipped.can_see(bounds, 1e6)
}

/// What a box may be larger or smaller by, as a share of its size, before it counts as seen or unseen.
const NEARLY: f32 = 2e-2;

fn grown(bounds: &ObjectBox, share: f32) -> ObjectBox {
    let grow = |axis: usize| share * (bounds.max[axis] - bounds.min[axis]);
    let min = [0, 1, 2].map(|axis| bounds.min[axis] - grow(axis));
    let max = [0, 1, 2].map(|axis| bounds.max[axis] + grow(axis));
    ObjectBox { min, max, ..*bounds }
}

/// Anywhere in the frustum or beside it, small or large.
fn random_box(view: &View, random: &mut Random) -> ObjectBox {
    let [x, y] = [(); 2].map(|()| 1.6 * random.signed());
    let depth = view.near_depth + (0.5 + 0.8 * random.signed()) * (view.far_depth - view.near_depth);
    let ndc = DVec3::new(x, y, view.q_of_depth(depth) * view.ndc_scale() + view.ndc_offset());
    let middle = view.light_clip_from_world.inverse().project_point3(ndc);
    let half_side = view.half_side * if view.projection == Projection::Perspective { depth } else { 1.0 };
    let size = 10.0_f64.powf(random.signed() - 1.5) * half_side;
    let [min, max] = [-1.0, 1.0].map(|sign| [(); 3].map(|()| (sign * (0.1 + random.signed().abs())) as f32));
    let turn = DQuat::from_rotation_arc(DVec3::Y, DVec3::new(random.signed(), random.signed(), 1.0).normalize());
    let world_from_object = DMat4::from_scale_rotation_translation(DVec3::splat(size), turn, middle);
    ObjectBox { min, max, world_from_object }
}
