//! Silhouettes and smoothie soft shadows of any triangle mesh in wgpu compute shaders.
//!
//! The caller owns device, queue, encoder and submission. [`Shadows`] is made once for a scene; meshes, casters and lights
//! come, move and go by handles. Each frame it is [prepared](Shadows::prepare) and [records](Shadows::encode) the compute
//! stages and the passes that fill the lights' maps into the caller's encoder. Three ways lead from there to a picture: a WGSL
//! function for forward renderers ([`Shadows::visibility_wgsl`]), a full-screen visibility texture for deferred ones
//! ([`Shadows::encode_visibility`]), or the [maps](Shadows::maps) and [buffers](Shadows::buffer) themselves.

mod buffers;
mod caster_places;
mod caster_tables;
mod casters;
mod compute;
mod deformer;
mod device_watch;
mod encode;
mod error;
mod frame;
mod heartbeat;
mod inputs;
mod lights;
mod live_positions;
mod masks;
pub mod passes;
mod pieces;
mod pipelines;
mod pool;
mod pool_content;
mod prepare;
mod ranges;
mod raster;
mod readback;
mod receive;
mod records;
mod resources;
mod scene_buffers;
mod seats;
pub mod shaders;
mod shadows;
mod slots;
pub mod stages;
mod timer;
mod visibility;
mod visibility_wgsl;
mod wgsl;

pub use casters::{CasterHandle, CasterInput, KnownPositions, Positions};
pub use contrejour_plan::{ViewChoice, VisibilityKind};
pub use deformer::{
    AddDeformingError, DeformError, DeformHandle, DeformInput, Deformer, NewDeformerError, SetPoseError,
};
pub use encode::FilledView;
pub use error::{
    AddMeshError, CasterError, CountersError, DeviceError, NewShadowsError, PrepareError, RemoveMeshError,
    ShadowLightError,
};
pub use heartbeat::poll;
pub use inputs::{FrameStats, Maps, ShadowOptions, device_facts};
pub use lights::LightHandle;
pub use masks::mask_facts;
pub use pieces::{masked_mesh_facts, mesh_facts, mesh_pieces};
pub use pool::MeshHandle;
pub use shadows::Shadows;
pub use timer::{PassTimer, Untimed};
pub use visibility::EyeInput;
