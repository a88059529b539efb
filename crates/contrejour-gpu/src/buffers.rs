//! Buffers, made exactly as frame plans list them.

use std::collections::BTreeMap;

use contrejour_layout::Counters;
use contrejour_plan::{BufferKind, BufferPlan, Seating};

/// Buffers that a plan lists, by kind and page.
#[derive(Debug, Default)]
pub(crate) struct Buffers {
    by_place: BTreeMap<(BufferKind, usize), (BufferPlan, wgpu::Buffer)>,
}

/// A buffer that was made.
#[derive(Debug)]
pub(crate) struct MadeBuffer {
    pub place: (BufferKind, usize),
    /// The one that it replaces, of another size.
    pub old: Option<wgpu::Buffer>,
}

impl Buffers {
    /// Makes what is listed and does not exist in that size, drops what is not listed; returns what was made.
    pub fn follow<'a>(
        &mut self,
        device: &wgpu::Device,
        listed: impl Iterator<Item = &'a BufferPlan>,
    ) -> Vec<MadeBuffer> {
        let mut old = std::mem::take(&mut self.by_place);
        let mut made = Vec::new();
        for plan @ BufferPlan { kind, page, bytes, .. } in listed {
            let place = (*kind, *page);
            let old = old.remove(&place);
            let is_alike = |old: &BufferPlan| (old.bytes, old.stride()) == (*bytes, plan.stride());
            if let Some((_, kept)) = old.as_ref().filter(|(old, _)| is_alike(old)) {
                self.by_place.insert(place, (*plan, kept.clone()));
                continue;
            }
            let buffer = device.create_buffer(&wgpu::BufferDescriptor {
                label: Some(kind.name()),
                size: *bytes,
                usage: usage(*kind),
                mapped_at_creation: false,
            });
            self.by_place.insert(place, (*plan, buffer));
            made.push(MadeBuffer { place, old: old.map(|(_, buffer)| buffer) });
        }
        made
    }

    pub fn is_empty(&self) -> bool {
        self.by_place.is_empty()
    }

    /// The buffer of a page, or the one that serves all pages.
    pub fn find(&self, kind: BufferKind, page: usize) -> Option<&wgpu::Buffer> {
        self.listed(kind, page).map(|(_, buffer)| buffer)
    }

    fn listed(&self, kind: BufferKind, page: usize) -> Option<&(BufferPlan, wgpu::Buffer)> {
        self.by_place.get(&(kind, if kind.is_paged() { page } else { 0 }))
    }

    /// The parts of a seat of the buffers of a kind, page by page; all of each where seats have no parts.
    pub fn parts(&self, kind: BufferKind, seat: usize) -> impl Iterator<Item = wgpu::BufferSlice<'_>> {
        let listed = self.by_place.range((kind, 0)..=(kind, usize::MAX));
        listed.map(move |(_, (plan, buffer))| part(plan, buffer, seat))
    }

    /// The part of a seat of a buffer that the plan lists.
    ///
    /// # Panics
    ///
    /// As [`get`](Self::get).
    pub fn part(&self, kind: BufferKind, page: usize, seat: usize) -> wgpu::BufferSlice<'_> {
        let (plan, buffer) = self.bound(kind, page);
        part(plan, buffer, seat)
    }

    /// The buffers of a kind, page by page.
    pub fn all(&self, kind: BufferKind) -> impl Iterator<Item = &wgpu::Buffer> {
        self.by_place.range((kind, 0)..=(kind, usize::MAX)).map(|(_, (_, buffer))| buffer)
    }

    /// A buffer that the plan lists, since it lists a stage that binds it.
    ///
    /// # Panics
    ///
    /// When the plan lists a stage without its buffers: a defect of the plan, which its tests rule out.
    pub fn get(&self, kind: BufferKind, page: usize) -> &wgpu::Buffer {
        &self.bound(kind, page).1
    }

    fn bound(&self, kind: BufferKind, page: usize) -> &(BufferPlan, wgpu::Buffer) {
        match self.listed(kind, page) {
            Some(listed) => listed,
            None => panic!("the frame plan lists no buffer `{}` for a stage that binds it", kind.name()),
        }
    }
}

fn part<'a>(plan: &BufferPlan, buffer: &'a wgpu::Buffer, seat: usize) -> wgpu::BufferSlice<'a> {
    if plan.kind.seating() != Seating::Apart {
        return buffer.slice(..);
    }
    let begin = seat as u64 * plan.stride();
    // Behind the counts of a view is what its bundle counted.
    let item_bytes =
        if plan.kind == BufferKind::Counters { size_of::<Counters>() as u64 } else { plan.kind.item_bytes() };
    buffer.slice(begin..begin + plan.items.max(1) * item_bytes)
}

/// Every buffer can be read back by tools and tests.
fn usage(kind: BufferKind) -> wgpu::BufferUsages {
    let common = wgpu::BufferUsages::COPY_SRC | wgpu::BufferUsages::COPY_DST;
    common
        | match kind {
            BufferKind::LightView | BufferKind::ViewBundle | BufferKind::ReceiverView => wgpu::BufferUsages::UNIFORM,
            BufferKind::ItemArgs
            | BufferKind::RecheckArgs
            | BufferKind::RefineArgs
            | BufferKind::ExtrudeArgs
            | BufferKind::DrawArgs => wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::INDIRECT,
            _ => wgpu::BufferUsages::STORAGE,
        }
}
