//! Turns the numbers of quads and corners into indirect draws, clamped to what the lists hold.

use contrejour_layout::{Counters, DrawArgs, LightView, VERTICES_PER_CORNER, VERTICES_PER_QUAD};

/// The stage `write_draw_args`: counts to indirect draws.
pub struct WriteDrawArgs<'a> {
    /// The room in the lists of quads and corners.
    pub view: &'a LightView,
    /// How many quads and corners were needed.
    pub counters: &'a Counters,
    /// Of the quads, of the corners, behind that of the faces.
    pub draw_args: &'a mut [DrawArgs],
}

impl WriteDrawArgs<'_> {
    /// Does what the whole dispatch does.
    ///
    /// # Panics
    ///
    /// When `draw_args` has less than three records.
    pub fn run(self) {
        self.draw_args[1] = draw(VERTICES_PER_QUAD * self.counters.quads.min(self.view.quad_capacity));
        self.draw_args[2] = draw(VERTICES_PER_CORNER * self.counters.corners.min(self.view.corner_capacity));
    }
}

fn draw(vertex_count: u32) -> DrawArgs {
    DrawArgs { vertex_count, instance_count: 1, first_vertex: 0, first_instance: 0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_are_clamped_to_capacity() {
        let view = LightView { quad_capacity: 10, corner_capacity: 3, ..Default::default() };
        let counters = Counters { quads: 7, corners: 4, ..Default::default() };
        let mut draw_args = [DrawArgs::default(); 3];
        WriteDrawArgs { view: &view, counters: &counters, draw_args: &mut draw_args }.run();
        assert_eq!(draw_args, [DrawArgs::default(), draw(42), draw(36)]);
    }
}
