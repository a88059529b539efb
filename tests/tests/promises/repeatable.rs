//! The same frame leaves the same records in every run, whatever order the device worked in.

use contrejour_gpu::ShadowOptions;
use contrejour_layout::{Corner, Quad, SilhouetteEdge};
use contrejour_plan::Light;
use contrejour_tests::compare::compare_records;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, cpu_trial, gpu_trial};
use contrejour_tests::lights::lights;
use contrejour_tests::meshes::{TestMesh, shapes, shared_named, tiny};
use contrejour_tests::pipeline::Pipeline;
use libtest_mimic::Trial;

const RUNS: usize = 5;

/// With faces without area, and with edges of many faces.
const FILES: [&str; 2] = ["nasty/deg_faces.obj", "nasty/hollowcube.obj"];

pub fn trials() -> Vec<Trial> {
    vec![
        gpu_trial("repeatable::the_same_frame_leaves_the_same_records", the_same_frame_leaves_the_same_records),
        cpu_trial("repeatable::comparer_finds_planted_faults", comparer_finds_planted_faults),
    ]
}

/// The lists of a frame.
#[derive(Clone, Debug, Default)]
struct Records {
    silhouettes: Vec<SilhouetteEdge>,
    quads: Vec<Quad>,
    corners: Vec<Corner>,
}

fn the_same_frame_leaves_the_same_records(gpu: &Gpu) -> Outcome {
    let mut meshes = tiny();
    meshes.extend(shapes());
    meshes.extend(shared_named(&FILES));
    let mut edges = 0;
    for mesh in &meshes {
        edges += check(gpu, mesh).map_err(|difference| format!("{}: {difference}", mesh.name))?;
    }
    if edges > 1000 { Ok(()) } else { Err(format!("only {edges} edges were compared")) }
}

/// Returns the number of edges.
fn check(gpu: &Gpu, mesh: &TestMesh) -> Result<usize, String> {
    let lights = lights(mesh);
    let mut pipeline = Pipeline::new(gpu, mesh, &ShadowOptions::default())?;
    let first = records(&mut pipeline, &lights)?;
    for _ in 1..RUNS {
        compare(&first, &records(&mut pipeline, &lights)?)?;
    }
    Ok(first.silhouettes.len())
}

/// The records under one light, after a frame under another: an unchanged frame would not run at all.
fn records(pipeline: &mut Pipeline<'_>, lights: &[Light]) -> Result<Records, String> {
    pipeline.complete_frame(&lights[4])?;
    pipeline.complete_frame(&lights[1])?;
    Ok(Records { silhouettes: pipeline.silhouettes(), quads: pipeline.quads(), corners: pipeline.corners() })
}

fn compare(first: &Records, other: &Records) -> Outcome {
    compare_records("silhouette edge", &first.silhouettes, &other.silhouettes, 0.0)?;
    compare_records("quad", &first.quads, &other.quads, 0.0)?;
    compare_records("corner", &first.corners, &other.corners, 0.0)
}

fn comparer_finds_planted_faults() -> Outcome {
    let good = Records {
        silhouettes: (0..4).map(|edge_id| SilhouetteEdge { caster: 0, edge_id, left: 1, right: 0 }).collect(),
        quads: (0..4).map(|edge_id| Quad { edge_id, ..Default::default() }).collect(),
        corners: (0..4).map(|edge_id| Corner { edge_id, ..Default::default() }).collect(),
    };
    let mut turned = good.clone();
    turned.silhouettes.reverse();
    turned.quads.rotate_left(1);
    compare(&good, &turned)?;
    let faults: [fn(&mut Records); 4] = [
        |records| records.silhouettes[2].edge_id = 7,
        |records| records.silhouettes[1].right = 1,
        |records| records.quads[0].width_ndc[0] = f32::MIN_POSITIVE,
        |records| records.corners.truncate(3),
    ];
    for (index, fault) in faults.iter().enumerate() {
        let mut faulty = good.clone();
        fault(&mut faulty);
        if compare(&good, &faulty).is_ok() {
            return Err(format!("fault {index} was not found"));
        }
    }
    Ok(())
}
