//! Turns the numbers of listed blocks into the dispatches and the draws that work on them.

use contrejour_layout::{BLOCK_SIZE, Counters, DispatchArgs, DrawArgs, LIT_WORDS_PER_BLOCK, LightView};

use crate::group_args::groups_for;

/// The stage `write_item_args`: counts to dispatches and draws.
pub struct WriteItemArgs<'a> {
    /// How many blocks there are.
    pub view: &'a LightView,
    /// How many are listed.
    pub counters: &'a Counters,
    /// Of the words of lit bits, of the blocks of edges.
    pub item_args: &'a mut [DispatchArgs],
    /// The first is of the faces, the fourth of those with a mask; the others stay as they are.
    pub draw_args: &'a mut [DrawArgs],
}

impl WriteItemArgs<'_> {
    /// Does what the dispatch does.
    ///
    /// # Panics
    ///
    /// When there is no room for the arguments.
    pub fn run(self) {
        let face_items = self.counters.face_items.min(self.view.face_block_count);
        let edge_items = self.counters.edge_items.min(self.view.edge_block_count);
        self.item_args[0] = groups_for(face_items * LIT_WORDS_PER_BLOCK);
        self.item_args[1] = groups_for(edge_items * BLOCK_SIZE);
        let masked_items = self.counters.masked_items.min(self.view.face_block_count);
        let draw =
            |items: u32| DrawArgs { vertex_count: items * BLOCK_SIZE * 3, instance_count: 1, ..DrawArgs::default() };
        self.draw_args[0] = draw(face_items);
        self.draw_args[3] = draw(masked_items);
    }
}
