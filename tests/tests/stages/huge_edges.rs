//! Edges that are far larger than the view: where they are cut off, rounding is as large as the view itself, and can put
//! the cut end into the plane of the light, where it has no image.

use contrejour_layout::{LightView, OWN_END_HIGH, OWN_END_LOW, Quad};
use contrejour_plan::{Light, LightKind, ShadowSettings};
use contrejour_tests::chain::{Fault, check_each_is_found};
use contrejour_tests::frame::Frame;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::meshes::TestMesh;
use contrejour_tests::random::Random;
use contrejour_tests::stage_run::StageRun;
use glam::{DVec3, Vec3};
use libtest_mimic::Trial;

use crate::parity::{counts_of, run, stage};

/// Beyond these, an edge that passes the view points at the light but for rounding, and its image is a point.
const SIZES: [f32; 3] = [1024.0, 8192.0, 32_768.0];

/// The second one sees almost to its sides, where the plane of the light is near. Unit: radians.
const CONES: [f64; 2] = [1.0, 3.1414];

const TRIANGLES: u32 = 64;

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("huge_edges::end_in_view", |gpu| check(gpu, &stage(gpu, "extrude_edges"))),
        gpu_trial("huge_edges::an_end_out_of_view_is_found", |gpu| check_each_is_found(gpu, &FAULTS, check)),
    ]
}

/// Cut ends that are taken where rounding puts them.
const FAULTS: [Fault; 2] = [
    Fault::Replaced {
        stage: "extrude_edges",
        piece: "clamp(depth_of_clip(clip), least_depth(), view.far_depth)",
        fault: "depth_of_clip(clip)",
    },
    Fault::Replaced {
        stage: "extrude_edges",
        piece: "clamp(clip.xy / w, vec2f(-most), vec2f(most))",
        fault: "clip.xy / w",
    },
];

fn check(gpu: &Gpu, stage: &StageRun) -> Outcome {
    for (size, cone) in SIZES.into_iter().flat_map(|size| CONES.map(|cone| (size, cone))) {
        let mut frame = Frame::new(&triangles(size).parts, &lamp(cone), &ShadowSettings::default());
        frame.run_mirrors("place_casters", "extrude_edges");
        let outputs = run(gpu, stage, &frame, frame.extrude_args[0].x * frame.extrude_args[0].y);
        frame.run_mirror("extrude_edges");
        let count = counts_of(&outputs).quads;
        for (side, quads, count) in
            [("device", &outputs.get("quads"), count), ("twin", &frame.quads, frame.counts().quads)]
        {
            let quads: &[Quad] = &quads[..count as usize];
            let cut = quads.iter().filter(|quad| quad.own_ends != OWN_END_LOW | OWN_END_HIGH).count();
            if cut < TRIANGLES as usize / 2 {
                return Err(format!("{side}: only {cut} edges of size {size} are cut off in a cone of {cone}"));
            }
            if let Some(quad) = quads.iter().find(|quad| !is_in_view(frame.view(), quad)) {
                return Err(format!("{side}: an edge of size {size} in a cone of {cone} ends out of view: {quad:?}"));
            }
        }
    }
    Ok(())
}

/// Whether both ends are in the frustum, widened by the widest smoothie. NaN is nowhere.
fn is_in_view(view: &LightView, quad: &Quad) -> bool {
    let most = 1.0 + view.width_max_ndc;
    let depths = quad.q.map(|q| -1.0 / q);
    let rounding = 1.0 + 1e-6;
    [quad.low_ndc, quad.high_ndc].as_flattened().iter().all(|coordinate| coordinate.abs() <= most)
        && depths.iter().all(|depth| (view.near_depth / rounding..=view.far_depth * rounding).contains(depth))
}

/// Triangles with an edge that comes from far beyond the view, passes a point in it, and ends far behind the light.
fn triangles(size: f32) -> TestMesh {
    let mut random = Random::new(5);
    let mut positions = Vec::new();
    for _ in 0..TRIANGLES {
        let [x, y] = [(); 2].map(|()| (random.below(9) as f32 - 4.0) / 8.0);
        let point = Vec3::new(x, y, -2.0);
        let [across_x, across_y] = [(); 2].map(|()| random.below(3) as f32 - 1.0);
        let along = size * Vec3::new(across_x, across_y, 1.0);
        let aside = size * Vec3::new(1.0 - across_x.abs(), -across_x, 0.0);
        positions.extend([point - along, point + along, aside - along].map(|position| position.to_array()));
    }
    let triangles: Vec<_> = (0..TRIANGLES).map(|index| [3 * index, 3 * index + 1, 3 * index + 2]).collect();
    TestMesh::generated("huge edges", &positions, &triangles)
}

fn lamp(cone_angle: f64) -> Light {
    let kind =
        LightKind::Spot { position: DVec3::ZERO, target: DVec3::NEG_Z, cone_angle, radius: 0.1, near: 0.01, far: 10.0 };
    Light { kind, color: [1.0; 3] }
}
