//! The CPU twin of every compute stage of contrejour: plain functions over layout slices, no wgpu, one thread.
//!
//! A stage `shaders/compute/<stage>.wgsl` has its twin in the module `<stage>`, which holds one struct, named like the
//! stage: its fields are the stage's bindings, same names, same order.
//!
//! - `read` storage is `&[T]`, `read_write` storage is `&mut [T]`, a single struct is `&T` or `&mut T`;
//!   atomic words are plain words.
//! - `run(self)` does what the whole dispatch does: invocations one after the other, in ascending order. Lists that the
//!   GPU fills by atomics come out in that order; compare them sorted by id.
//!
//! ```
//! use contrejour_layout::{Counters, DispatchArgs, LightView};
//! use contrejour_mirror::WriteExtrudeArgs;
//!
//! let view = LightView { silhouette_capacity: 1000, ..Default::default() };
//! let counters = Counters { silhouette_edges: 65, ..Default::default() };
//! let mut extrude_args = [DispatchArgs::default(); 2];
//! WriteExtrudeArgs { view: &view, counters: &counters, extrude_args: &mut extrude_args }.run();
//! assert_eq!(extrude_args[0], DispatchArgs { x: 2, y: 1, z: 1 });
//! ```

mod build_corners;
mod bundle;
mod caster_position;
mod classify_faces;
mod deform_positions;
mod detect_silhouette;
mod edge_image;
mod extrude_edges;
mod facing;
mod frame;
mod group_args;
mod image_plane;
mod light_outline;
mod list_blocks;
mod place_casters;
mod recheck_faces;
mod refine_faces;
mod resolve_faces;
#[cfg(test)]
mod test_scene;
mod view_depth;
mod wide_integer;
mod write_draw_args;
mod write_extrude_args;
mod write_item_args;
mod write_recheck_args;
mod write_refine_args;

pub use build_corners::BuildCorners;
pub use classify_faces::ClassifyFaces;
pub use deform_positions::DeformPositions;
pub use detect_silhouette::DetectSilhouette;
pub use extrude_edges::ExtrudeEdges;
pub use frame::{FrameInputs, FrameOutputs, run_facing, run_frame};
pub use list_blocks::ListBlocks;
pub use place_casters::PlaceCasters;
pub use recheck_faces::RecheckFaces;
pub use refine_faces::RefineFaces;
pub use resolve_faces::ResolveFaces;
pub use write_draw_args::WriteDrawArgs;
pub use write_extrude_args::WriteExtrudeArgs;
pub use write_item_args::WriteItemArgs;
pub use write_recheck_args::WriteRecheckArgs;
pub use write_refine_args::WriteRefineArgs;
