//! Silhouettes and smoothie soft shadows of any triangle mesh in wgpu compute shaders.
//!
//! The caller owns device, queue, encoder and submission. [`Shadows`] is made once; each frame it is
//! [prepared](Shadows::prepare) with the light and the casters and [records](Shadows::encode) its compute stages and
//! the passes that fill the light's maps into the caller's encoder. Three ways lead from there to a picture: a WGSL
//! function for forward renderers ([`Shadows::visibility_wgsl`]), a full-screen visibility texture for deferred ones
//! ([`Shadows::encode_visibility`]), or the [maps](Shadows::maps) and [buffers](Shadows::buffer) themselves.

mod casters;
mod compute;
mod device_watch;
mod draft;
mod error;
mod frame;
mod heartbeat;
mod inputs;
pub mod passes;
mod pieces;
mod pool;
mod raster;
mod readback;
mod resources;
pub mod shaders;
mod shadows;
pub mod stages;
mod timer;
mod visibility;
mod visibility_wgsl;
mod wgsl;

pub use casters::{CasterInput, Positions};
pub use contrejour_plan::VisibilityKind;
pub use error::{AddMeshError, CountersError, DeviceError, NewShadowsError, PrepareError};
pub use heartbeat::poll;
pub use inputs::{FrameInput, FrameStats, Maps, ShadowOptions, device_facts};
pub use pieces::mesh_pieces;
pub use pool::{MeshHandle, mesh_facts};
pub use shadows::Shadows;
pub use timer::{PassTimer, Untimed};
pub use visibility::EyeInput;
