//! Many lights in one object: each leaves what it leaves alone, and what saw no change is kept.

use std::sync::Arc;

use contrejour_gpu::{CasterHandle, CasterInput, LightHandle, MeshHandle, Positions, ShadowOptions, Shadows, Untimed};
use contrejour_mesh::TopologyAwareMesh;
use contrejour_plan::{BufferKind, Light, LightKind, Omitted, Reason, ShadowSettings};
use contrejour_scene::shapes::Shape;
use contrejour_tests::compare::compare_exact;
use contrejour_tests::gpu::{Gpu, draw_whole, gpu_with_small_buffers};
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::lights::point;
use contrejour_tests::meshes::shapes;
use contrejour_tests::random::Random;
use contrejour_tests::texture::read_maps;
use glam::{DMat4, DQuat, DVec3};
use libtest_mimic::Trial;

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("many_lights::each_leaves_what_it_leaves_alone", each_leaves_what_it_leaves_alone),
        gpu_trial("many_lights::what_saw_no_change_is_kept", what_saw_no_change_is_kept),
        gpu_trial("many_lights::what_is_kept_is_what_would_be_drawn", what_is_kept_is_what_would_be_drawn),
        gpu_trial("many_lights::thousands_come_and_go", thousands_come_and_go),
        gpu_trial("many_lights::lists_are_there_where_seats_went", lists_are_there_where_seats_went),
        gpu_trial("many_lights::commands_do_not_follow_the_casters", commands_do_not_follow_the_casters),
    ]
}

/// A scene whose casters move, with one object for all of it.
struct Crowd<'a> {
    gpu: &'a Gpu,
    shadows: Shadows,
    meshes: Vec<MeshHandle>,
    casters: Vec<CasterHandle>,
}

pub(crate) fn text(error: impl ToString) -> String {
    error.to_string()
}

impl<'a> Crowd<'a> {
    /// As many casters of all shapes, at places that follow from the seed.
    fn new(gpu: &'a Gpu, count: usize, seed: u64) -> Result<Self, String> {
        let mut shadows = Shadows::new(&gpu.device).map_err(text)?;
        let mut meshes = Vec::new();
        for shape in shapes() {
            meshes.push(shadows.add_mesh(Arc::clone(&shape.parts[0].topology)).map_err(text)?);
        }
        let mut crowd = Self { gpu, shadows, meshes, casters: Vec::new() };
        let mut random = Random::new(seed);
        for index in 0..count {
            let caster = crowd.add_caster(index, place(&mut random))?;
            crowd.casters.push(caster);
        }
        Ok(crowd)
    }

    fn add_caster(&mut self, mesh: usize, world_from_object: DMat4) -> Result<CasterHandle, String> {
        let mesh = self.meshes[mesh % self.meshes.len()];
        let input = CasterInput { mesh, world_from_object, positions: Positions::OfMesh };
        self.shadows.add_caster(&input).map_err(text)
    }

    fn add_light(&mut self, &(light, technique): &(Light, &str)) -> Result<LightHandle, String> {
        let mut settings = ShadowSettings { map_size: 128, ..Default::default() };
        // The smoothies of the preset are narrow: wide ones reach all around a lamp.
        if technique != settings.technique.to_string() {
            settings.technique = technique.parse().map_err(text)?;
        }
        let options = ShadowOptions { settings, ..Default::default() };
        self.shadows.add_light(&light, &options).map_err(text)
    }

    /// Draws until all lists had room. Returns how many lights the first frame made.
    fn draw(&mut self) -> Result<u32, String> {
        draw_whole(self.gpu, &mut self.shadows, |_| ())
    }

    fn maps(&self, light: LightHandle) -> Result<Vec<u8>, String> {
        read_maps(self.gpu, &self.shadows, light)
    }
}

/// Somewhere in a room of 8 units, turned, stretched, every other one mirrored.
pub(crate) fn place(random: &mut Random) -> DMat4 {
    let mut vector = || DVec3::new(random.signed(), random.signed(), random.signed());
    let (middle, stretch, axis) = (4.0 * vector(), vector(), vector().normalize_or(DVec3::X));
    let sign = if stretch.x > 0.0 { 1.0 } else { -1.0 };
    let scale = DVec3::splat(0.6) * (1.0 + 0.4 * stretch) * DVec3::new(sign, 1.0, 1.0);
    DMat4::from_scale_rotation_translation(scale, DQuat::from_axis_angle(axis, 3.0 * stretch.y), middle)
}

pub(crate) fn lamp(position: DVec3) -> Light {
    Light { kind: LightKind::Point { position, radius: 0.1, near: 0.2, far: 12.0 }, color: [1.0; 3] }
}

pub(crate) fn sun(towards_light: DVec3) -> Light {
    let kind = LightKind::Directional {
        towards_light,
        center: DVec3::ZERO,
        half_extent: 6.0,
        half_depth: 8.0,
        angular_radius: 0.02,
    };
    Light { kind, color: [1.0; 3] }
}

/// Every kind of light, with techniques of all kinds.
fn lights() -> Vec<(Light, &'static str)> {
    vec![
        (point(DVec3::new(5.0, 6.0, 1.0), DVec3::ZERO, 4.0), "smoothies"),
        (sun(DVec3::new(0.3, 1.0, 0.2)), "shadow-map"),
        (lamp(DVec3::new(0.2, 0.5, -0.3)), "smoothies"),
        (point(DVec3::new(-6.0, 3.0, 2.0), DVec3::Y, 4.0), "evsm"),
        (lamp(DVec3::new(-2.0, 1.0, 2.0)), "pcss"),
        (sun(DVec3::new(-1.0, 0.4, 0.1)), "smoothies"),
        (lamp(DVec3::new(3.0, -1.0, 0.0)), "vsm-pcss"),
    ]
}

fn each_leaves_what_it_leaves_alone(gpu: &Gpu) -> Outcome {
    let mut all = Crowd::new(gpu, 20, 1)?;
    let handles = lights().iter().map(|light| all.add_light(light)).collect::<Result<Vec<_>, _>>()?;
    all.draw()?;
    for (light, handle) in lights().iter().zip(handles) {
        let mut alone = Crowd::new(gpu, 20, 1)?;
        let only = alone.add_light(light)?;
        alone.draw()?;
        let (expected, found) = (alone.maps(only)?, all.maps(handle)?);
        compare_exact(&format!("maps of {light:?}"), &expected, &found)?;
    }
    Ok(())
}

fn what_saw_no_change_is_kept(gpu: &Gpu) -> Outcome {
    let mut crowd = Crowd::new(gpu, 6, 2)?;
    // One looks at the room, one at what lies far beside it.
    let beside = DVec3::new(100.0, 0.0, 0.0);
    let near = crowd.add_light(&(point(DVec3::new(5.0, 6.0, 1.0), DVec3::ZERO, 4.0), "smoothies"))?;
    let far = crowd.add_light(&(lamp(beside), "smoothies"))?;
    let stranger = crowd.add_caster(1, DMat4::from_translation(beside + DVec3::X))?;
    let kept = |crowd: &Crowd<'_>, light| {
        let plan = crowd.shadows.plan(light);
        plan.is_some_and(|plan| plan.reason(&Omitted::Redrawing) == Some(Reason::NothingChanged))
    };
    let check = |crowd: &mut Crowd<'_>, what: &str, expected: [bool; 2]| {
        crowd.draw()?;
        // The frame after it finds all maps as they are.
        let redone = [near, far].map(|light| !kept(crowd, light));
        if redone == expected { Ok(()) } else { Err(format!("{what}: {redone:?} are drawn, and not {expected:?}")) }
    };
    crowd.draw()?;
    check(&mut crowd, "nothing moved", [false, false])?;
    let stats = crowd.shadows.stats();
    if (stats.dispatches_recorded, stats.draws_recorded, stats.upload_bytes) != (0, 0, 0) {
        return Err(format!("something is done where nothing moved: {stats:?}"));
    }

    let first = crowd.casters[0];
    crowd.shadows.place_caster(first, &DMat4::from_translation(DVec3::Y)).map_err(text)?;
    check(&mut crowd, "a caster in the room moved", [true, false])?;
    crowd.shadows.place_caster(first, &DMat4::from_translation(DVec3::Y)).map_err(text)?;
    check(&mut crowd, "it was put where it was", [false, false])?;
    crowd.shadows.place_caster(first, &DMat4::from_translation(beside - DVec3::X)).map_err(text)?;
    check(&mut crowd, "it went from one to the other", [true, true])?;
    crowd.shadows.remove_caster(stranger).map_err(text)?;
    check(&mut crowd, "a caster beside the room left", [false, true])?;
    crowd.shadows.set_light(near, &point(DVec3::new(5.0, 6.0, 1.5), DVec3::ZERO, 4.0)).map_err(text)?;
    check(&mut crowd, "a light moved", [true, false])?;
    crowd.add_light(&(sun(DVec3::Y), "pcf"))?;
    check(&mut crowd, "a light came", [false, false])
}

/// Casters walk about; now and then a light does. After each step all maps are those of a scene drawn from scratch, and
/// some were kept.
fn what_is_kept_is_what_would_be_drawn(gpu: &Gpu) -> Outcome {
    let mut random = Random::new(3);
    let mut lights = lights();
    lights.push((lamp(DVec3::new(60.0, 0.0, 0.0)), "smoothies"));
    lights.push((point(DVec3::new(60.0, 3.0, 0.0), DVec3::new(60.0, 0.0, 0.0), 4.0), "pcss"));
    let mut crowd = Crowd::new(gpu, 8, 3)?;
    let handles = lights.iter().map(|light| crowd.add_light(light)).collect::<Result<Vec<_>, _>>()?;
    let mut places: Vec<_> = {
        let mut random = Random::new(3);
        (0..8).map(|_| place(&mut random)).collect()
    };
    let (mut kept, mut changed) = (0, 0);
    let mut before: Vec<Vec<u8>> = Vec::new();
    for step in 0..8 {
        let caster = random.below(8);
        // Some go to the lights beside the room, and stay there.
        let beside = DVec3::X * if caster < 4 { 60.0 } else { 0.0 };
        places[caster] = DMat4::from_translation(beside) * place(&mut random);
        crowd.shadows.place_caster(crowd.casters[caster], &places[caster]).map_err(text)?;
        kept += lights.len() as u32 - crowd.draw()?;

        let mut scratch = Crowd::new(gpu, 8, 3)?;
        for (caster, place) in scratch.casters.iter().zip(&places) {
            scratch.shadows.place_caster(*caster, place).map_err(text)?;
        }
        let anew = lights.iter().map(|light| scratch.add_light(light)).collect::<Result<Vec<_>, _>>()?;
        scratch.draw()?;
        let mut found = Vec::new();
        for ((light, handle), anew) in lights.iter().zip(&handles).zip(anew) {
            found.push(crowd.maps(*handle)?);
            let what = format!("step {step}, maps of {light:?}");
            compare_exact(&what, &scratch.maps(anew)?, &found[found.len() - 1])?;
        }
        changed += found.iter().zip(&before).filter(|(found, before)| found != before).count();
        before = found;
    }
    // Else a map that is never drawn again would pass.
    if kept >= 6 && changed >= 12 { Ok(()) } else { Err(format!("{kept} maps were kept, {changed} changed")) }
}

fn thousands_come_and_go(gpu: &Gpu) -> Outcome {
    let mut random = Random::new(4);
    let mut crowd = Crowd::new(gpu, 4, 4)?;
    let stays = crowd.add_light(&lights()[0])?;
    crowd.draw()?;
    let before = crowd.maps(stays)?;
    let mut largest = 0;
    for round in 0..50 {
        let guests = (0..60).map(|index| crowd.add_caster(index, place(&mut random))).collect::<Result<Vec<_>, _>>()?;
        let light = crowd.add_light(&(lamp(DVec3::Y), if round % 2 == 0 { "smoothies" } else { "pcf" }))?;
        largest = largest.max(guests.iter().map(|guest| guest.index()).max().unwrap_or(0));
        if round % 10 == 0 {
            crowd.draw()?;
        }
        for guest in &guests {
            crowd.shadows.remove_caster(*guest).map_err(text)?;
        }
        crowd.shadows.remove_light(light).map_err(text)?;
        let gone = crowd.shadows.place_caster(guests[0], &DMat4::IDENTITY);
        if gone.is_ok() || crowd.shadows.set_light(light, &lamp(DVec3::X)).is_ok() {
            return Err("what was removed is still there".into());
        }
    }
    crowd.draw()?;
    compare_exact("maps of the light that stayed", &before, &crowd.maps(stays)?)?;
    if largest < 70 { Ok(()) } else { Err(format!("casters got the index {largest}")) }
}

/// A mesh comes beside which fewer views can be tested together. No light sees it, so nothing is drawn, and the lists that a
/// caller asks for are parts of buffers all the same.
fn lists_are_there_where_seats_went(_: &Gpu) -> Outcome {
    let gpu = gpu_with_small_buffers(256 << 10)?;
    let torus = |sides: u32| -> Result<_, String> {
        let shape = Shape::Torus { radius: 1.0, tube_radius: 0.3, segments: sides, sides };
        let torus = shape.generate().map_err(text)?;
        let built = TopologyAwareMesh::build(&torus.positions, &torus.triangles, &Default::default());
        built.map(Arc::new).map_err(text)
    };
    let mut shadows = Shadows::new(&gpu.device).map_err(text)?;
    let place = |shadows: &mut Shadows, sides: u32, middle: DVec3| {
        let mesh = shadows.add_mesh(torus(sides)?).map_err(text)?;
        let world_from_object = DMat4::from_translation(middle);
        shadows.add_caster(&CasterInput { mesh, world_from_object, positions: Positions::OfMesh }).map_err(text)
    };
    place(&mut shadows, 8, DVec3::ZERO)?;
    let options =
        ShadowOptions { settings: ShadowSettings { map_size: 64, ..Default::default() }, ..Default::default() };
    let mut light = None;
    for step in 0..8 {
        let position = DVec3::new(3.0 + 0.1 * f64::from(step), 4.0, 1.0);
        light = Some(shadows.add_light(&point(position, DVec3::ZERO, 2.0), &options).map_err(text)?);
    }
    draw_whole(&gpu, &mut shadows, |_| ())?;
    let seats = |shadows: &Shadows| light.and_then(|light| shadows.plan(light)).map_or(0, |plan| plan.seats);
    let before = seats(&shadows);
    place(&mut shadows, 60, DVec3::splat(1e3))?;
    shadows.prepare(&gpu.device, &gpu.queue).map_err(text)?;
    let after = seats(&shadows);
    let list = shadows.buffer(BufferKind::Silhouettes).ok_or("it is listed")?;
    let is_there = list.offset() + list.size() <= list.buffer().size();
    if is_there && before == 8 && after < before && shadows.stats().lights_redone == 0 {
        return Ok(());
    }
    Err(format!("from {before} seats to {after}, {} lights are redone: {is_there}", shadows.stats().lights_redone))
}

fn commands_do_not_follow_the_casters(gpu: &Gpu) -> Outcome {
    let recorded = |count: usize| {
        let mut crowd = Crowd::new(gpu, count, 5)?;
        for light in &lights() {
            crowd.add_light(light)?;
        }
        crowd.draw()?;
        // All lights and one caster move.
        let moved = DMat4::from_translation(DVec3::Y);
        crowd.shadows.place_caster(crowd.casters[0], &moved).map_err(text)?;
        crowd.shadows.prepare(&gpu.device, &gpu.queue).map_err(text)?;
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        crowd.shadows.encode(&mut encoder, &mut Untimed);
        gpu.queue.submit([encoder.finish()]);
        let stats = crowd.shadows.stats();
        Ok::<_, String>([u64::from(stats.dispatches_recorded), stats.draws_recorded.into(), stats.upload_bytes])
    };
    let (few, many) = (recorded(1)?, recorded(256)?);
    if few == many && few[0] > 50 { Ok(()) } else { Err(format!("1 caster: {few:?}, 256 casters: {many:?}")) }
}
