//! What a frame of contrejour does: light views and the frame plan, without a device.

mod light;

pub use light::*;
