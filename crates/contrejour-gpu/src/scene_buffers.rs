//! The buffers and pipelines that all lights share.

use std::collections::BTreeSet;
use std::iter::repeat;

use contrejour_layout::{BundleShape, CasterPlace};
use contrejour_plan::{BufferKind, BufferPlan, FramePlan, PagePlan};

use crate::buffers::{Buffers, MadeBuffer};
use crate::caster_tables::CasterTable;
use crate::casters::Casters;
use crate::live_positions::LiveCopy;
use crate::pipelines::Pipelines;
use crate::pool::{MeshPool, PlacedPiece};
use crate::pool_content::MESH_POOLS;
use crate::seats::{Seats, shapes};

/// Pools of meshes, records of casters, and the lists that are filled for one bundle of views after the other.
#[derive(Debug, Default)]
pub(crate) struct SceneBuffers {
    shared: Buffers,
    /// Those buffers as the plan lists them.
    made: Vec<BufferPlan>,
    pipelines: Pipelines,
    seats: Seats,
    /// How seats share the lists, page by page, as the device knows it.
    shapes: Vec<[BundleShape; 4]>,
    /// What lies in the pools, page by page.
    pages: Vec<PagePlan>,
    /// What lies in the lists of casters, page by page.
    tables: Vec<CasterTable>,
    has_planes: bool,
    has_edges: bool,
}

/// What [`SceneBuffers::follow`] did.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SetUp {
    /// Bytes that it uploaded.
    pub bytes: u64,
    /// Whether some buffers are not those that they were.
    pub has_new_buffers: bool,
}

/// What of the pools and lists is to be written.
#[derive(Debug)]
struct Stale {
    /// Buffers that hold nothing yet.
    empty: BTreeSet<(BufferKind, usize)>,
    /// All pieces of all pages; else those of new meshes.
    pieces: bool,
    /// The planes of all pieces.
    planes: bool,
    /// All records and blocks of casters; else those of casters that came and went.
    tables: bool,
}

/// Writes to buffers, where they are, and counts the bytes.
struct Upload<'a> {
    shared: &'a Buffers,
    queue: &'a wgpu::Queue,
    bytes: u64,
}

impl SceneBuffers {
    pub fn shared(&self) -> &Buffers {
        &self.shared
    }

    pub fn shared_and_pipelines(&mut self) -> (&Buffers, &mut Pipelines) {
        (&self.shared, &mut self.pipelines)
    }

    pub fn seats(&self) -> &Seats {
        &self.seats
    }

    /// The shared buffers as the last plan lists them.
    pub fn made(&self) -> &[BufferPlan] {
        &self.made
    }

    pub fn drop_unused(&mut self) {
        self.pipelines.drop_unused();
    }

    /// Drops the buffers and keeps the pipelines.
    pub fn drop_buffers(&mut self) {
        *self = Self { pipelines: std::mem::take(&mut self.pipelines), ..Self::default() };
    }

    /// Makes and fills what the plans of all lights list: they share it. What stays is not uploaded again: in a scene of one page
    /// it stays where it is, and goes with a buffer that grows by a copy on the device.
    pub fn follow(
        &mut self,
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        plans: &[FramePlan],
        (meshes, casters): (&mut MeshPool, &mut Casters),
    ) -> SetUp {
        let Some(plan) = plans.first() else {
            *self = Self::default();
            return SetUp { bytes: 0, has_new_buffers: true };
        };
        let listed = || plan.buffers.iter().filter(|buffer| !buffer.kind.is_of_light());
        let made = self.shared.follow(device, listed());
        let has_new_buffers = !made.is_empty();
        let have_one_page = self.pages.len() == 1 && plan.pages.len() == 1;
        let empty = keep_contents(device, queue, &self.shared, made, have_one_page);
        let stale = self.stale(plan, empty, have_one_page, (meshes, casters));

        let mut upload = Upload { shared: &self.shared, queue, bytes: 0 };
        let placed = meshes.placed(&plan.pages);
        upload.meshes(meshes, &placed, &stale, self.has_planes);
        casters.write_tables(&mut self.tables, stale.tables, meshes, (&plan.pages, &placed));
        upload.tables(&mut self.tables, &stale, self.has_edges);
        let shapes = shapes(plan);
        for ((shapes, before), page) in shapes.iter().zip(self.shapes.iter().map(Some).chain(repeat(None))).zip(0..) {
            let place = (BufferKind::BundleShapes, page);
            if before != Some(shapes) || stale.empty.contains(&place) {
                upload.write(place, 0, bytemuck::cast_slice(shapes));
            }
        }
        self.shapes = shapes;
        let bytes = upload.bytes;
        if stale.empty.contains(&(BufferKind::CasterPlaces, 0)) {
            casters.upload_all_places();
        }
        if stale.empty.contains(&(BufferKind::Positions, 0)) {
            casters.copy_all();
        }
        meshes.note_filled();
        self.made = listed().copied().collect();
        self.seats.follow(device, plans, (&self.shared, &mut self.pipelines), has_new_buffers);
        self.pages.clone_from(&plan.pages);
        SetUp { bytes, has_new_buffers }
    }

    /// Decides what is to be written, and notes which kinds are.
    fn stale(
        &mut self,
        plan: &FramePlan,
        empty: BTreeSet<(BufferKind, usize)>,
        have_one_page: bool,
        (meshes, casters): (&MeshPool, &Casters),
    ) -> Stale {
        let before = (self.has_planes, self.has_edges);
        // Where nobody reads planes, their buffer has no room for them.
        self.has_planes = plan.buffer(BufferKind::Planes).is_some_and(|planes| planes.items > 0);
        self.has_edges = plan.buffer(BufferKind::Edges).is_some();
        let pieces = !have_one_page && (meshes.has_changed() || !hold_the_same_pieces(&self.pages, &plan.pages));
        let casters_differ = || casters.has_changed() || !hold_the_same_casters(&self.pages, &plan.pages);
        // Blocks say whether their faces have planes.
        let has_other_kinds = (self.has_planes, self.has_edges) != before;
        let tables = has_other_kinds || !have_one_page && (pieces || casters_differ());
        Stale { empty, pieces, planes: pieces || self.has_planes && !before.0, tables }
    }

    /// Uploads the places of casters that moved; returns the bytes.
    pub fn upload_places(&self, queue: &wgpu::Queue, casters: &mut Casters) -> u64 {
        let mut bytes = 0;
        let buffer = self.shared.find(BufferKind::CasterPlaces, 0);
        let room = buffer.map_or(0, |buffer| buffer.size() as usize / size_of::<CasterPlace>());
        casters.take_places(|slot, places| {
            // A caster that was the last one may have left no room behind.
            let data: &[u8] = bytemuck::cast_slice(&places[..places.len().min(room.saturating_sub(slot))]);
            if let Some(buffer) = buffer.filter(|_| !data.is_empty()) {
                queue.write_buffer(buffer, (slot * size_of::<CasterPlace>()) as u64, data);
                bytes += data.len() as u64;
            }
        });
        bytes
    }

    /// Records the copies of positions that are the caller's.
    pub fn encode_copies(&self, encoder: &mut wgpu::CommandEncoder, copies: &[LiveCopy]) {
        let Some(target) = self.shared.find(BufferKind::Positions, 0) else { return };
        for copy in copies {
            encoder.copy_buffer_to_buffer(&copy.source, copy.source_offset, target, copy.target_offset, copy.size);
        }
    }
}

impl Upload<'_> {
    fn write(&mut self, (kind, page): (BufferKind, usize), offset: u64, data: &[u8]) {
        if let Some(buffer) = self.shared.find(kind, page).filter(|_| !data.is_empty()) {
            self.queue.write_buffer(buffer, offset, data);
            self.bytes += data.len() as u64;
        }
    }

    fn meshes(&mut self, meshes: &mut MeshPool, placed: &[Vec<PlacedPiece>], stale: &Stale, has_planes: bool) {
        let positions = (BufferKind::Positions, 0);
        meshes.write_positions(stale.empty.contains(&positions), |offset, data| self.write(positions, offset, data));
        for place in [BufferKind::Masks, BufferKind::MaskWords].map(|kind| (kind, 0)) {
            let all = stale.empty.contains(&place);
            meshes.masks().write(place.0, all, |offset, data| self.write(place, offset, data));
        }
        for (placed, page) in placed.iter().zip(0..) {
            for piece in placed {
                let is_new = stale.pieces || meshes.is_new(piece.slot);
                let planes = (BufferKind::Planes, page);
                if has_planes && (is_new || stale.planes || stale.empty.contains(&planes)) {
                    meshes.write_planes(piece, |offset, data| self.write(planes, offset, data));
                }
                for place in MESH_POOLS.map(|kind| (kind, page)) {
                    // What nobody binds is not worked out.
                    let is_made = self.shared.find(place.0, place.1).is_some();
                    if is_made && (is_new || stale.empty.contains(&place)) {
                        meshes.write_piece(place.0, piece, |offset, data| self.write(place, offset, data));
                    }
                }
            }
        }
    }

    fn tables(&mut self, tables: &mut [CasterTable], stale: &Stale, has_edges: bool) {
        for (CasterTable { casters, face_blocks, edge_blocks }, page) in tables.iter_mut().zip(0..) {
            let place = (BufferKind::Casters, page);
            casters.take_changed(stale.empty.contains(&place), |offset, data| self.write(place, offset, data));
            let place = (BufferKind::FaceBlocks, page);
            face_blocks.take_changed(stale.empty.contains(&place), |offset, data| self.write(place, offset, data));
            let place = (BufferKind::EdgeBlocks, page);
            edge_blocks.take_changed(stale.empty.contains(&place), |offset, data| {
                // Where no stage looks at edges there is no room for their blocks.
                if has_edges {
                    self.write(place, offset, data);
                }
            });
        }
    }
}

/// Copies what buffers held that were replaced, as far as it stays where it is; returns the places of those that hold
/// nothing. Meanwhile both are there.
fn keep_contents(
    device: &wgpu::Device,
    queue: &wgpu::Queue,
    shared: &Buffers,
    made: Vec<MadeBuffer>,
    have_one_page: bool,
) -> BTreeSet<(BufferKind, usize)> {
    let mut empty = BTreeSet::new();
    let mut encoder = None;
    for MadeBuffer { place: (kind, page), old } in made {
        let stays = holds_what_stays(kind) && (have_one_page || !kind.is_paged());
        let Some(old) = old.filter(|_| stays) else {
            empty.insert((kind, page));
            continue;
        };
        let new = shared.get(kind, page);
        let encoder = encoder.get_or_insert_with(|| device.create_command_encoder(&Default::default()));
        encoder.copy_buffer_to_buffer(&old, 0, new, 0, old.size().min(new.size()));
    }
    if let Some(encoder) = encoder {
        queue.submit([encoder.finish()]);
    }
    empty
}

/// Whether a buffer holds what was written when things came; the others are filled in each frame.
fn holds_what_stays(kind: BufferKind) -> bool {
    use BufferKind::{CasterPlaces, Casters, EdgeBlocks, FaceBlocks, MaskWords, Masks, Planes, Positions};
    MESH_POOLS.contains(&kind)
        || matches!(kind, Positions | Planes | Masks | MaskWords)
        || matches!(kind, Casters | CasterPlaces | FaceBlocks | EdgeBlocks)
}

fn hold_the_same_pieces(old: &[PagePlan], new: &[PagePlan]) -> bool {
    old.iter().map(|page| &page.pieces).eq(new.iter().map(|page| &page.pieces))
}

fn hold_the_same_casters(old: &[PagePlan], new: &[PagePlan]) -> bool {
    old.iter().map(|page| &page.casters).eq(new.iter().map(|page| &page.casters))
}
