//! A frame with a moving light uploads the same bytes for any mesh and waits for nothing.

use contrejour_gpu::ShadowOptions;
use contrejour_scene::shapes::Shape;
use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use contrejour_tests::lights::point;
use contrejour_tests::meshes::TestMesh;
use contrejour_tests::pipeline::Pipeline;
use glam::DVec3;
use libtest_mimic::Trial;

pub fn trials() -> Vec<Trial> {
    vec![gpu_trial("nothing_per_edge::uploads_do_not_grow_with_the_mesh", uploads_do_not_grow_with_the_mesh)]
}

fn uploads_do_not_grow_with_the_mesh(gpu: &Gpu) -> Outcome {
    let small = frame_bytes(gpu, 32, 16)?;
    let large = frame_bytes(gpu, 320, 160)?;
    if small == large && small.iter().all(|&bytes| (1..2000).contains(&bytes)) {
        return Ok(());
    }
    Err(format!("1 k faces upload {small:?} bytes a frame, 100 k faces {large:?}"))
}

/// Bytes of the frames after the ones that set up and grow.
fn frame_bytes(gpu: &Gpu, segments: u32, sides: u32) -> Result<Vec<u64>, String> {
    let shape = Shape::Torus { radius: 1.0, tube_radius: 0.35, segments, sides };
    let torus = shape.generate().map_err(|error| error.to_string())?;
    let mesh = TestMesh::generated("torus", &torus.positions, &torus.triangles);
    let mut pipeline = Pipeline::new(gpu, &mesh, &ShadowOptions::default())?;
    let mut bytes = Vec::new();
    for step in 0..8 {
        let (sine, cosine) = (0.2 * f64::from(step)).sin_cos();
        pipeline.complete_frame(&point(4.0 * DVec3::new(cosine, 1.0, sine), DVec3::ZERO, 2.0))?;
        if pipeline.shadows.stats().set_up_bytes == 0 {
            bytes.push(pipeline.shadows.stats().upload_bytes);
        }
    }
    if bytes.len() < 5 {
        Err(format!("only {} frames set nothing up", bytes.len()))
    } else {
        bytes.truncate(5);
        Ok(bytes)
    }
}
