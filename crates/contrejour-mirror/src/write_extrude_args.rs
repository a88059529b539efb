//! Turns the number of silhouette edges into the dispatches of `extrude_edges` and `build_corners`.

use contrejour_layout::{Counters, DispatchArgs, LightView};

use crate::group_args::groups_for;

/// The stage `write_extrude_args`: counts to indirect dispatches.
pub struct WriteExtrudeArgs<'a> {
    /// The room in the list of silhouette edges.
    pub view: &'a LightView,
    /// How many silhouette edges there are.
    pub counters: &'a Counters,
    /// For the edges, for their ends.
    pub extrude_args: &'a mut [DispatchArgs],
}

impl WriteExtrudeArgs<'_> {
    /// Does what the whole dispatch does.
    ///
    /// # Panics
    ///
    /// When `extrude_args` has less than two records.
    pub fn run(self) {
        let edge_count = self.counters.silhouette_edges.min(self.view.silhouette_capacity);
        self.extrude_args[0] = groups_for(edge_count);
        self.extrude_args[1] = groups_for(2 * edge_count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn edges_and_ends_have_their_groups() {
        let view = LightView { silhouette_capacity: 100, ..Default::default() };
        let mut extrude_args = [DispatchArgs::default(); 2];
        let counters = Counters { silhouette_edges: 33, ..Default::default() };
        WriteExtrudeArgs { view: &view, counters: &counters, extrude_args: &mut extrude_args }.run();
        assert_eq!(extrude_args, [DispatchArgs { x: 1, y: 1, z: 1 }, DispatchArgs { x: 2, y: 1, z: 1 }]);

        let counters = Counters { silhouette_edges: 1000, ..Default::default() };
        WriteExtrudeArgs { view: &view, counters: &counters, extrude_args: &mut extrude_args }.run();
        assert_eq!(extrude_args, [DispatchArgs { x: 2, y: 1, z: 1 }, DispatchArgs { x: 4, y: 1, z: 1 }]);
    }
}
