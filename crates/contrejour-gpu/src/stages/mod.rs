//! The compute stages: one file each, named like its shader, its CPU twin and its test.

mod build_corners;
mod classify_faces;
mod deform_positions;
mod detect_silhouette;
mod extrude_edges;
mod list_blocks;
mod place_casters;
mod recheck_faces;
mod refine_faces;
mod resolve_faces;
mod write_draw_args;
mod write_extrude_args;
mod write_item_args;
mod write_recheck_args;
mod write_refine_args;

use contrejour_plan::{BufferKind, SceneStage, Stage};

/// What a compute stage runs. It binds [`Stage::buffers`] in their order, from binding 0 on.
#[derive(Clone, Copy, Debug)]
pub struct ComputeStage {
    /// Which stage this is; its name is the entry point.
    pub stage: Stage,
    /// The text of its shader module.
    pub wgsl: &'static str,
    /// Those of its buffers that it writes.
    pub writes: &'static [BufferKind],
    /// Where its number of workgroups comes from.
    pub dispatch: Dispatch,
}

/// What a compute stage runs that prepares a scene for all its lights. It binds storage buffers alone.
#[derive(Clone, Copy, Debug)]
pub struct SceneComputeStage {
    /// Which stage this is; its name is the entry point.
    pub stage: SceneStage,
    /// The text of its shader module.
    pub wgsl: &'static str,
}

/// Where the number of workgroups of a stage comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Dispatch {
    /// One invocation for each caster and each view, once for all pages.
    Casters,
    /// One invocation for each block of faces and for each block of edges, in workgroups of their own.
    Blocks,
    /// One workgroup.
    Once,
    /// Arguments that an earlier stage wrote: the buffer, and which of its entries.
    Indirect(BufferKind, u32),
}

/// The stages that run once a frame, before those of each light.
pub const SCENE: [SceneComputeStage; 1] = [deform_positions::DEFORM_POSITIONS];

/// All stages of a light in the order in which a frame runs them.
pub const ALL: [ComputeStage; 14] = [
    place_casters::PLACE_CASTERS,
    list_blocks::LIST_BLOCKS,
    write_item_args::WRITE_ITEM_ARGS,
    classify_faces::CLASSIFY_FACES,
    write_recheck_args::WRITE_RECHECK_ARGS,
    recheck_faces::RECHECK_FACES,
    write_refine_args::WRITE_REFINE_ARGS,
    refine_faces::REFINE_FACES,
    resolve_faces::RESOLVE_FACES,
    detect_silhouette::DETECT_SILHOUETTE,
    write_extrude_args::WRITE_EXTRUDE_ARGS,
    extrude_edges::EXTRUDE_EDGES,
    build_corners::BUILD_CORNERS,
    write_draw_args::WRITE_DRAW_ARGS,
];
