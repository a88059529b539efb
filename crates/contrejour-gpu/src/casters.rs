//! The casters of a scene: where they stand, and their records.

use contrejour_layout::{
    BLOCK_BY_PLANES, BLOCK_BY_POSITIONS, BLOCK_MASKED, BLOCK_SIZE, CASTER_NEVER, Caster, CasterPlace,
    LIT_WORDS_PER_BLOCK, OUTLINE_WORDS_PER_BLOCK, WorkItem,
};
use contrejour_plan::{CasterFacts, ObjectBox, PagePlan, caster_place};
use glam::DMat4;

use crate::error::CasterError;
use crate::pool::{MeshHandle, MeshPool, PooledMesh};
use crate::slots::{Key, Slots};

/// A mesh that casts. What receives shadows belongs here too: soft edges harden towards what is in the map, and over what
/// is not they are as soft at the contact as far away.
#[derive(Clone, Debug)]
pub struct CasterInput {
    /// Which mesh.
    pub mesh: MeshHandle,
    /// World space from the mesh's object space; affine. A singular matrix casts nothing, and is counted.
    pub world_from_object: DMat4,
    /// Where its positions are.
    pub positions: Positions,
}

/// Where a caster's positions are.
#[derive(Clone, Debug, Default)]
pub enum Positions {
    /// The positions that the mesh was built with.
    #[default]
    OfMesh,
    /// A buffer of the caller's, as another stage of the same encoder left it: one position for each source vertex of
    /// the mesh, in the same order. The mesh must be built for [deforming](contrejour_mesh::Motion::Deforming). Nobody
    /// knows when they change: each light makes its maps anew in each frame while there is such a caster.
    InBuffer {
        /// The buffer; needs `COPY_SRC`, since a copy on the device puts the positions beside the pooled ones.
        buffer: wgpu::Buffer,
        /// Where the first position starts, in bytes; a multiple of 4.
        offset: u64,
        /// From one position to the next, in bytes; a multiple of 4, at least 12.
        stride: u64,
    },
}

/// Names a caster.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct CasterHandle(pub(crate) Key);

impl CasterHandle {
    /// The index that records on the device call it by, such as [`SilhouetteEdge`](contrejour_layout::SilhouetteEdge).
    /// Casters that come later may have those of casters that are gone.
    pub fn index(self) -> usize {
        self.0.slot
    }
}

/// A caster of the scene.
#[derive(Debug)]
struct PlacedCaster {
    mesh: MeshHandle,
    /// Where positions are the caller's.
    live: Option<LivePositions>,
    place: CasterPlace,
    /// Box and matrix; `None` where nobody knows them.
    bounds: Option<ObjectBox>,
    has_faces: bool,
}

/// Positions that are copied from a buffer of the caller's.
#[derive(Clone, Debug)]
struct LivePositions {
    buffer: wgpu::Buffer,
    offset: u64,
    vertex_count: u32,
    stride_words: u32,
}

/// A copy of a caller's positions into the pool.
#[derive(Clone, Debug)]
pub(crate) struct LiveCopy {
    pub source: wgpu::Buffer,
    pub source_offset: u64,
    pub target_offset: u64,
    pub size: u64,
}

/// Records and blocks of a page, as they are uploaded.
#[derive(Clone, Debug, Default)]
pub(crate) struct CasterTable {
    /// One for each slot of the scene; zeros where no caster has work on the page.
    pub casters: Vec<Caster>,
    pub face_blocks: Vec<WorkItem>,
    pub edge_blocks: Vec<WorkItem>,
}

/// Where the words of a caster begin in the buffers that serve all pages.
#[derive(Clone, Copy, Debug)]
struct CasterWords {
    lit: u32,
    outline: u32,
    /// Where positions are the caller's.
    live: u32,
}

/// All casters of a scene.
#[derive(Debug, Default)]
pub(crate) struct Casters {
    slots: Slots<PlacedCaster>,
    /// Slots whose places are to be uploaded, in any order; some maybe twice.
    moved: Vec<usize>,
    /// Boxes that something was in or is in since the last upload; `None` is everywhere.
    touched: Vec<Option<ObjectBox>>,
}

impl Casters {
    /// # Errors
    ///
    /// The mesh is not one of these, or the buffer does not hold its positions.
    pub fn add(&mut self, input: &CasterInput, meshes: &MeshPool) -> Result<CasterHandle, CasterError> {
        let mesh = meshes.get(input.mesh).ok_or(CasterError::UnknownMesh { mesh: input.mesh })?;
        let live = live_positions(input, mesh)?;
        let has_faces = !mesh.topology.faces.is_empty();
        let mut caster =
            PlacedCaster { mesh: input.mesh, live, place: CasterPlace::default(), bounds: None, has_faces };
        caster.stand(&input.world_from_object, mesh);
        self.touched.push(caster.bounds);
        let key = self.slots.insert(caster);
        self.moved.push(key.slot);
        Ok(CasterHandle(key))
    }

    /// # Errors
    ///
    /// The caster is not one of these.
    pub fn place(
        &mut self,
        handle: CasterHandle,
        world_from_object: &DMat4,
        meshes: &MeshPool,
    ) -> Result<(), CasterError> {
        let caster = self.slots.get_mut(handle.0).ok_or(CasterError::UnknownCaster { caster: handle })?;
        let Some(mesh) = meshes.get(caster.mesh) else { return Err(CasterError::UnknownMesh { mesh: caster.mesh }) };
        let before = (caster.place, caster.bounds);
        caster.stand(world_from_object, mesh);
        if caster.place != before.0 {
            self.touched.extend([before.1, caster.bounds]);
            self.moved.push(handle.0.slot);
        }
        Ok(())
    }

    /// # Errors
    ///
    /// The caster is not one of these.
    pub fn remove(&mut self, handle: CasterHandle) -> Result<(), CasterError> {
        let caster = self.slots.remove(handle.0).ok_or(CasterError::UnknownCaster { caster: handle })?;
        self.touched.push(caster.bounds);
        self.moved.push(handle.0.slot);
        Ok(())
    }

    /// What a plan needs to know: who casts for a view is decided on the device, so not where they stand.
    pub fn facts(&self) -> Vec<CasterFacts> {
        let facts = |(slot, caster): (usize, &PlacedCaster)| CasterFacts {
            slot,
            name: format!("caster {slot}"),
            mesh: caster.mesh.0,
            bounds: None,
            own_position_words: caster.live.as_ref().map_or(0, LivePositions::words),
        };
        self.slots.iter().map(facts).collect()
    }

    /// Casters with a face whose matrix is singular.
    pub fn singular_count(&self) -> u32 {
        self.slots.iter().filter(|(_, caster)| caster.has_faces && caster.place.casts == CASTER_NEVER).count() as u32
    }

    /// Whether some positions may be others in each frame.
    pub fn have_live_positions(&self) -> bool {
        self.slots.iter().any(|(_, caster)| caster.live.is_some())
    }

    /// Boxes that something was in or is in since they were last taken; `None` is everywhere.
    pub fn touched(&self) -> &[Option<ObjectBox>] {
        &self.touched
    }

    /// Lets all places be uploaded again.
    pub fn move_all(&mut self) {
        self.moved = self.slots.iter().map(|(slot, _)| slot).collect();
    }

    /// Hands out the places that changed, as runs of records with their first slot, and forgets what was touched.
    pub fn take_moved(&mut self, mut upload: impl FnMut(usize, &[CasterPlace])) {
        self.touched.clear();
        self.moved.sort_unstable();
        self.moved.dedup();
        for run in self.moved.chunk_by(|slot, next| slot + 1 == *next) {
            let place = |slot: &usize| self.slots.at(*slot).map_or(CasterPlace::default(), |caster| caster.place);
            let places: Vec<_> = run.iter().map(place).collect();
            upload(run[0], &places);
        }
        self.moved.clear();
    }

    /// Copies of all positions that are the caller's: they follow the meshes' own in the pool, by ascending slot. What lies
    /// side by side in a buffer is one copy, so those of a deformer are few.
    pub fn live_copies(&self, meshes: &MeshPool) -> Vec<LiveCopy> {
        let mut next_word = meshes.position_words();
        let mut copies: Vec<LiveCopy> = Vec::new();
        for live in self.slots.iter().filter_map(|(_, caster)| caster.live.as_ref()) {
            let (target_offset, size) = (4 * next_word, 4 * live.words());
            next_word += live.words();
            match copies.last_mut() {
                Some(last) if last.source == live.buffer && last.source_offset + last.size == live.offset => {
                    last.size += size;
                }
                _ if size == 0 => {}
                _ => {
                    let source = live.buffer.clone();
                    copies.push(LiveCopy { source, source_offset: live.offset, target_offset, size });
                }
            }
        }
        copies
    }

    /// The tables of all pages. Their casters are indices into [`facts`](Self::facts).
    pub fn tables(&self, meshes: &MeshPool, pages: &[PagePlan]) -> Vec<CasterTable> {
        let dense: Vec<_> = self.slots.iter().collect();
        let words = words(&dense, meshes);
        pages.iter().map(|page| table(&dense, meshes, page, &words)).collect()
    }
}

fn words(casters: &[(usize, &PlacedCaster)], meshes: &MeshPool) -> Vec<CasterWords> {
    let mut next = CasterWords { lit: 0, outline: 0, live: meshes.position_words() as u32 };
    let words = |(_, caster): &(usize, &PlacedCaster)| {
        let words = next;
        next.live += caster.live.as_ref().map_or(0, LivePositions::words) as u32;
        if let Some(mesh) = meshes.get(caster.mesh) {
            next.lit += (mesh.topology.faces.len() as u32).div_ceil(BLOCK_SIZE) * LIT_WORDS_PER_BLOCK;
            next.outline += mesh.topology.candidate_edge_count.div_ceil(BLOCK_SIZE) * OUTLINE_WORDS_PER_BLOCK;
        }
        words
    };
    casters.iter().map(words).collect()
}

fn table(casters: &[(usize, &PlacedCaster)], meshes: &MeshPool, page: &PagePlan, words: &[CasterWords]) -> CasterTable {
    let places = meshes.places(page);
    let slot_count = casters.last().map_or(0, |(slot, _)| slot + 1);
    let mut table = CasterTable { casters: vec![Caster::default(); slot_count], ..CasterTable::default() };
    for here in &page.casters {
        let ((slot, caster), words) = (casters[here.caster], &words[here.caster]);
        let piece = &page.pieces[here.piece];
        let mut record = meshes.record(piece, &places[here.piece]);
        record.first_lit_word = words.lit;
        record.first_outline_word = words.outline;
        if let Some(live) = &caster.live {
            record.first_position_word = words.live;
            record.position_stride_words = live.stride_words;
        }
        table.casters[slot] = record;
        let blocks = |first: u32, blocks: u32| {
            let first_block = first / BLOCK_SIZE;
            let caster = slot as u32;
            (first_block..first_block + blocks).map(move |block| WorkItem { caster, block, kind: 0 })
        };
        let face_blocks = blocks(piece.first_face, piece.face_blocks()).map(|item| {
            let kind = if meshes.is_masked(caster.mesh) {
                BLOCK_MASKED
            } else if caster.live.is_some() || !meshes.has_planes(caster.mesh, item.block) {
                BLOCK_BY_POSITIONS
            } else {
                BLOCK_BY_PLANES
            };
            WorkItem { kind, ..item }
        });
        table.face_blocks.extend(face_blocks);
        if page.counts.edge_blocks > 0 {
            table.edge_blocks.extend(blocks(piece.first_edge, piece.edge_blocks()));
        }
    }
    table
}

impl PlacedCaster {
    fn stand(&mut self, world_from_object: &DMat4, mesh: &PooledMesh) {
        let (min, max) = (mesh.topology.bounds_min, mesh.topology.bounds_max);
        // Where positions are the caller's, the CPU does not know where they are.
        let is_known = self.live.is_none();
        self.bounds = is_known.then_some(ObjectBox { min, max, world_from_object: *world_from_object });
        self.place = if self.has_faces {
            caster_place(world_from_object, &mesh.near_one, is_known.then_some([min, max]))
        } else {
            CasterPlace { casts: CASTER_NEVER, ..CasterPlace::default() }
        };
    }
}

impl LivePositions {
    /// Words from the first position's start to the last one's end.
    fn words(&self) -> u64 {
        match self.vertex_count {
            0 => 0,
            count => u64::from(count - 1) * u64::from(self.stride_words) + 3,
        }
    }
}

/// Where a caster brings its own positions: checks the buffer and says how they lie.
fn live_positions(input: &CasterInput, mesh: &PooledMesh) -> Result<Option<LivePositions>, CasterError> {
    let Positions::InBuffer { buffer, offset, stride } = &input.positions else { return Ok(None) };
    let (offset, stride) = (*offset, *stride);
    let is_aligned =
        offset.is_multiple_of(4) && stride.is_multiple_of(4) && stride >= 12 && stride <= u64::from(u32::MAX);
    let vertex_count = mesh.topology.positions.len() as u32;
    let live = LivePositions { buffer: buffer.clone(), offset, vertex_count, stride_words: (stride / 4) as u32 };
    let needed = offset.saturating_add(4 * live.words());
    let available = buffer.size();
    let can_copy = buffer.usage().contains(wgpu::BufferUsages::COPY_SRC);
    if is_aligned && can_copy && needed <= available {
        return Ok(Some(live));
    }
    Err(CasterError::Positions { needed, available, offset, stride })
}
