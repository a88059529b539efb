//! The device of tests.

use std::env;

use contrejour_render::Gpu;

/// None where there is no device, unless `CONTREJOUR_REQUIRE_GPU=1` asks for one.
pub(crate) fn device() -> Option<Gpu> {
    match Gpu::open() {
        Ok(gpu) => Some(gpu),
        Err(error) if env::var("CONTREJOUR_REQUIRE_GPU").is_ok_and(|value| value == "1") => panic!("{error}"),
        Err(_) => None,
    }
}
