//! The harness of the tests: a shared device, stages run alone, meshes, lights, and comparers that can fail.

pub mod ask;
pub mod avenue;
pub mod ball;
pub mod chain;
pub mod changing_scene;
pub mod compare;
pub mod deform_frame;
pub mod deforming;
pub mod exhaust;
pub mod frame;
pub mod gpu;
pub mod harness;
pub mod hostile;
pub mod image_compare;
pub mod lights;
pub mod many_lights;
pub mod meshes;
pub mod mirror_run;
pub mod object_light;
pub mod pipeline;
pub mod planted;
pub mod random;
pub mod ray_cast;
pub mod soft_edges;
pub mod stage_run;
pub mod texture;
