//! Nothing is lost in silence: full lists are counted and grow, and no map holds a number that is none.

use std::collections::BTreeSet;

use contrejour_gpu::ShadowOptions;
use contrejour_plan::{Light, Outputs, ShadowSettings};
use contrejour_tests::compare::{Record, check_finite};
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::{Gpu, gpu_blending_floats};
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::lights::{lights, point};
use contrejour_tests::meshes::{TestMesh, fan, shapes, tiny};
use contrejour_tests::pipeline::{MAX_FRAMES, Pipeline};
use contrejour_tests::texture::{read_depth, read_floats, read_half_floats};
use glam::DVec3;
use libtest_mimic::Trial;

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("nothing_lost::full_lists_are_counted_and_grow", full_lists_are_counted_and_grow),
        gpu_trial("nothing_lost::a_frame_without_growth_is_found", a_frame_without_growth_is_found),
        gpu_trial(
            "nothing_lost::a_frame_that_nobody_counted_is_drawn_again",
            a_frame_that_nobody_counted_is_drawn_again,
        ),
        gpu_trial("nothing_lost::every_mesh_leaves_finite_maps", every_mesh_leaves_finite_maps),
        gpu_trial("nothing_lost::every_mesh_leaves_finite_maps_in_one_texture", |_| match gpu_blending_floats() {
            Ok(gpu) => every_mesh_leaves_finite_maps(gpu),
            Err(reason) => {
                eprintln!("not tested: {reason}");
                Ok(())
            }
        }),
        gpu_trial("nothing_lost::a_fan_of_100_000_faces_is_drawn", a_large_fan_is_drawn),
    ]
}

/// So many separate tetrahedra have far more outline edges than a smooth mesh of as many faces.
fn tetrahedra(count: u32) -> TestMesh {
    let corners = [[0.4, 0.4, 0.4], [-0.4, -0.4, 0.4], [-0.4, 0.4, -0.4], [0.4, -0.4, -0.4]];
    let faces = [[0, 1, 3], [0, 2, 1], [0, 3, 2], [1, 2, 3]];
    let mut positions = Vec::new();
    let mut triangles = Vec::new();
    for index in 0..count {
        let [x, y, z] = [index % 10, index / 10 % 10, index / 100].map(|cell| cell as f32);
        positions.extend(corners.map(|[dx, dy, dz]| [x + dx, y + dy, z + dz]));
        triangles.extend(faces.map(|face| face.map(|corner| 4 * index + corner)));
    }
    TestMesh::generated("tetrahedra", &positions, &triangles)
}

fn full_lists_are_counted_and_grow(gpu: &Gpu) -> Outcome {
    let mesh = tetrahedra(2000);
    let light = light_from_above(&mesh);
    let mut pipeline = Pipeline::new(gpu, &mesh, &ShadowOptions::default())?;

    let first = pipeline.frame(&light)?;
    if pipeline.shadows.is_complete() || pipeline.shadows.stats().overflow_frames != 1 {
        return Err(format!("the first frame did not overflow with {first:?}"));
    }
    let complete = pipeline.complete_frame(&light)?;
    let overflows = pipeline.shadows.stats().overflow_frames;
    pipeline.frame(&lights(&mesh)[3])?;
    pipeline.frame(&light)?;
    if overflows >= u64::from(MAX_FRAMES) || pipeline.shadows.stats().overflow_frames != overflows {
        return Err("a grown frame overflowed".into());
    }

    check_all_are_there(&pipeline, &twin(&mesh, &light))?;
    // A full list counts what found no room, so one frame more has room for it. Quads are made of what found some.
    if first.silhouette_edges != complete.silhouette_edges || first.quads >= complete.quads {
        return Err(format!("the full frame counted {first:?}, the grown one {complete:?}"));
    }
    Ok(())
}

/// The comparer sees what a frame lost whose lists should have grown before it.
fn a_frame_without_growth_is_found(gpu: &Gpu) -> Outcome {
    let mesh = tetrahedra(2000);
    let light = light_from_above(&mesh);
    let mut pipeline = Pipeline::new(gpu, &mesh, &ShadowOptions::default())?;
    pipeline.frame(&light)?;
    match check_all_are_there(&pipeline, &twin(&mesh, &light)) {
        Err(_) if !pipeline.shadows.is_complete() => Ok(()),
        _ => Err("it passes for complete".into()),
    }
}

/// While more frames wait to be submitted than can send counters back, nobody would know of a full list. So a light stays
/// due until it was counted, and a full list grows all the same.
fn a_frame_that_nobody_counted_is_drawn_again(gpu: &Gpu) -> Outcome {
    let mesh = tetrahedra(2000);
    let light = light_from_above(&mesh);
    let mut pipeline = Pipeline::new(gpu, &mesh, &ShadowOptions::default())?;
    let mut waiting = Vec::new();
    for _ in 0..16 {
        pipeline.shadows.redraw();
        waiting.push(pipeline.record(&light)?);
    }
    waiting.push(pipeline.record(&light)?);
    if pipeline.shadows.stats().lights_redone != 1 {
        return Err("a light was kept that nobody had counted".into());
    }
    gpu.queue.submit(waiting);
    pipeline.complete_frame(&light)?;
    check_all_are_there(&pipeline, &twin(&mesh, &light))?;
    pipeline.record(&light)?;
    if pipeline.shadows.stats().lights_redone == 0 { Ok(()) } else { Err("a counted light was drawn again".into()) }
}

/// The frame as the stages' twins leave it.
fn twin(mesh: &TestMesh, light: &Light) -> Frame {
    let mut twin = Frame::new(&mesh.parts, light, &ShadowSettings::default());
    twin.run_mirrors("place_casters", "write_draw_args");
    twin
}

fn check_all_are_there(pipeline: &Pipeline<'_>, twin: &Frame) -> Outcome {
    let expected = &twin.quads[..twin.counts().quads as usize];
    if keys(&pipeline.quads()) != keys(expected) || keys(expected).len() != expected.len() {
        return Err("the quads are not all".into());
    }
    let expected = twin.made_corners();
    if keys(&pipeline.corners()) != keys(expected) {
        return Err("the corners are not all".into());
    }
    Ok(())
}

fn light_from_above(mesh: &TestMesh) -> Light {
    let (middle, radius) = mesh.middle_and_radius();
    point(middle + radius * DVec3::new(1.0, 2.0, 1.5), middle, radius)
}

fn keys<T: Record>(records: &[T]) -> BTreeSet<[u32; 3]> {
    records.iter().map(Record::key).collect()
}

fn every_mesh_leaves_finite_maps(gpu: &Gpu) -> Outcome {
    let mut meshes = tiny();
    meshes.extend(shapes());
    for mesh in &meshes {
        let mut pipeline = Pipeline::new(gpu, mesh, &small_maps())?;
        for (index, light) in lights(mesh).iter().enumerate().step_by(3) {
            check_maps(gpu, &mut pipeline, light).map_err(|error| format!("{}, light {index}: {error}", mesh.name))?;
        }
    }
    Ok(())
}

fn small_maps() -> ShadowOptions {
    let settings = ShadowSettings { map_size: 64, ..Default::default() };
    ShadowOptions { settings, outputs: Outputs::Maps, ..Default::default() }
}

/// Depths are finite, alphas are from 0 to 1.
fn check_maps(gpu: &Gpu, pipeline: &mut Pipeline<'_>, light: &Light) -> Outcome {
    pipeline.complete_frame(light)?;
    let maps = pipeline.maps();
    if let Some(texture) = maps.shadow_depth {
        check_finite("shadow_depth", &read_floats(gpu, texture))?;
    }
    if let Some(texture) = maps.smoothie_depth {
        check_finite("smoothie_depth", &read_depth(gpu, texture))?;
    }
    if let Some(texture) = maps.smoothie_alpha {
        check_alpha(read_half_floats(gpu, texture).into_iter())?;
    }
    if let Some(texture) = maps.smoothie_buffer {
        let floats = read_floats(gpu, texture);
        check_finite("smoothie_buffer", &floats)?;
        check_alpha(floats.into_iter().skip(1).step_by(2))?;
    }
    Ok(())
}

fn check_alpha(mut alphas: impl Iterator<Item = f32>) -> Outcome {
    match alphas.find(|alpha| !(0.0..=1.0).contains(alpha)) {
        None => Ok(()),
        Some(alpha) => Err(format!("an alpha is {alpha}")),
    }
}

fn a_large_fan_is_drawn(gpu: &Gpu) -> Outcome {
    let mesh = fan(100_000);
    let mut pipeline = Pipeline::new(gpu, &mesh, &small_maps())?;
    let (middle, radius) = mesh.middle_and_radius();
    // From above every spoke is inner, from aside two are outline; from within the fan's plane all are edge-on.
    for direction in [DVec3::new(0.1, 3.0, 0.2), DVec3::new(3.0, 0.2, 0.4), DVec3::new(3.0, 0.0, 0.0)] {
        check_maps(gpu, &mut pipeline, &point(middle + radius * direction, middle, radius))?;
    }
    Ok(())
}
