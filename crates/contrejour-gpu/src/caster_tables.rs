//! Records of casters and lists of their blocks, as they lie on the device.

use contrejour_layout::{
    BLOCK_BY_PLANES, BLOCK_BY_POSITIONS, BLOCK_MASKED, BLOCK_OF_CALLER, BLOCK_SIZE, Caster, LIT_WORDS_PER_BLOCK,
    NO_CASTER, OUTLINE_WORDS_PER_BLOCK, WorkItem,
};
use contrejour_plan::PagePlan;

use crate::casters::{Casters, PlacedCaster};
use crate::pool::{MeshPool, PlacedPiece};
use crate::records::Records;

/// Records and blocks of a page.
#[derive(Debug)]
pub(crate) struct CasterTable {
    /// One for each slot of the scene; zeros where no caster has work on the page.
    pub casters: Records<Caster>,
    pub face_blocks: Records<WorkItem>,
    pub edge_blocks: Records<WorkItem>,
}

/// A block that no caster has.
const NOBODYS: WorkItem = WorkItem { caster: NO_CASTER, block: 0, kind: BLOCK_BY_PLANES };

impl Default for CasterTable {
    fn default() -> Self {
        let blocks = || Records::filled_with(NOBODYS);
        Self { casters: Records::filled_with(Caster::default()), face_blocks: blocks(), edge_blocks: blocks() }
    }
}

impl CasterTable {
    /// Lets everything be written.
    fn change_all(&mut self) {
        self.casters.change_all();
        self.face_blocks.change_all();
        self.edge_blocks.change_all();
    }
}

impl Casters {
    /// Brings the tables of all pages up to date: in a scene of one page by those that came and went; with `anew`, and so
    /// wherever there are more pages, all of it.
    pub fn write_tables(
        &mut self,
        tables: &mut Vec<CasterTable>,
        anew: bool,
        meshes: &MeshPool,
        (pages, placed): (&[PagePlan], &[Vec<PlacedPiece>]),
    ) {
        if anew {
            *tables = pages.iter().map(|_| CasterTable::default()).collect();
        }
        let is_one_page = pages.len() == 1;
        let casters: Vec<_> = self.slots.iter().collect();
        for ((table, page), placed) in tables.iter_mut().zip(pages).zip(placed) {
            if is_one_page && !anew {
                self.clear_left(table);
            }
            let mut next = [0, 0];
            for here in &page.casters {
                let (slot, caster) = casters[here.caster];
                if !anew && !caster.is_new {
                    continue;
                }
                if is_one_page {
                    next = [caster.blocks.faces.start, caster.blocks.edges.start].map(|start| start as usize);
                }
                next = table.put(slot, caster, (meshes, &placed[here.piece]), next);
            }
            table.casters.truncate(casters.last().map_or(0, |(slot, _)| slot + 1));
            if is_one_page {
                let [faces, edges] = self.block_ends().map(|end| end as usize);
                table.face_blocks.truncate(faces);
                table.edge_blocks.truncate(edges);
            }
            if anew {
                table.change_all();
            }
        }
        self.left.clear();
        self.has_changed = false;
        self.slots.iter_mut().for_each(|(_, caster)| caster.is_new = false);
    }

    /// Leaves blocks that were somebody's to nobody: they would name whoever gets the slot.
    fn clear_left(&self, table: &mut CasterTable) {
        for left in &self.left {
            table.face_blocks.put(left.faces.start as usize, left.faces.clone().map(|_| NOBODYS));
            table.edge_blocks.put(left.edges.start as usize, left.edges.clone().map(|_| NOBODYS));
        }
    }
}

impl CasterTable {
    /// Puts a caster's record and the blocks of one of its pieces; returns where those end.
    fn put(
        &mut self,
        slot: usize,
        caster: &PlacedCaster,
        (meshes, placed): (&MeshPool, &PlacedPiece),
        [first_face_block, first_edge_block]: [usize; 2],
    ) -> [usize; 2] {
        let mut record = meshes.record(placed);
        record.first_lit_word = (caster.blocks.faces.start * u64::from(LIT_WORDS_PER_BLOCK)) as u32;
        record.first_outline_word = (caster.blocks.edges.start * u64::from(OUTLINE_WORDS_PER_BLOCK)) as u32;
        if let Some(live) = &caster.live {
            record.first_position_word = live.first_word as u32;
            record.position_stride_words = live.stride_words;
        }
        self.casters.put(slot, [record]);

        let piece = &placed.piece;
        let mesh = meshes.get(caster.mesh);
        let kind = |block: u32| match mesh {
            Some(mesh) if mesh.is_masked() => BLOCK_MASKED,
            _ if caster.live.is_some() => BLOCK_OF_CALLER,
            Some(mesh) if mesh.has_planes(block) => BLOCK_BY_PLANES,
            _ => BLOCK_BY_POSITIONS,
        };
        let blocks = |first: u32, count: u32| {
            let first = first / BLOCK_SIZE;
            (first..first + count).map(|block| WorkItem { caster: slot as u32, block, kind: BLOCK_BY_PLANES })
        };
        let faces = blocks(piece.first_face, piece.face_blocks());
        let faces = faces.map(|item| WorkItem { kind: kind(item.block), ..item });
        self.face_blocks.put(first_face_block, faces);
        self.edge_blocks.put(first_edge_block, blocks(piece.first_edge, piece.edge_blocks()));
        [first_face_block + piece.face_blocks() as usize, first_edge_block + piece.edge_blocks() as usize]
    }
}
