//! Lists the blocks of faces and of edges whose casters cast for the view.

use contrejour_layout::{BLOCK_MASKED, CasterLight, Counters, LightView, NO_CASTER, WorkItem};

/// The stage `list_blocks`: blocks of all casters to the work items of those that cast.
pub struct ListBlocks<'a> {
    /// How many blocks there are.
    pub view: &'a LightView,
    /// The light as each caster sees it.
    pub caster_lights: &'a [CasterLight],
    /// Blocks of faces of all casters, and some that are nobody's.
    pub face_blocks: &'a [WorkItem],
    /// Blocks of edges of all casters, and some that are nobody's.
    pub edge_blocks: &'a [WorkItem],
    /// Those whose caster casts: `counters.face_items` records from the front, and `counters.masked_items` from the back.
    pub face_items: &'a mut [WorkItem],
    /// Those whose caster casts: `counters.edge_items` records.
    pub edge_items: &'a mut [WorkItem],
    /// Counts work items.
    pub counters: &'a mut Counters,
}

impl ListBlocks<'_> {
    /// Does what the whole dispatch does.
    ///
    /// # Panics
    ///
    /// When a block names a caster that does not exist, or a list has no room.
    pub fn run(self) {
        let casts =
            |block: &&WorkItem| block.caster != NO_CASTER && self.caster_lights[block.caster as usize].casts != 0;
        let list = |blocks: &[WorkItem], items: &mut [WorkItem], count: &mut u32| {
            for block in blocks.iter().filter(casts) {
                items[*count as usize] = *block;
                *count += 1;
            }
        };
        let faces = &self.face_blocks[..self.view.face_block_count as usize];
        let edges = &self.edge_blocks[..self.view.edge_block_count as usize];
        let (masked, plain): (Vec<WorkItem>, Vec<WorkItem>) =
            faces.iter().partition(|block| block.kind == BLOCK_MASKED);
        list(&plain, self.face_items, &mut self.counters.face_items);
        for block in masked.iter().filter(casts) {
            self.counters.masked_items += 1;
            self.face_items[faces.len() - self.counters.masked_items as usize] = *block;
        }
        list(edges, self.edge_items, &mut self.counters.edge_items);
    }
}
