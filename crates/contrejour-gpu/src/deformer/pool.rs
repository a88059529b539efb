//! Deforming meshes and their casters, and where they lie on the device: what stays keeps its places.

use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use contrejour_layout::{BLOCK_SIZE, DeformBlock, Influence, JointMatrix, MorphDelta, RestVertex};
use contrejour_mesh::DeformingMesh;

use super::pose::DevicePose;
use super::{AddDeformingError, DeformHandle};
use crate::casters::KnownPositions;
use crate::ranges::Ranges;
use crate::records::Records;

/// Vertices, influences and morph deltas of meshes, then joints and morph weights of casters.
pub(super) type PerPool<T> = [T; 5];

/// The pools, with the size of a record.
pub(super) const POOLS: PerPool<(&str, u64)> = [
    ("vertices", size_of::<RestVertex>() as u64),
    ("influences", size_of::<Influence>() as u64),
    ("morph deltas", size_of::<MorphDelta>() as u64),
    ("joints", size_of::<JointMatrix>() as u64),
    ("morph weights", size_of::<f32>() as u64),
];

/// How many of the pools hold what was written when meshes came.
pub(super) const MESH_POOLS: usize = 3;

/// Words of a position.
const POSITION_WORDS: u64 = 3;

/// All casters, by their handles, with their meshes.
#[derive(Debug)]
pub(super) struct Pool {
    pub casters: BTreeMap<DeformHandle, DeformingCaster>,
    /// Each once, however many casters share it, by its address.
    pub meshes: BTreeMap<usize, SharedMesh>,
    places: PerPool<Ranges>,
    /// By index; none where the last caster left.
    pub batches: Vec<Option<Batch>>,
    /// The poses of all casters, in their places.
    pub joint_matrices: Records<JointMatrix>,
    pub morph_weights: Records<f32>,
    /// How often a pose was another one than before.
    versions: u64,
    /// Whether casters came or went since [`note_written`](Self::note_written).
    pub has_changed: bool,
}

/// A mesh, and where it lies.
#[derive(Debug)]
pub(super) struct SharedMesh {
    pub mesh: Arc<DeformingMesh>,
    pub starts: PerPool<u64>,
    pub is_new: bool,
    casters: usize,
}

/// A caster, and where it lies.
#[derive(Debug)]
pub(super) struct DeformingCaster {
    pub mesh: Arc<DeformingMesh>,
    pub starts: PerPool<u64>,
    pub batch: usize,
    pub first_word: u64,
    /// Where its latest pose puts its vertices; none before it has any.
    pub latest: Option<KnownPositions>,
    /// Where the pose does that was uploaded last.
    pub known: Option<KnownPositions>,
    pub is_new: bool,
    blocks: Range<u64>,
}

/// Casters whose positions are in one buffer. That is never another one, so who reads them need not look again: where it
/// has no room, what comes begins another batch.
#[derive(Debug)]
pub(super) struct Batch {
    words: Ranges,
    blocks: Ranges,
    /// Words that its buffer holds; none before it is made.
    pub room: Option<u64>,
    pub records: Records<DeformBlock>,
    casters: usize,
}

impl Pool {
    /// Adds a caster.
    ///
    /// # Errors
    ///
    /// A buffer would have more than `most` bytes; then nothing has changed.
    pub fn add(&mut self, handle: DeformHandle, mesh: Arc<DeformingMesh>, most: u64) -> Result<(), AddDeformingError> {
        // Words are indexed too.
        let most = most.min(4 * u64::from(u32::MAX));
        self.check_sizes(&mesh, most)?;
        let caster = self.place(mesh, most / 4);
        self.casters.insert(handle, caster);
        self.has_changed = true;
        Ok(())
    }

    fn check_sizes(&self, mesh: &Arc<DeformingMesh>, most: u64) -> Result<(), AddDeformingError> {
        let is_known = self.meshes.contains_key(&key(mesh));
        let pools = (POOLS.iter().zip(&self.places).zip(lengths(mesh)).enumerate()).map(
            |(index, ((&(what, size), places), length))| {
                let is_there = is_known && index < MESH_POOLS;
                (what, size.saturating_mul(if is_there { places.end() } else { places.end_with(length) }))
            },
        );
        // A batch of its own has room for them.
        let blocks = ("blocks", block_count(mesh) * size_of::<DeformBlock>() as u64);
        let positions = ("positions", 4 * words(mesh));
        match pools.chain([blocks, positions]).find(|&(_, bytes)| bytes > most) {
            Some((what, bytes)) => Err(AddDeformingError::TooLarge { what, bytes, most }),
            None => Ok(()),
        }
    }

    /// Gives a caster its places, and its mesh where it is the first one of it.
    fn place(&mut self, mesh: Arc<DeformingMesh>, most_words: u64) -> DeformingCaster {
        let lengths = lengths(&mesh);
        let take = |places: &mut PerPool<Ranges>, pools: Range<usize>| {
            let mut starts = PerPool::default();
            pools.for_each(|pool| starts[pool] = places[pool].take(lengths[pool]));
            starts
        };
        let shared = self.meshes.entry(key(&mesh)).or_insert_with(|| SharedMesh {
            mesh: Arc::clone(&mesh),
            starts: take(&mut self.places, 0..MESH_POOLS),
            is_new: true,
            casters: 0,
        });
        shared.casters += 1;
        let mesh_starts = shared.starts;
        let starts = take(&mut self.places, MESH_POOLS..POOLS.len());

        let index = self.batch_for(words(&mesh), block_count(&mesh), most_words);
        let batch = self.batches[index].get_or_insert_with(Batch::default);
        batch.casters += 1;
        let first_word = batch.words.take(words(&mesh));
        let first_block = batch.blocks.take(block_count(&mesh));
        let blocks = first_block..first_block + block_count(&mesh);
        batch.records.put(first_block as usize, deform_blocks(&mesh, mesh_starts, starts, first_word));
        DeformingCaster { mesh, starts, batch: index, first_word, latest: None, known: None, is_new: true, blocks }
    }

    /// Gives a caster a pose; what it had already is not written again, and nobody asks for its `bounds`.
    pub fn set_pose(
        &mut self,
        handle: DeformHandle,
        pose: &DevicePose,
        bounds: impl FnOnce(&DeformingMesh) -> [[f32; 3]; 2],
    ) {
        let Some(caster) = self.casters.get_mut(&handle) else { return };
        let [joints, weights] = caster.pose_places();
        let DevicePose { joint_matrices, morph_weights } = pose;
        let is_same = are_same(self.joint_matrices.get(joints.clone()), joint_matrices)
            && are_same(self.morph_weights.get(weights.clone()), morph_weights);
        if is_same && caster.latest.is_some() {
            return;
        }
        self.joint_matrices.put(joints.start, joint_matrices.iter().copied());
        self.morph_weights.put(weights.start, morph_weights.iter().copied());
        self.versions += 1;
        caster.latest = Some(KnownPositions { version: self.versions, bounds: bounds(&caster.mesh) });
    }

    /// The first batch with room; its blocks are fewer bytes than its positions, but for tiny meshes.
    fn batch_for(&mut self, words: u64, blocks: u64, most_words: u64) -> usize {
        let most_blocks = 4 * most_words / size_of::<DeformBlock>() as u64;
        let has_room = |batch: &Option<Batch>| {
            batch.as_ref().is_some_and(|batch| {
                batch.words.end_with(words) <= batch.room.unwrap_or(most_words)
                    && batch.blocks.end_with(blocks) <= most_blocks
            })
        };
        let found = self.batches.iter().position(has_room);
        found.or_else(|| self.batches.iter().position(Option::is_none)).unwrap_or_else(|| {
            self.batches.push(None);
            self.batches.len() - 1
        })
    }

    /// Removes a caster; false where it was not there.
    pub fn remove(&mut self, handle: DeformHandle) -> bool {
        let Some(caster) = self.casters.remove(&handle) else { return false };
        self.has_changed = true;
        let lengths = lengths(&caster.mesh);
        let mut give_back = |starts: &PerPool<u64>, pools: Range<usize>| {
            pools.for_each(|pool| self.places[pool].give_back(starts[pool], lengths[pool]));
        };
        give_back(&caster.starts, MESH_POOLS..POOLS.len());
        if let Some(shared) = self.meshes.get_mut(&key(&caster.mesh)) {
            shared.casters -= 1;
            if shared.casters == 0 {
                give_back(&shared.starts, 0..MESH_POOLS);
                self.meshes.remove(&key(&caster.mesh));
            }
        }
        if let Some(batch) = &mut self.batches[caster.batch] {
            batch.words.give_back(caster.first_word, words(&caster.mesh));
            batch.blocks.give_back(caster.blocks.start, caster.blocks.end - caster.blocks.start);
            // A block of no vertices does nothing.
            batch.records.put(caster.blocks.start as usize, caster.blocks.clone().map(|_| DeformBlock::default()));
            batch.casters -= 1;
            if batch.casters == 0 {
                self.batches[caster.batch] = None;
            }
        }
        true
    }

    /// Places everything side by side. For when nothing is on the device.
    pub fn pack(&mut self, most: u64) {
        let before = std::mem::take(self);
        (self.has_changed, self.versions) = (true, before.versions);
        for (handle, caster) in before.casters {
            let [joints, weights] = caster.pose_places();
            let mut placed = self.place(caster.mesh, most.min(4 * u64::from(u32::MAX)) / 4);
            if caster.latest.is_some() {
                placed.latest = caster.latest;
                let [new_joints, new_weights] = placed.pose_places();
                self.joint_matrices.put(new_joints.start, before.joint_matrices.get(joints).iter().copied());
                self.morph_weights.put(new_weights.start, before.morph_weights.get(weights).iter().copied());
            }
            self.casters.insert(handle, placed);
        }
    }

    /// Where the last record of each pool ends.
    pub fn ends(&self) -> PerPool<u64> {
        self.places.each_ref().map(Ranges::end)
    }

    /// Notes that the latest poses are on the device.
    pub fn note_posed(&mut self) {
        self.casters.values_mut().for_each(|caster| caster.known = caster.latest);
    }

    /// Notes that everything is on the device.
    pub fn note_written(&mut self) {
        self.has_changed = false;
        self.meshes.values_mut().for_each(|mesh| mesh.is_new = false);
        self.casters.values_mut().for_each(|caster| caster.is_new = false);
    }
}

impl Default for Pool {
    fn default() -> Self {
        Self {
            casters: BTreeMap::new(),
            meshes: BTreeMap::new(),
            places: PerPool::default(),
            batches: Vec::new(),
            joint_matrices: Records::filled_with(JointMatrix::default()),
            morph_weights: Records::filled_with(0.0),
            versions: 0,
            has_changed: false,
        }
    }
}

impl DeformingCaster {
    /// Where its joint matrices and its morph weights lie.
    fn pose_places(&self) -> [Range<usize>; 2] {
        let [.., joints, weights] = self.starts.map(|start| start as usize);
        [joints..joints + self.mesh.joint_count() as usize, weights..weights + self.mesh.morph_count() as usize]
    }
}

impl Default for Batch {
    fn default() -> Self {
        let records = Records::filled_with(DeformBlock::default());
        Self { words: Ranges::default(), blocks: Ranges::default(), room: None, records, casters: 0 }
    }
}

impl Batch {
    /// Where its last position ends.
    pub fn word_end(&self) -> u64 {
        self.words.end()
    }
}

/// By their bits.
fn are_same<T: bytemuck::NoUninit>(some: &[T], others: &[T]) -> bool {
    bytemuck::cast_slice::<_, u8>(some) == bytemuck::cast_slice::<_, u8>(others)
}

fn key(mesh: &Arc<DeformingMesh>) -> usize {
    Arc::as_ptr(mesh).addr()
}

fn words(mesh: &DeformingMesh) -> u64 {
    POSITION_WORDS * mesh.vertices().len() as u64
}

fn block_count(mesh: &DeformingMesh) -> u64 {
    mesh.vertices().len().div_ceil(BLOCK_SIZE as usize) as u64
}

fn lengths(mesh: &DeformingMesh) -> PerPool<u64> {
    let [vertices, influences, morph_deltas] =
        [mesh.vertices().len(), mesh.influences().len(), mesh.morph_deltas().len()].map(|length| length as u64);
    [vertices, influences, morph_deltas, mesh.joint_count().into(), mesh.morph_count().into()]
}

/// The blocks of a caster; sizes were checked, so 32 bits hold all places.
fn deform_blocks(
    mesh: &DeformingMesh,
    [vertices, influences, morph_deltas, ..]: PerPool<u64>,
    [.., joints, morph_weights]: PerPool<u64>,
    first_word: u64,
) -> impl Iterator<Item = DeformBlock> {
    let vertex_count = mesh.vertices().len() as u32;
    (0..vertex_count).step_by(BLOCK_SIZE as usize).map(move |first_vertex| DeformBlock {
        first_vertex: vertices as u32 + first_vertex,
        vertex_count: BLOCK_SIZE.min(vertex_count - first_vertex),
        first_influence: influences as u32,
        first_morph_delta: morph_deltas as u32,
        first_joint: joints as u32,
        first_morph_weight: morph_weights as u32,
        first_position_word: first_word as u32 + POSITION_WORDS as u32 * first_vertex,
    })
}
