//! Masks side by side in two buffers, so that one draw serves all of them.

use std::collections::HashMap;
use std::sync::Arc;

use contrejour_layout::{MASK_CLAMP, MASK_MIRROR, MASK_REPEAT, Mask};
use contrejour_mesh::{MaskImage, MaskedMesh, TextureFilter, TextureWrap};
use contrejour_plan::MaskFacts;

/// Words of a vertex: two coordinates and alpha.
const WORDS_PER_VERTEX: u64 = 3;

/// The masks of all meshes.
#[derive(Debug, Default)]
pub(crate) struct MaskPool {
    masks: Vec<PooledMask>,
    /// Where pictures start, by what their levels are made from.
    pictures: HashMap<PictureKey, u64>,
    words: u64,
}

#[derive(Debug)]
struct PooledMask {
    mesh: Arc<MaskedMesh>,
    first_vertex_word: u64,
    first_texel_word: u64,
    /// Whether it is the first with its picture.
    brings_picture: bool,
}

/// Smaller levels depend on the cutoff and on the largest alpha of the vertices. The address is a name that the mask keeps
/// from being used again.
type PictureKey = (*const MaskImage, u32, u32);

impl MaskPool {
    /// Adds a mask and returns its number, which counts from 1; `Err` holds the words that there would be, more than 32
    /// bits can index.
    pub fn add(&mut self, mesh: &Arc<MaskedMesh>) -> Result<u32, u64> {
        let key = picture_key(mesh);
        let first_vertex_word = self.words;
        let behind_vertices = first_vertex_word + WORDS_PER_VERTEX * mesh.mask().coordinates.len() as u64;
        let known = self.pictures.get(&key).copied();
        let words = match known {
            Some(_) => behind_vertices,
            None => behind_vertices + mesh.mask().image.level_bytes() / 4,
        };
        if words > u64::from(u32::MAX) {
            return Err(words);
        }
        let first_texel_word = *self.pictures.entry(key).or_insert(behind_vertices);
        self.masks.push(PooledMask {
            mesh: Arc::clone(mesh),
            first_vertex_word,
            first_texel_word,
            brings_picture: known.is_none(),
        });
        self.words = words;
        Ok(self.masks.len() as u32)
    }

    /// What the frame plan needs to know.
    pub fn facts(&self) -> MaskFacts {
        MaskFacts { count: self.masks.len() as u64, words: self.words }
    }

    /// The records of all masks, in their order.
    pub fn records(&self) -> Vec<Mask> {
        self.masks.iter().map(PooledMask::record).collect()
    }

    /// Writes all vertices and pictures with `write(byte offset, bytes)`.
    pub fn fill_words(&self, mut write: impl FnMut(u64, &[u8])) {
        for pooled in &self.masks {
            let mask = pooled.mesh.mask();
            let vertices: Vec<[f32; 3]> =
                mask.coordinates.iter().zip(&mask.alphas).map(|(&[u, v], &alpha)| [u, v, alpha]).collect();
            write(4 * pooled.first_vertex_word, bytemuck::cast_slice(&vertices));
            if pooled.brings_picture {
                let mut bytes = Vec::with_capacity(mask.image.level_bytes() as usize);
                for level in pooled.mesh.levels() {
                    bytes.extend_from_slice(&level.alphas);
                    bytes.resize(bytes.len().next_multiple_of(4), 0);
                }
                write(4 * pooled.first_texel_word, &bytes);
            }
        }
    }
}

impl PooledMask {
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
    (Arc::as_ptr(&mask.image), mask.cutoff.to_bits(), mesh.largest_alpha().to_bits())
}

/// What the frame plan needs to know of the masks of these meshes.
pub fn mask_facts<'a>(meshes: impl IntoIterator<Item = &'a Arc<MaskedMesh>>) -> MaskFacts {
    let mut pool = MaskPool::default();
    for mesh in meshes {
        // More than can be indexed is told when a plan sizes the buffers.
        if let Err(words) = pool.add(mesh) {
            pool.words = words;
        }
    }
    pool.facts()
}

#[cfg(test)]
mod tests {
    use super::*;
    use contrejour_mesh::AlphaMask;

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
        let image = MaskImage::new([5, 3], vec![9; 15], Default::default(), TextureFilter::Linear);
        let image = Arc::new(image.expect("it is good"));
        let mut pool = MaskPool::default();
        let numbers = [0.5, 0.5, 0.25].map(|cutoff| pool.add(&masked(&image, cutoff)));
        assert_eq!(numbers, [Ok(1), Ok(2), Ok(3)]);
        let picture_words = (16 + 4 + 4) / 4;
        assert_eq!(image.level_bytes(), 4 * picture_words);
        assert_eq!(pool.facts(), MaskFacts { count: 3, words: 3 * 9 + 2 * picture_words });
        let mut written = vec![0; 4 * pool.facts().words as usize];
        pool.fill_words(|offset, bytes| {
            written[offset as usize..][..bytes.len()].iter_mut().zip(bytes).for_each(|(old, new)| *old += new);
        });
        // Nothing was written twice, and the pictures are where the records say.
        let records = pool.records();
        assert_eq!(records[0].first_texel_word, records[1].first_texel_word);
        for record in &records {
            assert_eq!(written[4 * record.first_texel_word as usize..][..15], [9; 15]);
            assert_eq!((record.width, record.height, record.levels), (5, 3, 3));
        }
    }
}
