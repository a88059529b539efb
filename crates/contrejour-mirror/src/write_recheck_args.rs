//! Turns the number of words with faces to recheck into a dispatch.

use contrejour_layout::{DispatchArgs, FACES_PER_WORD, LIT_WORDS_PER_BLOCK, SeatCounters, ViewBundle};

use crate::group_args::groups_for;

/// The bindings of `write_recheck_args`.
pub struct WriteRecheckArgs<'a> {
    /// How many blocks of faces there are.
    pub bundle: &'a ViewBundle,
    /// How many words have faces to recheck.
    pub counters: &'a [SeatCounters],
    /// The dispatch of `recheck_faces`.
    pub recheck_args: &'a mut [DispatchArgs],
}

impl WriteRecheckArgs<'_> {
    /// Does what the dispatch does.
    pub fn run(self) {
        let room = self.bundle.views[0].face_block_count * LIT_WORDS_PER_BLOCK * self.bundle.shape.seat_count;
        let words = self.counters[0].recheck_words.min(room);
        self.recheck_args[0] = groups_for(words * FACES_PER_WORD);
    }
}

#[cfg(test)]
mod tests {
    use contrejour_layout::LightView;

    use super::*;

    fn args(words: u32) -> DispatchArgs {
        let bundle = ViewBundle::of_one(&LightView { face_block_count: 1 << 20, ..Default::default() });
        let counters = [SeatCounters { recheck_words: words, ..Default::default() }];
        let mut recheck_args = [DispatchArgs::default()];
        WriteRecheckArgs { bundle: &bundle, counters: &counters, recheck_args: &mut recheck_args }.run();
        recheck_args[0]
    }

    #[test]
    fn a_workgroup_has_two_words() {
        assert_eq!(args(0), DispatchArgs { x: 0, y: 0, z: 1 });
        assert_eq!(args(2), DispatchArgs { x: 1, y: 1, z: 1 });
        assert_eq!(args(3), DispatchArgs { x: 2, y: 1, z: 1 });
        assert_eq!(args(2 * 65_535 + 1), DispatchArgs { x: 65_535, y: 2, z: 1 });
    }
}
