//! The frames that the stages are compared on, and one stage on the device.

use contrejour_layout::{Counters, SeatCounters};
use contrejour_plan::{CubeFace, Light, ShadowSettings, Stage, View, frame_views};
use contrejour_tests::chain::wgsl_of;
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::Outcome;
use contrejour_tests::lights::{cascades, lamps, lights};
use contrejour_tests::meshes::{TestMesh, TestPart, shapes, shared_named, tiny};
use contrejour_tests::random::Random;
use contrejour_tests::stage_run::{Outputs, StageRun};
use glam::{DMat4, DQuat, DVec3};

/// Files of the shared folder with many kinds of edges and few enough faces for the exact tiers on a CPU.
const FILES: [&str; 9] = [
    "nasty/moebius.obj",
    "nasty/triple_vierbein.obj",
    "nasty/wallhole.obj",
    "nasty/box_longline.obj",
    "nasty/deg_faces.obj",
    "nasty/hollowcube.obj",
    "nasty/Offset1.obj",
    "nasty/dragon_vrip_res4.ply",
    "animated/RiggedFigure.glb",
];

/// Faces of the cubes around lamps.
const LAMP_FACES: [CubeFace; 2] = [CubeFace::NegativeX, CubeFace::NegativeY];

/// Views that are tested together, for one mesh after the other: with empty seats and without.
const BUNDLES: [usize; 5] = [8, 2, 5, 4, 3];

/// One mesh or many under one light or several, before the first stage.
pub struct Case {
    /// Mesh and light, for messages.
    pub name: String,
    /// Its buffers.
    pub frame: Frame,
}

/// Calls `check` for each mesh and light with a frame on which the stages before `stage` have run on the CPU.
pub fn for_each_case(stage: &str, check: impl FnMut(&Case) -> Outcome) -> Outcome {
    for_each_case_of(&meshes(), stage, check)
}

/// The same for smooth meshes alone, whose outlines rounding hardly touches.
pub fn for_each_smooth_case(stage: &str, check: impl FnMut(&Case) -> Outcome) -> Outcome {
    let mut meshes = shapes();
    meshes.retain(|mesh| ["torus", "knot"].contains(&mesh.name.as_str()));
    for_each_case_of(&meshes, stage, check)
}

fn for_each_case_of(meshes: &[TestMesh], stage: &str, mut check: impl FnMut(&Case) -> Outcome) -> Outcome {
    let mut check_views = |mesh: &TestMesh, name: String, views: &[View]| {
        let frame = Frame::of_bundle(&mesh.parts, views, &ShadowSettings::default());
        let mut case = Case { name: format!("{}, {name}", mesh.name), frame };
        // The stages of one view work on the last one, and each view is drawn from the lists of its own.
        let of_bundle = |stage: &str| Stage::UP_TO_SILHOUETTES.iter().any(|known| known.name() == stage);
        if of_bundle(stage) {
            case.frame.run_mirrors("place_casters", stage);
        } else {
            case.frame.run_mirrors("place_casters", "write_extrude_args");
            case.frame.seat = views.len() - 1;
            case.frame.run_mirrors("write_extrude_args", stage);
        }
        check(&case).map_err(|difference| format!("{}: {difference}", case.name))
    };
    let mut bundles = BUNDLES.into_iter().cycle();
    for mesh in meshes {
        let step = if mesh.face_count() > 500 { 6 } else { 3 };
        for (index, light) in lights(mesh).iter().enumerate().step_by(step) {
            check_views(mesh, format!("light {index}"), &of_light(light)[..1])?;
        }
        for (index, lamp) in lamps(mesh).iter().enumerate() {
            // Two faces of the cube that the mesh lies on.
            for face in LAMP_FACES {
                check_views(mesh, format!("lamp {index}, {face:?}"), &[of_light(lamp)[face.index()]])?;
            }
        }
        for (index, view) in cascades(mesh).iter().enumerate().skip(1).step_by(2) {
            check_views(mesh, format!("cascade {index}"), &[*view])?;
        }
        let count = bundles.next().unwrap_or(1);
        check_views(mesh, format!("a bundle of {count}"), &bundle_of(mesh, count))?;
    }
    Ok(())
}

/// So many views of lights of all kinds, of a mesh.
pub fn bundle_of(mesh: &TestMesh, count: usize) -> Vec<View> {
    let mut views: Vec<_> = lights(mesh).iter().map(|light| of_light(light)[0]).collect();
    views.extend(lamps(mesh).iter().map(|lamp| of_light(lamp)[LAMP_FACES[0].index()]));
    views.extend(cascades(mesh));
    let step = (views.len() / count).max(1);
    views.into_iter().step_by(step).take(count).collect()
}

fn of_light(light: &Light) -> Vec<View> {
    frame_views(light, None, &ShadowSettings::default()).expect("the lights of the tests are good").views
}

/// One mesh or many, with few enough faces for the exact tiers on a CPU.
pub fn meshes() -> Vec<TestMesh> {
    let mut meshes = tiny();
    meshes.extend(shapes());
    let together = crowd(&meshes);
    meshes.push(together);
    meshes.extend(shared_named(&FILES));
    meshes
}

/// All of them in one pool, turned, stretched, mirrored, and one flat.
fn crowd(meshes: &[TestMesh]) -> TestMesh {
    let mut random = Random::new(1);
    let parts = meshes.iter().filter(|mesh| !mesh.name.starts_with("soup of")).flat_map(|mesh| &mesh.parts);
    let parts = parts.enumerate().map(|(index, part)| {
        let mut vector = || DVec3::new(random.signed(), random.signed(), random.signed());
        let scale = match index {
            3 => DVec3::new(1.0, 0.0, 1.0),
            _ => 1.0 + 0.5 * vector() - 2.0 * DVec3::X * f64::from(index % 2 == 1),
        };
        let turn = DQuat::from_rotation_arc(DVec3::Y, vector().normalize());
        let world_from_object = DMat4::from_scale_rotation_translation(scale, turn, 4.0 * vector());
        TestPart { world_from_object, ..part.clone() }
    });
    TestMesh { name: "crowd".into(), parts: parts.collect() }
}

/// The stage of a name as the library runs it.
pub fn stage(gpu: &Gpu, name: &str) -> StageRun {
    StageRun::new(gpu, wgsl_of(name), name)
}

/// Runs it on a frame's buffers.
pub fn run(gpu: &Gpu, stage: &StageRun, frame: &Frame, groups: u32) -> Outputs {
    run_with(gpu, stage, frame, groups, 1)
}

/// The same of a stage that has workgroups for each seat.
pub fn run_for_seats(gpu: &Gpu, stage: &StageRun, frame: &Frame, groups: u32) -> Outputs {
    run_with(gpu, stage, frame, groups, frame.bundle.shape.seat_count)
}

fn run_with(gpu: &Gpu, stage: &StageRun, frame: &Frame, groups: u32, seats: u32) -> Outputs {
    // Folded like a large dispatch, with groups left over.
    let groups = if groups > 3 { [3, groups.div_ceil(3), seats] } else { [groups, 1, seats] };
    let inputs: Vec<_> = stage.bindings().map(|name| (name, frame.bytes(name))).collect();
    stage.run(gpu, groups, &inputs)
}

/// What was counted for the seat that a stage of one view worked on.
pub fn counts_of(outputs: &Outputs) -> Counters {
    outputs.get::<SeatCounters>("counters")[0].counts
}

/// Decided bits are exact, listed ones are clear, and bits behind the last face are clear. The exact ones are those that all
/// stages of facing from `stage` on leave.
pub fn check_bits(before: &Frame, stage: &str, after: &Frame, is_listed: impl Fn(u32, u32) -> bool) -> Outcome {
    let mut exact = before.clone();
    exact.run_mirrors(stage, "detect_silhouette");
    let seats = after.bundle.shape.seat_count;
    for item in after.listed_faces() {
        let caster = &after.casters[item.caster as usize];
        for test in 64 * item.block * seats..64 * (item.block + 1) * seats {
            let word = (caster.first_lit_word * seats + test / 32) as usize;
            let bit = |lit: &[u32]| lit[word] >> (test % 32) & 1;
            let expected = if is_listed(item.caster, test) { 0 } else { bit(&exact.lit) };
            if bit(&after.lit) != expected {
                let face = (item.caster, test / seats, test % seats);
                return Err(format!("caster, face, seat {face:?}: expected bit {expected}, found {}", bit(&after.lit)));
            }
        }
    }
    Ok(())
}
