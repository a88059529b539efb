//! Records of casters and lists of their blocks, as they lie on the device.

use std::ops::Range;

use bytemuck::Pod;
use contrejour_layout::{
    BLOCK_BY_PLANES, BLOCK_BY_POSITIONS, BLOCK_MASKED, BLOCK_SIZE, Caster, LIT_WORDS_PER_BLOCK, NO_CASTER,
    OUTLINE_WORDS_PER_BLOCK, WorkItem,
};
use contrejour_plan::PagePlan;

use crate::casters::{Casters, PlacedCaster};
use crate::pool::{MeshPool, PlacedPiece};

/// Records and blocks of a page.
#[derive(Debug)]
pub(crate) struct CasterTable {
    /// One for each slot of the scene; zeros where no caster has work on the page.
    pub casters: Records<Caster>,
    pub face_blocks: Records<WorkItem>,
    pub edge_blocks: Records<WorkItem>,
}

/// Records, and which of them are to be written.
#[derive(Debug)]
pub(crate) struct Records<T> {
    items: Vec<T>,
    /// What is where nothing was put.
    filler: T,
    changed: Vec<Range<usize>>,
}

/// A block that no caster has.
const NOBODYS: WorkItem = WorkItem { caster: NO_CASTER, block: 0, kind: BLOCK_BY_PLANES };

impl<T: Pod> Records<T> {
    fn filled_with(filler: T) -> Self {
        Self { items: Vec::new(), filler, changed: Vec::new() }
    }

    /// Puts records where they belong.
    fn put(&mut self, first: usize, records: impl IntoIterator<Item = T>) {
        let mut end = first;
        for record in records {
            self.items.resize(self.items.len().max(end + 1), self.filler);
            self.items[end] = record;
            end += 1;
        }
        self.changed.push(first..end);
    }

    /// Forgets what is behind the last record that counts.
    fn truncate(&mut self, length: usize) {
        self.items.truncate(length);
    }

    /// Lets all be written.
    fn change_all(&mut self) {
        self.changed.clear();
        self.changed.push(0..self.items.len());
    }

    /// Hands out what changed, or all, as byte offsets and bytes; records side by side go together.
    pub fn take_changed(&mut self, all: bool, mut write: impl FnMut(u64, &[u8])) {
        if all {
            self.change_all();
        }
        let mut changed = std::mem::take(&mut self.changed);
        changed.sort_unstable_by_key(|range| range.start);
        let mut ranges = changed.into_iter().map(|range| range.start..range.end.min(self.items.len()));
        let mut last = ranges.next().unwrap_or_default();
        let mut put = |range: Range<usize>| {
            let offset = (range.start * size_of::<T>()) as u64;
            write(offset, bytemuck::cast_slice(self.items.get(range).unwrap_or_default()));
        };
        for range in ranges {
            if range.start <= last.end {
                last.end = last.end.max(range.end);
            } else {
                put(std::mem::replace(&mut last, range));
            }
        }
        put(last);
    }
}

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
            Some(mesh) if caster.live.is_none() && mesh.has_planes(block) => BLOCK_BY_PLANES,
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

#[cfg(test)]
mod tests {
    use super::*;

    fn changed(records: &mut Records<u32>, all: bool) -> Vec<(u64, Vec<u32>)> {
        let mut changed = Vec::new();
        records.take_changed(all, |offset, bytes| changed.push((offset / 4, bytemuck::pod_collect_to_vec(bytes))));
        changed.retain(|(_, records)| !records.is_empty());
        changed
    }

    #[test]
    fn what_changed_is_written_once_and_side_by_side() {
        let mut records = Records::filled_with(9);
        records.put(4, [1, 2]);
        records.put(1, [3]);
        assert_eq!(records.items, [9, 3, 9, 9, 1, 2]);
        records.put(2, [4, 5]);
        records.put(5, [6]);
        assert_eq!(changed(&mut records, false), [(1, vec![3, 4, 5, 1, 6])]);
        assert_eq!(changed(&mut records, false), []);
        records.put(0, [7]);
        records.put(3, [8]);
        assert_eq!(changed(&mut records, false), [(0, vec![7]), (3, vec![8])]);
        assert_eq!(changed(&mut records, true), [(0, vec![7, 3, 4, 8, 1, 6])]);
    }

    #[test]
    fn what_is_behind_the_end_is_not_written() {
        let mut records = Records::filled_with(9);
        records.put(0, [1, 2, 3, 4, 5, 6]);
        records.put(5, []);
        records.truncate(2);
        assert_eq!(changed(&mut records, false), [(0, vec![1, 2])]);
        records.put(4, [7]);
        records.truncate(0);
        assert_eq!(changed(&mut records, false), []);
    }
}
