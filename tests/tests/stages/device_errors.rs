//! An error of wgpu that nobody asks for fails the test that made it.

use std::panic::{AssertUnwindSafe, catch_unwind};

use contrejour_tests::gpu::Gpu;
use contrejour_tests::harness::{Outcome, gpu_trial};
use libtest_mimic::Trial;

pub fn trials() -> Vec<Trial> {
    vec![gpu_trial("device_errors::fail_the_test_that_made_them", an_error_panics_with_its_text)]
}

fn an_error_panics_with_its_text(gpu: &Gpu) -> Outcome {
    let planted = catch_unwind(AssertUnwindSafe(|| {
        gpu.device.create_buffer(&wgpu::BufferDescriptor {
            label: Some("larger than any limit"),
            size: u64::MAX / 2,
            usage: wgpu::BufferUsages::STORAGE,
            mapped_at_creation: false,
        })
    }));
    let payload = planted.err().ok_or("a wrong buffer was made without an error")?;
    let text = payload.downcast_ref::<String>().ok_or("the panic has no text")?;
    if text.contains("larger than any limit") { Ok(()) } else { Err(format!("the text says something else: {text}")) }
}
