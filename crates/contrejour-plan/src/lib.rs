//! What a frame of contrejour does: light views and the frame plan, without a device.
//!
//! A [`Light`] has one to n [`View`]s; [`caster_light`] and the records of a view are what a frame uploads.
//! [`FramePlan`] lists the stages, passes, pipelines, buffers and textures of a frame, and what was left out.

mod falloff;
mod frame_plan;
mod light;
mod light_view;
mod settings;

pub use falloff::*;
pub use frame_plan::*;
pub use light::*;
pub use light_view::*;
pub use settings::*;
