//! Around no outline vertex is there an angle that neither a blocker nor a smoothie covers.

use std::ops::Range;

use contrejour_gpu::ShadowOptions;
use contrejour_oracle::{GapSearch, blocker_image, outline_gaps};
use contrejour_plan::{NearOne, ShadowSettings, SmoothieSettings, SmoothieWidth, Technique, View, caster_light, views};
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::lights::lights;
use contrejour_tests::meshes::{TestMesh, TestPart, shapes, shared_named};
use contrejour_tests::pipeline::Pipeline;
use glam::{DVec2, Mat4, Vec3};
use libtest_mimic::Trial;

/// Files whose outlines have many turns and branches.
const FILES: [&str; 3] = ["closed/bunny-index.obj", "nasty/hollowcube.obj", "animated/RiggedFigure.glb"];

/// Lights in or on the mesh: there the near plane cuts blockers, and a cut has no outline.
const INSIDE: Range<usize> = 12..20;

pub fn trials() -> Vec<Trial> {
    vec![gpu_trial("no_gaps::around_any_outline_vertex", no_outline_vertex_has_a_gap)]
}

fn no_outline_vertex_has_a_gap(gpu: &Gpu) -> Outcome {
    let width = SmoothieSettings { width: SmoothieWidth::Ndc(0.05), ..Default::default() };
    let settings = ShadowSettings { technique: Technique::Smoothies(width), ..Default::default() };
    let options = ShadowOptions { settings, ..Default::default() };
    let mut meshes = shapes();
    meshes.extend(shared_named(&FILES));
    for mesh in &meshes {
        let mut pipeline = Pipeline::new(gpu, mesh, &options)?;
        for (index, light) in lights(mesh).iter().enumerate().filter(|(index, _)| !INSIDE.contains(index)).step_by(3) {
            pipeline.complete_frame(light)?;
            let view = views(light).map_err(|error| error.to_string())?[0];
            let (quads, corners) = (pipeline.quads(), pipeline.corners());
            let search = GapSearch { directions: 180, max_vertices: 300, ..Default::default() };
            let gaps = outline_gaps(&quads, &corners, &blockers(mesh, &view), &search);
            if let Some(gap) = gaps.first() {
                return Err(format!("{}, light {index}: {} gaps, the first {gap:?}", mesh.name, gaps.len()));
            }
        }
    }
    Ok(())
}

fn blockers(mesh: &TestMesh, view: &View) -> Vec<[DVec2; 3]> {
    mesh.parts.iter().flat_map(|part| blockers_of_part(part, view)).collect()
}

fn blockers_of_part(part: &TestPart, view: &View) -> Vec<[DVec2; 3]> {
    let topology = &part.topology;
    let near_one = NearOne::of_box(topology.bounds_min, topology.bounds_max);
    let light = caster_light(view, &part.world_from_object, &near_one);
    let scaled = |&position: &[f32; 3]| near_one.scale * (Vec3::from(position) - Vec3::from(near_one.origin));
    let positions: Vec<_> = topology.positions.iter().map(scaled).collect();
    let faces: Vec<_> = topology.faces.iter().map(|face| [face.a, face.b, face.c]).collect();
    blocker_image(&positions, &faces, &Mat4::from_cols_array(&light.light_clip_from_object))
}
