//! Turns the numbers of undecided faces into dispatches.

use contrejour_layout::{DispatchArgs, SeatCounters, ViewBundle};

use crate::bundle::undecided_capacity;
use crate::group_args::groups_for;

/// The bindings of `write_refine_args`.
pub struct WriteRefineArgs<'a> {
    /// Room in the list of undecided faces.
    pub bundle: &'a ViewBundle,
    /// How many faces are undecided.
    pub counters: &'a [SeatCounters],
    /// The dispatches of `refine_faces` and of `resolve_faces`.
    pub refine_args: &'a mut [DispatchArgs],
}

impl WriteRefineArgs<'_> {
    /// Does what the dispatch does.
    pub fn run(self) {
        let capacity = undecided_capacity(self.bundle);
        self.refine_args[0] = groups_for(self.counters[0].undecided_near.min(capacity));
        self.refine_args[1] = groups_for(self.counters[0].undecided_far.min(capacity));
    }
}

#[cfg(test)]
mod tests {
    use contrejour_layout::LightView;

    use super::*;

    fn args(near: u32, far: u32) -> [DispatchArgs; 2] {
        let bundle = ViewBundle::of_one(&LightView { undecided_capacity: u32::MAX, ..Default::default() });
        let counters = [SeatCounters { undecided_near: near, undecided_far: far, ..Default::default() }];
        let mut refine_args = [DispatchArgs::default(); 2];
        WriteRefineArgs { bundle: &bundle, counters: &counters, refine_args: &mut refine_args }.run();
        refine_args
    }

    #[test]
    fn nothing_undecided_dispatches_nothing() {
        assert_eq!(args(0, 0), [DispatchArgs { x: 0, y: 0, z: 1 }; 2]);
    }

    #[test]
    fn each_list_has_its_own_dispatch() {
        let [near, far] = args(64, 65);
        assert_eq!(near, DispatchArgs { x: 1, y: 1, z: 1 });
        assert_eq!(far, DispatchArgs { x: 2, y: 1, z: 1 });
    }

    #[test]
    fn more_groups_than_x_holds_are_folded() {
        let [near, _] = args(65_535 * 64 + 1, 0);
        assert_eq!(near, DispatchArgs { x: 65_535, y: 2, z: 1 });
    }
}
