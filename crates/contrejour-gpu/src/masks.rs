//! Masks side by side in two buffers, so that one draw serves all of them.

use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

use contrejour_layout::{MASK_CLAMP, MASK_MIRROR, MASK_REPEAT, Mask};
use contrejour_mesh::{MaskedMesh, TextureFilter, TextureWrap};
use contrejour_plan::{BufferKind, MaskFacts};

use crate::ranges::Ranges;
use crate::slots::{Key, Slots};

/// Words of a vertex: two coordinates and alpha.
const WORDS_PER_VERTEX: u64 = 3;

/// The masks of all meshes. Each has places of its own for as long as its mesh is there; pictures are shared.
#[derive(Debug, Default)]
pub(crate) struct MaskPool {
    masks: Slots<PooledMask>,
    /// By what their levels are made from.
    pictures: HashMap<PictureKey, Picture>,
    words: Ranges,
}

#[derive(Clone, Debug)]
struct PooledMask {
    mesh: Arc<MaskedMesh>,
    first_vertex_word: u64,
    first_texel_word: u64,
    is_new: bool,
}

#[derive(Debug)]
struct Picture {
    first_word: u64,
    words: u64,
    /// How many masks have it.
    masks: usize,
    is_new: bool,
}

/// Smaller levels depend on the cutoff and on the largest alpha of the vertices. The address is a name that the mask keeps
/// from being used again.
type PictureKey = (usize, u32, u32);

impl MaskPool {
    /// Adds a mask; `Err` holds the words that there would be, more than 32 bits can index.
    pub fn add(&mut self, mesh: &Arc<MaskedMesh>) -> Result<Key, u64> {
        let mut pooled = PooledMask { mesh: Arc::clone(mesh), first_vertex_word: 0, first_texel_word: 0, is_new: true };
        self.take_places(&mut pooled);
        let words = self.words.end();
        if words > u64::from(u32::MAX) {
            self.give_places_back(&pooled);
            return Err(words);
        }
        Ok(self.masks.insert(pooled))
    }

    /// Removes a mask, and leaves its places to later ones.
    pub fn remove(&mut self, mask: Key) {
        if let Some(pooled) = self.masks.remove(mask) {
            self.give_places_back(&pooled);
        }
    }

    /// The number of a mask in records of casters; it counts from 1.
    pub fn number(mask: Key) -> u32 {
        mask.slot as u32 + 1
    }

    /// Places all masks side by side. For when none is on the device.
    pub fn pack(&mut self) {
        (self.words, self.pictures) = Default::default();
        for slot in 0..self.slot_count() {
            let Some(mut pooled) = self.masks.at(slot).cloned() else { continue };
            self.take_places(&mut pooled);
            self.masks.at_mut(slot).into_iter().for_each(|mask| *mask = pooled.clone());
        }
    }

    fn take_places(&mut self, pooled: &mut PooledMask) {
        pooled.first_vertex_word = self.words.take(pooled.vertex_words());
        let picture = self.pictures.entry(picture_key(&pooled.mesh)).or_insert_with(|| {
            let words = pooled.mesh.mask().image.level_bytes() / 4;
            Picture { first_word: self.words.take(words), words, masks: 0, is_new: true }
        });
        picture.masks += 1;
        pooled.first_texel_word = picture.first_word;
    }

    fn give_places_back(&mut self, pooled: &PooledMask) {
        self.words.give_back(pooled.first_vertex_word, pooled.vertex_words());
        let key = picture_key(&pooled.mesh);
        let Some(picture) = self.pictures.get_mut(&key) else { return };
        picture.masks -= 1;
        if picture.masks == 0 {
            self.words.give_back(picture.first_word, picture.words);
            self.pictures.remove(&key);
        }
    }

    fn slot_count(&self) -> usize {
        self.masks.iter().last().map_or(0, |(slot, _)| slot + 1)
    }

    /// What the frame plan needs to know, with what is free between them.
    pub fn facts(&self) -> MaskFacts {
        MaskFacts { count: self.slot_count() as u64, words: self.words.end() }
    }

    /// Words of what is there.
    pub fn used_words(&self) -> u64 {
        self.words.used()
    }

    /// Writes the records, or the vertices and pictures, of all masks or of those that are new, with
    /// `write(byte offset, bytes)`.
    pub fn write(&self, kind: BufferKind, all: bool, mut write: impl FnMut(u64, &[u8])) {
        let mut pictures = BTreeSet::new();
        for (slot, pooled) in self.masks.iter().filter(|(_, mask)| all || mask.is_new) {
            if kind == BufferKind::Masks {
                write((slot * size_of::<Mask>()) as u64, bytemuck::bytes_of(&pooled.record()));
                continue;
            }
            write(4 * pooled.first_vertex_word, bytemuck::cast_slice(&pooled.vertices()));
            let is_wanted = all || self.pictures.get(&picture_key(&pooled.mesh)).is_some_and(|picture| picture.is_new);
            if is_wanted && pictures.insert(pooled.first_texel_word) {
                write(4 * pooled.first_texel_word, &pooled.texels());
            }
        }
    }

    /// Notes that all masks are on the device.
    pub fn note_written(&mut self) {
        self.masks.iter_mut().for_each(|(_, mask)| mask.is_new = false);
        self.pictures.values_mut().for_each(|picture| picture.is_new = false);
    }
}

impl PooledMask {
    fn vertex_words(&self) -> u64 {
        WORDS_PER_VERTEX * self.mesh.mask().coordinates.len() as u64
    }

    fn vertices(&self) -> Vec<[f32; 3]> {
        let mask = self.mesh.mask();
        mask.coordinates.iter().zip(&mask.alphas).map(|(&[u, v], &alpha)| [u, v, alpha]).collect()
    }

    /// The levels of its picture, each in whole words.
    fn texels(&self) -> Vec<u8> {
        let mut bytes = Vec::with_capacity(self.mesh.mask().image.level_bytes() as usize);
        for level in self.mesh.levels() {
            bytes.extend_from_slice(&level.alphas);
            bytes.resize(bytes.len().next_multiple_of(4), 0);
        }
        bytes
    }

    fn record(&self) -> Mask {
        let mask = self.mesh.mask();
        let [width, height] = mask.image.size();
        let [wrap_u, wrap_v] = mask.image.wrap().map(|wrap| match wrap {
            TextureWrap::Repeat => MASK_REPEAT,
            TextureWrap::Mirror => MASK_MIRROR,
            TextureWrap::Clamp => MASK_CLAMP,
        });
        Mask {
            first_vertex_word: self.first_vertex_word as u32,
            first_texel_word: self.first_texel_word as u32,
            width,
            height,
            levels: mask.image.level_count(),
            wrap_u,
            wrap_v,
            is_nearest: (mask.image.filter() == TextureFilter::Nearest).into(),
            cutoff: mask.cutoff,
        }
    }
}

fn picture_key(mesh: &MaskedMesh) -> PictureKey {
    let mask = mesh.mask();
    (Arc::as_ptr(&mask.image).addr(), mask.cutoff.to_bits(), mesh.largest_alpha().to_bits())
}

/// What the frame plan needs to know of the masks of these meshes.
pub fn mask_facts<'a>(meshes: impl IntoIterator<Item = &'a Arc<MaskedMesh>>) -> MaskFacts {
    let mut pool = MaskPool::default();
    // More than can be indexed is told when a plan sizes the buffers.
    let too_many = meshes.into_iter().filter_map(|mesh| pool.add(mesh).err()).max();
    let MaskFacts { count, words } = pool.facts();
    MaskFacts { count, words: too_many.unwrap_or(words) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use contrejour_mesh::{AlphaMask, MaskImage};

    fn masked(image: &Arc<MaskImage>, cutoff: f32) -> Arc<MaskedMesh> {
        let mask = AlphaMask {
            coordinates: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]],
            alphas: vec![1.0; 3],
            image: Arc::clone(image),
            cutoff,
        };
        let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        Arc::new(MaskedMesh::new(&positions, &[[0, 1, 2]], mask).expect("it is good"))
    }

    #[test]
    fn meshes_share_pictures_of_one_cutoff() {
        let image = MaskImage::new([24, 16], vec![9; 384], Default::default(), TextureFilter::Linear);
        let image = Arc::new(image.expect("it is good"));
        let mut pool = MaskPool::default();
        let keys = [0.5, 0.5, 0.25].map(|cutoff| pool.add(&masked(&image, cutoff)).expect("they are small"));
        assert_eq!(keys.map(MaskPool::number), [1, 2, 3]);
        let picture_words = (24 * 16 + 12 * 8) / 4;
        assert_eq!(image.level_bytes(), 4 * picture_words);
        assert_eq!(pool.facts(), MaskFacts { count: 3, words: 3 * 9 + 2 * picture_words });
        let mut written = vec![0; 4 * pool.facts().words as usize];
        pool.write(BufferKind::MaskWords, true, |offset, bytes| {
            written[offset as usize..][..bytes.len()].iter_mut().zip(bytes).for_each(|(old, new)| *old += new);
        });
        // Nothing was written twice, and the pictures are where the records say.
        let records: Vec<_> = pool.masks.iter().map(|(_, mask)| mask.record()).collect();
        assert_eq!(records[0].first_texel_word, records[1].first_texel_word);
        for record in &records {
            assert_eq!(written[4 * record.first_texel_word as usize..][..384], [9; 384]);
            assert_eq!((record.width, record.height, record.levels), (24, 16, 2));
        }

        // What stays is where it was, and a picture goes with the last mask that has it.
        pool.note_written();
        pool.remove(keys[0]);
        pool.remove(keys[2]);
        assert_eq!((pool.facts().count, pool.used_words()), (2, 9 + picture_words));
        let added = pool.add(&masked(&image, 0.5)).expect("it is small");
        assert_eq!((MaskPool::number(added), pool.used_words()), (3, 2 * 9 + picture_words));
        let mut bytes = 0;
        pool.write(BufferKind::MaskWords, false, |_, written| bytes += written.len());
        assert_eq!(bytes, 3 * 12, "the picture is there");
        pool.remove(keys[1]);
        pool.pack();
        assert_eq!(pool.facts().words, 9 + picture_words);
    }
}
