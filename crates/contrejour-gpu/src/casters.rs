//! The casters of a scene: where they stand, and their records.

use std::collections::BTreeSet;
use std::ops::Range;

use contrejour_layout::{BLOCK_SIZE, CasterPlace};
use contrejour_plan::{BufferKind, CasterFacts, PoolHoles};
use glam::DMat4;

use crate::caster_places::Extent;
use crate::error::CasterError;
use crate::live_positions::{LivePositions, live_positions};
use crate::pool::{MeshHandle, MeshPool};
use crate::ranges::Ranges;
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
    /// the mesh, in the same order. The mesh must be built for [deforming](contrejour_mesh::Motion::Deforming).
    InBuffer {
        /// The buffer; needs `COPY_SRC`, since a copy on the device puts the positions beside the pooled ones.
        buffer: wgpu::Buffer,
        /// Where the first position starts, in bytes; a multiple of 4.
        offset: u64,
        /// From one position to the next, in bytes; a multiple of 4, at least 12.
        stride: u64,
        /// Which positions they are and where; `None` where nobody knows. Then they may be others in each frame, so each light
        /// that casts makes its maps anew in each frame, and they are worked on for each view.
        known: Option<KnownPositions>,
    },
}

/// What is known of the positions in a buffer, as [`Deformer::positions`](crate::Deformer::positions) gives it or a caller
/// with a stage of its own knows it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct KnownPositions {
    /// Another number whenever some of them are others than before. While it stays, lights keep their maps.
    pub version: u64,
    /// A box that holds them: its smallest and its largest corner, in object space. Views that can't see it leave the caster
    /// out, and lights that can't keep their maps.
    pub bounds: [[f32; 3]; 2],
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

/// A caster of the scene. Its places among blocks and positions are its own for as long as it is there.
#[derive(Debug)]
pub(crate) struct PlacedCaster {
    pub mesh: MeshHandle,
    /// Where positions are the caller's.
    pub live: Option<LivePositions>,
    pub world_from_object: DMat4,
    /// Where the latest frame has it.
    pub extent: Extent,
    pub has_faces: bool,
    /// Whether it has no faces, or a mask cuts them.
    is_named: bool,
    pub blocks: BlockPlaces,
    /// Whether it is in no table yet.
    pub is_new: bool,
}

/// Where the blocks of a caster lie in the lists of a scene of one page. Its lit bits and outline sides lie as they do, on
/// any number of pages.
#[derive(Clone, Debug, Default)]
pub(crate) struct BlockPlaces {
    pub faces: Range<u64>,
    pub edges: Range<u64>,
}

/// All casters of a scene.
#[derive(Debug, Default)]
pub(crate) struct Casters {
    pub(super) slots: Slots<PlacedCaster>,
    face_blocks: Ranges,
    edge_blocks: Ranges,
    /// Blocks that casters left since the tables were written.
    pub(super) left: Vec<BlockPlaces>,
    /// Whether casters came or went since then.
    pub(super) has_changed: bool,
    /// Slots of casters that came, went, moved or deformed since the last frame, in any order; some maybe twice.
    pub(super) moved: Vec<usize>,
    /// Records of where casters stand, by slot.
    pub(super) places: Vec<CasterPlace>,
    /// Slots whose records are to be uploaded.
    pub(super) stale_places: Vec<usize>,
    /// Where something was or is since the last upload.
    pub(super) touched: Vec<Extent>,
    /// Slots of casters with positions of their own.
    pub(super) live: BTreeSet<usize>,
    /// Slots of casters whose matrix is singular.
    pub(super) singular: BTreeSet<usize>,
}

impl Casters {
    /// # Errors
    ///
    /// The mesh is not one of these, or the buffer does not hold its positions.
    pub fn add(&mut self, input: &CasterInput, meshes: &mut MeshPool) -> Result<CasterHandle, CasterError> {
        let mesh = meshes.get(input.mesh).ok_or(CasterError::UnknownMesh { mesh: input.mesh })?;
        let mut caster = PlacedCaster {
            mesh: input.mesh,
            live: live_positions(input, mesh)?,
            world_from_object: input.world_from_object,
            extent: Extent::Nowhere,
            has_faces: !mesh.topology.faces.is_empty(),
            is_named: mesh.topology.faces.is_empty() || mesh.is_masked(),
            blocks: BlockPlaces::default(),
            is_new: true,
        };
        caster.take_places(meshes, [&mut self.face_blocks, &mut self.edge_blocks]);
        self.has_changed = true;
        let key = self.slots.insert(caster);
        self.moved.push(key.slot);
        Ok(CasterHandle(key))
    }

    /// # Errors
    ///
    /// The caster is not one of these.
    pub fn place(&mut self, handle: CasterHandle, world_from_object: &DMat4) -> Result<(), CasterError> {
        let caster = self.slots.get_mut(handle.0).ok_or(CasterError::UnknownCaster { caster: handle })?;
        if caster.world_from_object != *world_from_object {
            caster.world_from_object = *world_from_object;
            self.moved.push(handle.0.slot);
        }
        Ok(())
    }

    /// Takes over what is known of a caster's own positions.
    ///
    /// # Errors
    ///
    /// The caster is not one of these or has the positions of its mesh, or the box is none.
    pub fn note_positions(&mut self, handle: CasterHandle, known: &KnownPositions) -> Result<(), CasterError> {
        let caster = self.slots.get_mut(handle.0).ok_or(CasterError::UnknownCaster { caster: handle })?;
        let live = caster.live.as_mut().ok_or(CasterError::PositionsOfMesh { caster: handle })?;
        if live.take_over(known)? {
            self.moved.push(handle.0.slot);
        }
        Ok(())
    }

    /// # Errors
    ///
    /// The caster is not one of these.
    pub fn remove(&mut self, handle: CasterHandle, meshes: &mut MeshPool) -> Result<(), CasterError> {
        let caster = self.slots.remove(handle.0).ok_or(CasterError::UnknownCaster { caster: handle })?;
        if let Some(live) = &caster.live {
            meshes.give_back_position_words(live.first_word, live.words());
        }
        let BlockPlaces { faces, edges } = &caster.blocks;
        self.face_blocks.give_back(faces.start, faces.end - faces.start);
        self.edge_blocks.give_back(edges.start, edges.end - edges.start);
        self.left.push(caster.blocks);
        self.has_changed = true;
        self.touched.push(caster.extent);
        self.moved.push(handle.0.slot);
        Ok(())
    }

    /// How many stand on a mesh.
    pub fn count_on(&self, mesh: MeshHandle) -> usize {
        self.slots.iter().filter(|(_, caster)| caster.mesh == mesh).count()
    }

    /// Places all casters side by side, behind meshes that were just packed. For when nothing is in the tables.
    pub fn pack(&mut self, meshes: &mut MeshPool) {
        (self.face_blocks, self.edge_blocks) = Default::default();
        self.left.clear();
        for (_, caster) in self.slots.iter_mut() {
            caster.take_places(meshes, [&mut self.face_blocks, &mut self.edge_blocks]);
        }
    }

    /// Whether casters came or went since the tables were written.
    pub fn has_changed(&self) -> bool {
        self.has_changed
    }

    /// What is free between blocks.
    pub fn holes(&self) -> PoolHoles {
        let [face_blocks, edge_blocks] = [&self.face_blocks, &self.edge_blocks].map(Ranges::free);
        PoolHoles { face_blocks, edge_blocks, ..PoolHoles::default() }
    }

    /// How much of a list of blocks is used.
    pub fn used(&self, kind: BufferKind) -> Option<u64> {
        match kind {
            BufferKind::FaceBlocks => Some(self.face_blocks.used()),
            BufferKind::EdgeBlocks => Some(self.edge_blocks.used()),
            _ => None,
        }
    }

    /// Where the last blocks end, of faces and of edges.
    pub fn block_ends(&self) -> [u64; 2] {
        [self.face_blocks.end(), self.edge_blocks.end()]
    }

    /// What a plan needs to know: who casts for a view is decided on the device, so not where they stand. `meshes` are the
    /// meshes' indices by their slots.
    pub fn facts(&self, meshes: &[usize]) -> Vec<CasterFacts> {
        let facts = |(slot, caster): (usize, &PlacedCaster)| CasterFacts {
            slot,
            // A plan names those of which it leaves something out.
            name: if caster.is_named { format!("caster {slot}") } else { String::new() },
            mesh: meshes[caster.mesh.0.slot],
            bounds: None,
            own_position_words: caster.live.as_ref().map_or(0, LivePositions::words),
        };
        self.slots.iter().map(facts).collect()
    }
}

impl PlacedCaster {
    fn take_places(&mut self, meshes: &mut MeshPool, [face_blocks, edge_blocks]: [&mut Ranges; 2]) {
        if let Some(live) = &mut self.live {
            live.first_word = meshes.take_position_words(live.words());
        }
        let Some(mesh) = meshes.get(self.mesh) else { return };
        let take = |ranges: &mut Ranges, blocks: u64| {
            let first = ranges.take(blocks);
            first..first + blocks
        };
        self.blocks.faces = take(face_blocks, block_count(mesh.facts.faces));
        self.blocks.edges = take(edge_blocks, block_count(mesh.topology.candidate_edge_count));
    }
}

/// Blocks of this many faces or edges.
fn block_count(items: u32) -> u64 {
    items.div_ceil(BLOCK_SIZE).into()
}
