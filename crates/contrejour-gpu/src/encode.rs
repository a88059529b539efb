//! Recording a frame: the views that are due have seats in turn, as many at once as there are.

use contrejour_plan::{BufferKind, Pass};

use crate::buffers::Buffers;
use crate::frame::Recorded;
use crate::lights::{LightHandle, LightState};
use crate::seats::{Seated, Seats};
use crate::shadows::Shadows;
use crate::timer::PassTimer;

impl Shadows {
    /// Records the frame: for each light whose maps do not stand, compute stages and the passes that fill them. Nothing is
    /// recorded for a light that saw no change since its maps were made.
    ///
    /// The encoder's commands must be submitted, or dropped together with this object.
    pub fn encode<T: PassTimer>(&mut self, encoder: &mut wgpu::CommandEncoder, timer: &mut T) {
        self.encode_each(encoder, timer, |_, _| ());
    }

    /// Records the frame as [`encode`](Self::encode) does, and calls `after` where a view's stages and passes are recorded:
    /// for commands of the caller's own that need its lists, before other views fill them anew.
    pub fn encode_each<T: PassTimer>(
        &mut self,
        encoder: &mut wgpu::CommandEncoder,
        timer: &mut T,
        mut after: impl FnMut(&mut wgpu::CommandEncoder, &FilledView<'_>),
    ) {
        (self.stats.dispatches_recorded, self.stats.draws_recorded) = (0, 0);
        let is_due = self.lights.iter().any(|(_, light)| light.is_due());
        if self.is_stale || !is_due {
            return;
        }
        self.buffers.encode_copies(encoder, &self.casters.take_live_copies());
        self.due.clear();
        for (key, light) in self.lights.iter_mut().filter(|(_, light)| light.is_due()) {
            self.due.extend((0..light.view_count()).map(|view| (key, view)));
        }
        let due = self.lights.iter().filter(|(_, light)| light.is_due());
        let counted_pages = due.map(|(_, light)| light.counted_pages()).sum();
        let mut counted = if counted_pages > 0 { self.readback.begin(counted_pages) } else { None };
        let (shared, seats) = (self.buffers.shared(), self.buffers.seats());
        let mut recorded = Recorded::default();
        let mut bundle: Vec<Seated<'_>> = Vec::with_capacity(seats.count());
        for views in self.due.chunks(seats.count().max(1)) {
            bundle.clear();
            bundle.extend(views.iter().filter_map(|&(key, view)| self.lights.get(key)?.seated(view)));
            seats.encode_tests(encoder, shared, &bundle, &mut recorded, timer);
            for (&(key, view), seat) in views.iter().zip(0..) {
                let Some(light) = self.lights.get(key) else { continue };
                let counted = counted.as_mut().map(|counted| (key, counted));
                light.encode_view(encoder, (shared, seats), (view, seat), counted, (&mut recorded, timer));
                let seat_count = views.len().next_power_of_two();
                let filled =
                    FilledView { light: LightHandle(key), view, seat, seat_count, state: light, shared, seats };
                after(encoder, &filled);
                self.last_seat = seat;
            }
        }
        let is_counted = counted.is_some();
        if let Some(counted) = counted {
            counted.finish(encoder);
        }
        self.lights
            .iter_mut()
            .filter(|(_, light)| light.is_due())
            .for_each(|(_, light)| light.note_recorded(is_counted));
        (self.stats.dispatches_recorded, self.stats.draws_recorded) = (recorded.dispatches, recorded.draws);
    }
}

/// A view whose lists are filled; see [`Shadows::encode_each`].
#[derive(Clone, Copy, Debug)]
pub struct FilledView<'a> {
    /// Whose view it is.
    pub light: LightHandle,
    /// Its index among the light's views.
    pub view: usize,
    /// Its seat among the views that are tested together.
    pub seat: usize,
    /// Seats of that bundle: how many [lit bits](BufferKind::Lit) a face has. [`lit_of_seat`](contrejour_layout::lit_of_seat)
    /// finds those of a view.
    pub seat_count: usize,
    state: &'a LightState,
    shared: &'a Buffers,
    seats: &'a Seats,
}

impl FilledView<'_> {
    /// What the view has in the buffers of a kind, page by page, as [`Shadows::buffers`] has them.
    pub fn buffers(&self, kind: BufferKind) -> impl Iterator<Item = wgpu::BufferSlice<'_>> {
        self.shared.parts(kind, self.seat)
    }

    /// Draws the triangles of a pass that filled the view's maps once more, by fragments of the caller's that bind nothing, to
    /// see or to count what its vertex stage made. `into` draws to a target as large as the maps, without a depth buffer. A
    /// pipeline is made for it: it is for tools and tests, not for a frame loop.
    ///
    /// Says whether the light's plan has the pass; nothing is drawn where it has not.
    pub fn draw_again(
        &self,
        device: &wgpu::Device,
        pass: Pass,
        fragment: &wgpu::FragmentState<'_>,
        into: &mut wgpu::RenderPass<'_>,
    ) -> bool {
        let Self { view, seat, state, shared, seats, .. } = *self;
        state.draw_again(device, (pass, fragment, into), (shared, seats), (view, seat))
    }
}
