//! What a frame of contrejour does: light views and the frame plan, without a device.

mod light;
mod light_view;
mod settings;

pub use light::*;
pub use light_view::*;
pub use settings::*;
