//! Turns the numbers of listed blocks into the dispatches and the draws that work on them.

use contrejour_layout::{BLOCK_SIZE, DispatchArgs, DrawArgs, LIT_WORDS_PER_BLOCK, SeatCounters, ViewBundle};

use crate::group_args::groups_for;

/// From one seat's draws to the next one's: what one view binds begins at a multiple of 256 bytes.
const DRAW_STRIDE: usize = 256 / size_of::<DrawArgs>();

/// The stage `write_item_args`: counts to dispatches and draws.
pub struct WriteItemArgs<'a> {
    /// How many blocks there are for each view.
    pub bundle: &'a ViewBundle,
    /// How many are listed.
    pub counters: &'a [SeatCounters],
    /// Of half blocks of faces, of blocks of edges.
    pub item_args: &'a mut [DispatchArgs],
    /// Of each seat the first is of the faces, the fourth of those with a mask; the others stay as they are.
    pub draw_args: &'a mut [DrawArgs],
}

impl WriteItemArgs<'_> {
    /// Does what the dispatch does.
    ///
    /// # Panics
    ///
    /// When there is no room for the arguments.
    pub fn run(self) {
        let seats = self.bundle.shape.seat_count as usize;
        let draw =
            |items: u32| DrawArgs { vertex_count: items * BLOCK_SIZE * 3, instance_count: 1, ..DrawArgs::default() };
        for ((view, SeatCounters { counts, .. }), seat) in self.bundle.views.iter().zip(self.counters).zip(0..seats) {
            self.draw_args[seat * DRAW_STRIDE] = draw(counts.face_items.min(view.face_block_count));
            self.draw_args[seat * DRAW_STRIDE + 3] = draw(counts.masked_items.min(view.face_block_count));
        }
        let views = &self.bundle.views[..seats];
        let edge_blocks = views.iter().map(|view| view.edge_block_count).max().unwrap_or(0);
        let face_tests = self.counters[0].face_tests.min(views[0].face_block_count);
        self.item_args[0] = groups_for(face_tests * LIT_WORDS_PER_BLOCK);
        self.item_args[1] = groups_for(self.counters[0].edge_tests.min(edge_blocks) * BLOCK_SIZE);
    }
}
