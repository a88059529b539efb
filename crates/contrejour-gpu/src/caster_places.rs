//! Where casters stand in a frame: their records on the device, and where something changed.

use contrejour_layout::{CASTER_NEVER, CasterPlace};
use contrejour_plan::{ObjectBox, caster_place};

use crate::casters::{Casters, PlacedCaster};
use crate::live_positions::LivePositions;
use crate::pool::MeshPool;

/// Where a caster may be seen.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Extent {
    /// No frame has it.
    Nowhere,
    /// In a box.
    Box(ObjectBox),
    /// Nobody knows where.
    Everywhere,
}

impl Casters {
    /// Makes the records of casters that moved, each once, however often that was since the last frame.
    pub fn stand(&mut self, meshes: &MeshPool) {
        self.moved.sort_unstable();
        self.moved.dedup();
        for &slot in &self.moved {
            let mut place = CasterPlace::default();
            let (mut is_live, mut is_singular) = (false, false);
            if let Some(caster) = self.slots.at_mut(slot) {
                let extent;
                (place, extent) = caster.stand(meshes);
                self.touched.extend([std::mem::replace(&mut caster.extent, extent), extent]);
                is_live = caster.live.is_some();
                is_singular = caster.has_faces && place.casts == CASTER_NEVER;
            }
            for (slots, is_one) in [(&mut self.live, is_live), (&mut self.singular, is_singular)] {
                if is_one {
                    slots.insert(slot)
                } else {
                    slots.remove(&slot)
                };
            }
            if slot >= self.places.len() {
                self.places.resize(slot + 1, CasterPlace::default());
            }
            self.places[slot] = place;
        }
        self.stale_places.append(&mut self.moved);
    }

    /// Where something was or is since places were last uploaded.
    pub fn touched(&self) -> &[Extent] {
        &self.touched
    }

    /// Whether some positions may be others in each frame, and nobody knows.
    pub fn have_unknown_positions(&self) -> bool {
        self.live.iter().filter_map(|&slot| self.slots.at(slot)?.live.as_ref()).any(LivePositions::are_unknown)
    }

    /// Casters with a face whose matrix is singular.
    pub fn singular_count(&self) -> u32 {
        self.singular.len() as u32
    }

    /// Lets all places be uploaded again.
    pub fn upload_all_places(&mut self) {
        self.stale_places = (0..self.places.len()).collect();
    }

    /// Hands out the places that changed, as runs of records with their first slot, and forgets what was touched.
    pub fn take_places(&mut self, mut upload: impl FnMut(usize, &[CasterPlace])) {
        self.touched.clear();
        self.stale_places.sort_unstable();
        self.stale_places.dedup();
        for run in self.stale_places.chunk_by(|slot, next| slot + 1 == *next) {
            upload(run[0], &self.places[run[0]..run[0] + run.len()]);
        }
        self.stale_places.clear();
    }
}

impl PlacedCaster {
    /// Its record, and where it may be seen.
    fn stand(&self, meshes: &MeshPool) -> (CasterPlace, Extent) {
        let never = CasterPlace { casts: CASTER_NEVER, ..CasterPlace::default() };
        let Some(mesh) = meshes.get(self.mesh).filter(|_| self.has_faces) else { return (never, Extent::Nowhere) };
        let world_from_object = self.world_from_object;
        let bounds = match &self.live {
            Some(live) => live.bounds(),
            None => Some([mesh.topology.bounds_min, mesh.topology.bounds_max]),
        };
        let in_box = |[min, max]: [[f32; 3]; 2]| Extent::Box(ObjectBox { min, max, world_from_object });
        (caster_place(&world_from_object, &mesh.near_one, bounds), bounds.map_or(Extent::Everywhere, in_box))
    }
}
