//! The small forward renderer behind the contrejour command line.
//!
//! [`Gpu::open`] finds a device without a window, [`Renderer`] brings a scene to it and draws it frame by frame:
//! diffuse and ambient light on interpolated normals, any number of lights with their shadows, four samples a pixel. It
//! uses the library as any renderer would.
//!
//! [`Judge`] holds one scene for many techniques: the points that its picture shows, the visibility that each technique
//! gives them and what that costs, and the picture that any visibility makes.

mod animated;
mod caster_meshes;
mod casters;
mod error;
mod filled_views;
mod frame_plan;
mod frame_uniforms;
mod full_screen;
mod gpu;
mod judge;
mod light_targets;
mod local_space;
mod map_texels;
mod map_views;
mod measurements;
mod picture_pass;
mod png;
mod posed_normals;
mod readback;
mod renderer;
mod save;
mod scene_lights;
mod scene_meshes;
mod scene_pass;
mod scene_pipeline;
mod scene_textures;
mod shaders;
mod silhouette_lines;
mod silhouettes;
mod stage_timer;
mod surface;
mod surface_light;
mod targets;
mod texture_levels;
mod tone_map;
mod views;

pub use animated::{AnimationError, DeformingMeshes};
pub use caster_meshes::CasterMeshError;
pub use casters::{CastShadowsError, PrepareShadowsError};
pub use error::{DrawError, NewRendererError};
pub use frame_plan::{FramePlanError, LightPlan, frame_plans};
pub use gpu::{DeviceFault, Gpu, OpenGpuError};
pub use judge::{
    ComposeError, Contestant, FrameCost, Judge, NewContestantError, NewJudgeError, Receiver, Receivers, TooManyFaces,
    rocked,
};
pub use local_space::LocalSpace;
pub use measurements::{Measurements, Spread, StageCost};
pub use png::save_png;
pub use readback::{ReadError, copied_buffer, read_buffer, read_rows, read_texture};
pub use renderer::Renderer;
pub use save::{SaveError, check_folder, save_file};
pub use scene_lights::MoveError;
pub use scene_meshes::{MeshTooLarge, UploadMeshesError};
pub use silhouettes::{find_silhouettes, had_room};
pub use stage_timer::{PassTime, StageTimer, TimedStage};
pub use targets::SizeTooLarge;
pub use tone_map::tone_mapped;
pub use views::View;
