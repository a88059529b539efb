//! From the caller's casters to caster records and blocks.

use contrejour_layout::{BLOCK_SIZE, Caster, LIT_WORDS_PER_BLOCK, OUTLINE_WORDS_PER_BLOCK, WorkItem};
use contrejour_plan::PagePlan;
use glam::DMat4;

use crate::pool::{MeshHandle, MeshPool};

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

/// What decides the caster records and the blocks: they are written again only when this changes.
#[derive(Clone, Debug, Default, PartialEq)]
pub(crate) struct CasterSet {
    casters: Vec<CasterKey>,
    /// Words of the meshes' own positions, which those of the caller's buffers follow.
    pool_words: u64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct CasterKey {
    pub mesh: MeshHandle,
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

/// Records and blocks of a page, as they are uploaded.
#[derive(Clone, Debug, Default)]
pub(crate) struct CasterTable {
    /// One for each caster of the scene; zeros where it has no work on the page.
    pub casters: Vec<Caster>,
    pub face_blocks: Vec<WorkItem>,
    pub edge_blocks: Vec<WorkItem>,
}

/// Where the words of a caster begin in the buffers that serve all pages.
#[derive(Clone, Copy, Debug)]
struct CasterWords {
    lit: u32,
    outline: u32,
    /// Where positions are the caller's.
    live: u32,
}

impl CasterSet {
    pub fn new(casters: Vec<CasterKey>, pool_words: u64) -> Self {
        Self { casters, pool_words }
    }

    /// The tables of all pages.
    pub fn tables(&self, meshes: &MeshPool, pages: &[PagePlan]) -> Vec<CasterTable> {
        let words = self.words(meshes);
        pages.iter().map(|page| self.table(meshes, page, &words)).collect()
    }

    fn words(&self, meshes: &MeshPool) -> Vec<CasterWords> {
        let mut next = CasterWords { lit: 0, outline: 0, live: self.pool_words as u32 };
        let words = |key: &CasterKey| {
            let words = next;
            next.live += key.live.map_or(0, LivePositions::words) as u32;
            if let Some(mesh) = meshes.get(key.mesh) {
                next.lit += (mesh.topology.faces.len() as u32).div_ceil(BLOCK_SIZE) * LIT_WORDS_PER_BLOCK;
                next.outline += mesh.topology.candidate_edge_count.div_ceil(BLOCK_SIZE) * OUTLINE_WORDS_PER_BLOCK;
            }
            words
        };
        self.casters.iter().map(words).collect()
    }

    fn table(&self, meshes: &MeshPool, page: &PagePlan, words: &[CasterWords]) -> CasterTable {
        let places = meshes.places(page);
        let mut table = CasterTable { casters: vec![Caster::default(); self.casters.len()], ..CasterTable::default() };
        for here in &page.casters {
            let (key, words) = (&self.casters[here.caster], &words[here.caster]);
            let piece = &page.pieces[here.piece];
            let mut caster = meshes.record(piece, &places[here.piece]);
            caster.first_lit_word = words.lit;
            caster.first_outline_word = words.outline;
            if let Some(live) = key.live {
                caster.first_position_word = words.live;
                caster.position_stride_words = live.stride_words;
            }
            table.casters[here.caster] = caster;
            let blocks = |first: u32, blocks: u32| {
                let first_block = first / BLOCK_SIZE;
                let caster = here.caster as u32;
                (first_block..first_block + blocks).map(move |block| WorkItem { caster, block, by_positions: 0 })
            };
            let face_blocks = blocks(piece.first_face, piece.face_blocks()).map(|item| {
                let by_positions = key.live.is_some() || !meshes.has_planes(key.mesh, item.block);
                WorkItem { by_positions: by_positions.into(), ..item }
            });
            table.face_blocks.extend(face_blocks);
            if page.counts.edge_blocks > 0 {
                table.edge_blocks.extend(blocks(piece.first_edge, piece.edge_blocks()));
            }
        }
        table
    }
}
