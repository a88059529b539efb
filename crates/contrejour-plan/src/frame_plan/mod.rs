//! The frame plan: everything that a frame of one light does and holds, decided before anything is created.

mod buffer;
mod capacity;
mod decide;
mod display;
mod error;
mod facts;
mod left_out;
mod page;
mod pass;
mod pipeline;
mod plan;
mod room;
mod scene_stage;
mod seats;
mod shared_plans;
mod size_buffers;
mod stage;
mod texture;
mod visibility;

pub use buffer::{BufferKind, BufferPlan, Seating};
pub use capacity::Capacity;
pub use error::PlanError;
pub use facts::{CasterFacts, DeviceFacts, MaskFacts, MeshFacts, MeshPiece, Outputs, PoolHoles, SceneFacts};
pub use left_out::{LeftOut, Omitted, Reason};
pub use page::{PagePlan, PagedCaster};
pub use pass::Pass;
pub use pipeline::{EntryPoints, PipelinePlan};
pub use plan::{FramePlan, PlanInput};
pub use scene_stage::SceneStage;
pub use shared_plans::shared_plans;
pub use stage::Stage;
pub use texture::{TextureFormat, TextureKind, TexturePlan};
pub use visibility::{MapSampler, ViewChoice, VisibilityKind};
