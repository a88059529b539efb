//! Turns the numbers of listed blocks into the dispatches and the draw that work on them.

use contrejour_layout::{BLOCK_SIZE, Counters, DispatchArgs, DrawArgs, LIT_WORDS_PER_BLOCK, LightView};

use crate::group_args::groups_for;

/// The stage `write_item_args`: counts to dispatches and a draw.
pub struct WriteItemArgs<'a> {
    /// How many blocks there are.
    pub view: &'a LightView,
    /// How many are listed.
    pub counters: &'a Counters,
    /// Of the words of lit bits, of the blocks of edges.
    pub item_args: &'a mut [DispatchArgs],
    /// Of the faces; the entries behind it stay as they are.
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
        self.draw_args[0] =
            DrawArgs { vertex_count: face_items * BLOCK_SIZE * 3, instance_count: 1, ..DrawArgs::default() };
    }
}
