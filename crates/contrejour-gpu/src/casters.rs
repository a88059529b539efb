//! From the caller's casters to caster records and work items.

use contrejour_layout::{BLOCK_SIZE, Caster, LIT_WORDS_PER_BLOCK, OUTLINE_WORDS_PER_BLOCK, WorkItem};
use glam::DMat4;

use crate::pool::{MeshHandle, MeshPool, MeshRange, PoolWords};

/// A mesh that casts in this frame. What receives shadows belongs here too: soft edges harden towards what is in the map,
/// and over what is not they are as soft at the contact as far away.
#[derive(Clone, Copy, Debug)]
pub struct CasterInput<'a> {
    /// Which mesh.
    pub mesh: MeshHandle,
    /// World space from the mesh's object space; affine. A singular matrix casts nothing, and is counted.
    pub world_from_object: DMat4,
    /// Where its positions are.
    pub positions: Positions<'a>,
}

/// Where a caster's positions are.
#[derive(Clone, Copy, Debug, Default)]
pub enum Positions<'a> {
    /// The positions that the mesh was built with.
    #[default]
    OfMesh,
    /// A buffer of the caller's, as another stage of the same encoder left it: one position for each source vertex of
    /// the mesh, in the same order. The mesh must be built for [deforming](contrejour_mesh::Motion::Deforming).
    InBuffer {
        /// The buffer; needs `COPY_SRC`, since a copy on the device puts the positions beside the pooled ones.
        buffer: &'a wgpu::Buffer,
        /// Where the first position starts, in bytes; a multiple of 4.
        offset: u64,
        /// From one position to the next, in bytes; a multiple of 4, at least 12.
        stride: u64,
    },
}

/// What decides the caster records and the work items: they are written again only when this changes.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct CasterSet {
    casters: Vec<CasterKey>,
    /// Words of the meshes' own positions, which those of the caller's buffers follow.
    pool: PoolWords,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CasterKey {
    pub mesh: MeshHandle,
    /// Whether it gets work items in this frame.
    pub is_active: bool,
    /// Vertices and words from one position to the next, where positions are the caller's.
    pub live: Option<LivePositions>,
}

/// Positions that are copied from a buffer of the caller's.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct LivePositions {
    pub vertex_count: u32,
    pub stride_words: u32,
}

impl LivePositions {
    /// Words from the first position's start to the last one's end.
    pub fn words(self) -> u64 {
        match self.vertex_count {
            0 => 0,
            count => u64::from(count - 1) * u64::from(self.stride_words) + 3,
        }
    }
}

/// Records and work items of a caster set, as they are uploaded.
#[derive(Clone, Debug, Default)]
pub(crate) struct CasterTable {
    pub casters: Vec<Caster>,
    pub face_items: Vec<WorkItem>,
    pub edge_items: Vec<WorkItem>,
}

impl CasterSet {
    pub fn new(casters: Vec<CasterKey>, pool: PoolWords) -> Self {
        Self { casters, pool }
    }

    pub fn table(&self, meshes: &MeshPool) -> CasterTable {
        let mut table = CasterTable::default();
        let mut next_live_word = self.pool.positions as u32;
        let (mut next_lit_word, mut next_outline_word) = (0, 0);
        for (key, index) in self.casters.iter().zip(0..) {
            let Some(range) = meshes.range(key.mesh) else { continue };
            let mut caster = record(range);
            caster.first_lit_word = next_lit_word;
            caster.first_outline_word = next_outline_word;
            if let Some(live) = key.live {
                caster.first_position_word = next_live_word;
                caster.position_stride_words = live.stride_words;
                next_live_word += live.words() as u32;
            }
            if key.is_active {
                let face_blocks = range.face_count.div_ceil(BLOCK_SIZE);
                let edge_blocks = range.edge_count.div_ceil(BLOCK_SIZE);
                table.face_items.extend((0..face_blocks).map(|block| WorkItem { caster: index, block }));
                table.edge_items.extend((0..edge_blocks).map(|block| WorkItem { caster: index, block }));
                next_lit_word += face_blocks * LIT_WORDS_PER_BLOCK;
                next_outline_word += edge_blocks * OUTLINE_WORDS_PER_BLOCK;
            }
            table.casters.push(caster);
        }
        table
    }
}

fn record(range: &MeshRange) -> Caster {
    Caster {
        first_position_word: range.first_position_word,
        position_stride_words: 3,
        first_face: range.first_face,
        face_count: range.face_count,
        first_edge: range.first_edge,
        edge_count: range.edge_count,
        first_incidence: range.first_incidence,
        first_vertex_offset_word: range.first_vertex_offset_word,
        first_vertex_edge_word: range.first_vertex_edge_word,
        first_lit_word: 0,
        first_outline_word: 0,
        position_scale: range.near_one.scale,
        position_origin: range.near_one.origin,
        unused_0: 0,
    }
}
