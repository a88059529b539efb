//! Casters that deform are where their poses put them, for views and for lights: who does not see them does nothing for them.

use std::sync::Arc;

use contrejour_gpu::{
    CasterHandle, CasterInput, DeformHandle, DeformInput, Deformer, KnownPositions, LightHandle, Positions,
    ShadowOptions, Shadows, Untimed,
};
use contrejour_mesh::PartPose;
use contrejour_plan::{Light, LightKind, Omitted, Reason, ShadowSettings};
use contrejour_tests::compare::compare_exact;
use contrejour_tests::deforming::{PosedMesh, tube};
use contrejour_tests::gpu::{Gpu, draw_whole};
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::lights::point;
use contrejour_tests::random::Random;
use contrejour_tests::texture::read_maps;
use glam::{DMat4, DVec3};
use libtest_mimic::Trial;

use crate::many_lights::text;

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("posed::what_saw_no_other_pose_is_kept", what_saw_no_other_pose_is_kept),
        gpu_trial("posed::what_is_kept_is_what_would_be_drawn", what_is_kept_is_what_would_be_drawn),
        gpu_trial("posed::a_box_of_another_pose_is_found", a_box_of_another_pose_is_found),
        gpu_trial("posed::what_is_known_was_prepared", what_is_known_was_prepared),
        gpu_trial("posed::lights_come_in_any_order", lights_come_in_any_order),
        gpu_trial("posed::what_is_no_box_is_refused", what_is_no_box_is_refused),
    ]
}

/// Where the second of two places is, which lights at the first one do not see.
const BESIDE: DVec3 = DVec3::new(60.0, 0.0, 0.0);

/// A light at each place, and a lamp at the second one.
fn lights() -> [Light; 3] {
    let lamp = LightKind::Point { position: BESIDE + DVec3::new(-1.0, 0.3, 0.5), radius: 0.1, near: 0.2, far: 12.0 };
    let spot = |at: DVec3| point(at + DVec3::new(3.0, 4.0, 1.0), at, 4.0);
    [spot(DVec3::ZERO), spot(BESIDE), Light { kind: lamp, color: [1.0; 3] }]
}

/// Tubes in poses of their own.
struct Tubes<'a> {
    gpu: &'a Gpu,
    mesh: PosedMesh,
    deformer: Deformer,
    shadows: Shadows,
    handles: Vec<(DeformHandle, CasterHandle)>,
    lights: Vec<LightHandle>,
}

/// What the shadows hear of positions.
#[derive(Clone, Copy, PartialEq)]
enum Told {
    Nothing,
    Known,
}

impl<'a> Tubes<'a> {
    /// Side by side, one for each pose.
    fn new(gpu: &'a Gpu, poses: &[PartPose], told: Told) -> Result<Self, String> {
        let mesh = tube();
        let mut deformer = Deformer::new(&gpu.device).map_err(text)?;
        let mut shadows = Shadows::new(&gpu.device).map_err(text)?;
        let topology = mesh.deforming.topology(&mesh.mesh.positions, &mesh.mesh.triangles).map_err(text)?;
        let topology = shadows.add_mesh(Arc::new(topology)).map_err(text)?;
        let mut deformed = Vec::new();
        for pose in poses {
            let caster = deformer.add(Arc::clone(&mesh.deforming)).map_err(text)?;
            deformer.set_pose(&input(caster, pose)).map_err(text)?;
            deformed.push(caster);
        }
        deformer.prepare(&gpu.device, &gpu.queue).map_err(text)?;
        let mut handles = Vec::new();
        for (caster, index) in deformed.into_iter().zip(0..) {
            let mut positions = deformer.positions(caster).ok_or("a prepared mesh has positions")?;
            if let (Positions::InBuffer { known, .. }, Told::Nothing) = (&mut positions, told) {
                *known = None;
            }
            let world_from_object = place(index);
            let input = CasterInput { mesh: topology, world_from_object, positions };
            handles.push((caster, shadows.add_caster(&input).map_err(text)?));
        }
        let settings = ShadowSettings { map_size: 128, ..Default::default() };
        let options = ShadowOptions { settings, ..Default::default() };
        let lights = lights().map(|light| shadows.add_light(&light, &options));
        let lights = lights.into_iter().collect::<Result<Vec<_>, _>>().map_err(text)?;
        Ok(Self { gpu, mesh, deformer, shadows, handles, lights })
    }

    fn set_pose(&mut self, tube: usize, pose: &PartPose) -> Outcome {
        self.deformer.set_pose(&input(self.handles[tube].0, pose)).map_err(text)
    }

    /// Draws what is due; returns how many lights that are.
    fn draw(&mut self) -> Result<u32, String> {
        self.deformer.prepare(&self.gpu.device, &self.gpu.queue).map_err(text)?;
        for (deformed, caster) in &self.handles {
            let known = self.deformer.known(*deformed).ok_or("a posed mesh is known")?;
            self.shadows.note_positions(*caster, &known).map_err(text)?;
        }
        let Self { gpu, shadows, deformer, .. } = self;
        draw_whole(gpu, shadows, |encoder| deformer.encode(encoder, &mut Untimed))
    }

    fn maps(&self) -> Result<Vec<Vec<u8>>, String> {
        self.lights.iter().map(|light| read_maps(self.gpu, &self.shadows, *light)).collect()
    }

    /// Which lights the latest frame kept.
    fn kept(&self) -> Vec<bool> {
        let is_kept = |light: &LightHandle| {
            let plan = self.shadows.plan(*light);
            plan.is_some_and(|plan| plan.reason(&Omitted::Redrawing) == Some(Reason::NothingChanged))
        };
        self.lights.iter().map(is_kept).collect()
    }
}

fn input(caster: DeformHandle, pose: &PartPose) -> DeformInput<'_> {
    DeformInput { caster, joint_matrices: &pose.joint_matrices, morph_weights: &pose.morph_weights }
}

/// Where a tube stands at rest: at the first place, some units from the one before.
fn place(index: u32) -> DMat4 {
    DMat4::from_translation(DVec3::new(0.7 * f64::from(index) - 0.7, 0.0, 0.0))
}

/// The pose elsewhere: all that joints move. The last ring, which none does, stays.
fn moved(pose: &PartPose, offset: DVec3) -> PartPose {
    let matrix = |matrix: &DMat4| DMat4::from_translation(offset) * *matrix;
    PartPose { joint_matrices: pose.joint_matrices.iter().map(matrix).collect(), ..pose.clone() }
}

fn what_saw_no_other_pose_is_kept(gpu: &Gpu) -> Outcome {
    let poses = tube().poses;
    let mut tubes = Tubes::new(gpu, &poses[..2], Told::Known)?;
    let check = |tubes: &mut Tubes<'_>, what: &str, (tube, pose): (usize, &PartPose), redone: u32, casters: u32| {
        tubes.set_pose(tube, pose)?;
        let found = tubes.draw()?;
        // All views of all lights together.
        tubes.shadows.redraw();
        tubes.draw()?;
        let seen = tubes.shadows.stats().counters.map_or(0, |counters| counters.casters);
        if (found, seen) == (redone, casters) {
            return Ok(());
        }
        Err(format!("{what}: {found} lights are drawn and views see {seen} casters, not {redone} and {casters}"))
    };
    tubes.draw()?;
    check(&mut tubes, "the same pose", (0, &poses[0]), 0, 2)?;
    check(&mut tubes, "another pose", (0, &poses[2]), 1, 2)?;
    // Its last ring stays, so the box reaches from one place to the other, and all faces of the lamp but one see it.
    check(&mut tubes, "a pose beside the room", (0, &moved(&poses[0], BESIDE)), 3, 2 + 1 + 5)?;
    check(&mut tubes, "the same", (0, &moved(&poses[0], BESIDE)), 0, 2 + 1 + 5)?;
    check(&mut tubes, "the other tube", (1, &poses[3]), 1, 2 + 1 + 5)?;
    check(&mut tubes, "back again", (0, &poses[0]), 3, 2)?;

    tubes.draw()?;
    tubes.draw()?;
    let stats = tubes.shadows.stats();
    let uploaded = tubes.deformer.upload_bytes() + stats.upload_bytes;
    if tubes.kept() == [true; 3] && (stats.dispatches_recorded, stats.draws_recorded, uploaded) == (0, 0, 0) {
        return Ok(());
    }
    Err(format!("where nothing moved {uploaded} bytes are uploaded and this is done: {stats:?}"))
}

/// Some poses in which tubes go from place to place, with the tube that takes each.
fn walk() -> Vec<(usize, PartPose)> {
    let mut random = Random::new(7);
    let poses = tube().poses;
    let mut step = |_| {
        let offset = [DVec3::ZERO, BESIDE, DVec3::new(0.0, 300.0, 0.0)][random.below(3)];
        let pose = &poses[random.below(poses.len())];
        (random.below(3), moved(pose, offset + DVec3::new(random.signed(), random.signed(), random.signed())))
    };
    (0..12).map(&mut step).collect()
}

/// After each step all maps are those of a scene in which nobody knows where positions are, drawn from scratch.
fn what_is_kept_is_what_would_be_drawn(gpu: &Gpu) -> Outcome {
    let mut poses = tube().poses[..3].to_vec();
    let mut tubes = Tubes::new(gpu, &poses, Told::Known)?;
    tubes.draw()?;
    let (mut kept, mut changed) = (0, 0);
    let mut before = tubes.maps()?;
    for (step, (tube, pose)) in walk().into_iter().enumerate() {
        tubes.set_pose(tube, &pose)?;
        poses[tube] = pose;
        kept += 3 - tubes.draw()?;
        let found = tubes.maps()?;
        let mut scratch = Tubes::new(gpu, &poses, Told::Nothing)?;
        let Tubes { shadows, deformer, .. } = &mut scratch;
        draw_whole(gpu, shadows, |encoder| deformer.encode(encoder, &mut Untimed))?;
        for (light, (expected, found)) in scratch.maps()?.iter().zip(&found).enumerate() {
            compare_exact(&format!("step {step}, maps of light {light}"), expected, found)?;
        }
        changed += found.iter().zip(&before).filter(|(found, before)| found != before).count();
        before = found;
    }
    // Else a map that is never drawn again would pass.
    if kept >= 6 && changed >= 8 { Ok(()) } else { Err(format!("{kept} maps were kept, {changed} changed")) }
}

/// A planted fault: shadows that hear of a new pose and get the box of the one before lose what moved out of it.
fn a_box_of_another_pose_is_found(gpu: &Gpu) -> Outcome {
    let pose = moved(&tube().poses[1], BESIDE);
    let maps = |box_of: &PartPose| {
        let mut tubes = Tubes::new(gpu, &tube().poses[..1], Told::Known)?;
        tubes.draw()?;
        tubes.set_pose(0, &pose)?;
        tubes.deformer.prepare(&gpu.device, &gpu.queue).map_err(text)?;
        let bounds = tubes.mesh.deforming.posed_bounds(&box_of.joint_matrices, &box_of.morph_weights);
        let known = KnownPositions { version: u64::MAX, bounds };
        tubes.shadows.note_positions(tubes.handles[0].1, &known).map_err(text)?;
        let Tubes { shadows, deformer, .. } = &mut tubes;
        draw_whole(gpu, shadows, |encoder| deformer.encode(encoder, &mut Untimed))?;
        tubes.maps()
    };
    let (whole, lacking) = (maps(&pose)?, maps(&tube().poses[1])?);
    let is_found: Vec<_> = whole.iter().zip(&lacking).map(|(whole, lacking)| whole != lacking).collect();
    if is_found == [false, true, true] { Ok(()) } else { Err(format!("maps that differ: {is_found:?}")) }
}

/// Between poses and frames meshes come, and one without a pose lets a frame fail: positions are never older than what is
/// known of them.
fn what_is_known_was_prepared(gpu: &Gpu) -> Outcome {
    let poses = tube().poses;
    let expected = {
        let mut tubes = Tubes::new(gpu, &poses[2..3], Told::Known)?;
        tubes.draw()?;
        tubes.maps()?
    };
    let draw = |tubes: &mut Tubes<'_>| {
        let known = tubes.deformer.known(tubes.handles[0].0).ok_or("a posed mesh is known")?;
        tubes.shadows.note_positions(tubes.handles[0].1, &known).map_err(text)?;
        let Tubes { shadows, deformer, .. } = tubes;
        draw_whole(gpu, shadows, |encoder| deformer.encode(encoder, &mut Untimed))
    };
    let add = |tubes: &mut Tubes<'_>| tubes.deformer.add(Arc::clone(&tubes.mesh.deforming)).map_err(text);

    let mut tubes = Tubes::new(gpu, &poses[..1], Told::Known)?;
    tubes.draw()?;
    tubes.set_pose(0, &poses[2])?;
    tubes.deformer.prepare(&gpu.device, &gpu.queue).map_err(text)?;
    add(&mut tubes)?;
    draw(&mut tubes)?;
    if tubes.maps()? != expected {
        return Err("a mesh that came before the frame was recorded leaves the pose before".into());
    }

    let mut tubes = Tubes::new(gpu, &poses[..1], Told::Known)?;
    tubes.draw()?;
    tubes.set_pose(0, &poses[2])?;
    let guest = add(&mut tubes)?;
    if tubes.deformer.prepare(&gpu.device, &gpu.queue).is_ok() {
        return Err("a mesh without a pose is prepared".into());
    }
    draw(&mut tubes)?;
    tubes.deformer.remove(guest);
    tubes.draw()?;
    if tubes.maps()? == expected { Ok(()) } else { Err("a frame that failed leaves the pose before".into()) }
}

/// Planes of faces are asked for by lights that test them, and there are none of what deforms.
fn lights_come_in_any_order(gpu: &Gpu) -> Outcome {
    let maps = |techniques: [&str; 2]| -> Result<Vec<Vec<u8>>, String> {
        let mut tubes = Tubes::new(gpu, &tube().poses[..1], Told::Known)?;
        for light in tubes.lights.drain(..) {
            tubes.shadows.remove_light(light).map_err(text)?;
        }
        for technique in techniques {
            let technique = technique.parse().map_err(text)?;
            let settings = ShadowSettings { map_size: 64, technique, ..Default::default() };
            let options = ShadowOptions { settings, ..Default::default() };
            tubes.lights.push(tubes.shadows.add_light(&lights()[0], &options).map_err(text)?);
        }
        tubes.draw()?;
        tubes.maps()
    };
    let mut turned = maps(["smoothies", "pcf"])?;
    turned.reverse();
    if maps(["pcf", "smoothies"])? == turned { Ok(()) } else { Err("maps differ with the order of lights".into()) }
}

fn what_is_no_box_is_refused(gpu: &Gpu) -> Outcome {
    let mut tubes = Tubes::new(gpu, &tube().poses[..1], Told::Known)?;
    let caster = tubes.handles[0].1;
    let mut note = |bounds| tubes.shadows.note_positions(caster, &KnownPositions { version: 1, bounds });
    let refused = [
        note([[0.0; 3], [1.0, f32::NAN, 1.0]]),
        note([[0.0; 3], [1.0, f32::INFINITY, 1.0]]),
        note([[0.0, 2.0, 0.0], [1.0; 3]]),
    ];
    let told: Vec<_> = refused.into_iter().filter_map(Result::err).map(text).collect();
    if told.len() != 3 || !told.iter().all(|error| error.contains("give finite corners")) {
        return Err(format!("refused: {told:?}"));
    }
    let mesh = Arc::clone(&contrejour_tests::meshes::shapes()[0].parts[0].topology);
    let mesh = tubes.shadows.add_mesh(mesh).map_err(text)?;
    let input = CasterInput { mesh, world_from_object: DMat4::IDENTITY, positions: Positions::OfMesh };
    let rigid = tubes.shadows.add_caster(&input).map_err(text)?;
    let known = KnownPositions { version: 1, bounds: [[0.0; 3], [1.0; 3]] };
    match tubes.shadows.note_positions(rigid, &known).map_err(text) {
        Err(error) if error.contains("InBuffer") => Ok(()),
        other => Err(format!("positions of a mesh: {other:?}")),
    }
}
