//! Lists the blocks of faces and of edges whose casters cast for the views of a bundle.

use contrejour_layout::{
    BLOCK_MASKED, CasterLight, LightView, NO_CASTER, SeatCounters, TestItem, VIEW_TESTS, ViewBundle, WorkItem,
};

use crate::bundle::{caster_light_of, seats_in};

/// The stage `list_blocks`: blocks of all casters to those of the ones that cast: to draw for each view, and to test for all
/// views together.
pub struct ListBlocks<'a> {
    /// How many blocks there are for each view.
    pub bundle: &'a ViewBundle,
    /// The light of each seat as each caster sees it.
    pub caster_lights: &'a [CasterLight],
    /// Blocks of faces of all casters, and some that are nobody's.
    pub face_blocks: &'a [WorkItem],
    /// Blocks of edges of all casters, and some that are nobody's.
    pub edge_blocks: &'a [WorkItem],
    /// Of each seat those whose caster casts: `counters.face_items` records from the front, and `counters.masked_items` from
    /// the back.
    pub face_items: &'a mut [WorkItem],
    /// Those that are tested for some seat: `counters.face_tests` records.
    pub face_tests: &'a mut [TestItem],
    /// Those that are tested for some seat: `counters.edge_tests` records.
    pub edge_tests: &'a mut [TestItem],
    /// Counts blocks, for each seat and together.
    pub counters: &'a mut [SeatCounters],
}

impl ListBlocks<'_> {
    /// Does what the whole dispatch does.
    ///
    /// # Panics
    ///
    /// When a block names a caster that does not exist, or a list has no room.
    pub fn run(mut self) {
        for (block, index) in self.face_blocks.iter().zip(0..) {
            let seats = self.seats_that_list(block, index, |view| view.face_block_count);
            for seat in seats_in(self.bundle, seats) {
                self.list_to_draw(block, seat);
            }
            if block.kind != BLOCK_MASKED {
                let seats = seats & self.seats_that_test();
                list_to_test(block, seats, self.face_tests, &mut self.counters[0].face_tests);
            }
        }
        for (block, index) in self.edge_blocks.iter().zip(0..) {
            let seats = self.seats_that_list(block, index, |view| view.edge_block_count);
            for seat in seats_in(self.bundle, seats) {
                self.counters[seat].counts.edge_items += 1;
            }
            let seats = seats & self.seats_that_test();
            list_to_test(block, seats, self.edge_tests, &mut self.counters[0].edge_tests);
        }
    }

    fn seats_that_list(&self, block: &WorkItem, index: u32, count: impl Fn(&LightView) -> u32) -> u32 {
        let lists = |seat: &u32| {
            index < count(&self.bundle.views[*seat as usize])
                && block.caster != NO_CASTER
                && caster_light_of(self.bundle, self.caster_lights, *seat, block.caster).casts != 0
        };
        (0..self.bundle.shape.seat_count).filter(lists).map(|seat| 1 << seat).sum()
    }

    fn seats_that_test(&self) -> u32 {
        let tests = |seat: &u32| self.bundle.views[*seat as usize].flags & VIEW_TESTS != 0;
        (0..self.bundle.shape.seat_count).filter(tests).map(|seat| 1 << seat).sum()
    }

    fn list_to_draw(&mut self, block: &WorkItem, seat: usize) {
        let (view, counts) = (&self.bundle.views[seat], &mut self.counters[seat].counts);
        let of_seat = &mut self.face_items[seat * self.bundle.shape.item_stride as usize..];
        if block.kind == BLOCK_MASKED {
            counts.masked_items += 1;
            of_seat[(view.face_block_count - counts.masked_items) as usize] = *block;
        } else {
            of_seat[counts.face_items as usize] = *block;
            counts.face_items += 1;
        }
    }
}

fn list_to_test(block: &WorkItem, seats: u32, tests: &mut [TestItem], count: &mut u32) {
    if seats != 0 {
        let WorkItem { caster, block, kind } = *block;
        tests[*count as usize] = TestItem { caster, block, kind, seats };
        *count += 1;
    }
}
