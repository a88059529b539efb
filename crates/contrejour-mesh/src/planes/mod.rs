//! The planes of a mesh's faces, by which the facing test asks first.

mod expansion;
mod plane;

use contrejour_layout::{BLOCK_SIZE, Face};
use rayon::prelude::*;

use crate::TopologyAwareMesh;
use plane::stored_plane;
pub(crate) use plane::unit_normal;

/// The plane of each face: 16 bytes that say for any light whether it is lit, but for the lights next to the plane.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FacePlanes {
    /// For each face its normal `(b - a) x (c - a)` and `d = -normal . a`, times a power of two that brings the normal's
    /// largest component to 1 to 2.
    ///
    /// A component is off by at most 2^-23 of itself, and is zero only where the exact one is; otherwise it is 2^-60 to
    /// 2^60 large. Zeros for a face without area, and for one whose plane does not fit.
    pub planes: Vec<[f32; 4]>,
    /// Blocks of [`BLOCK_SIZE`] faces with one whose plane does not fit, ascending.
    pub unfit_blocks: Vec<u32>,
}

impl FacePlanes {
    /// The planes of faces, on every thread of the current rayon pool.
    ///
    /// # Panics
    ///
    /// When a face names a vertex without position.
    pub fn new(positions: &[[f32; 3]], faces: &[Face]) -> Self {
        let mut planes = vec![[0.0; 4]; faces.len()];
        let block_size = BLOCK_SIZE as usize;
        let blocks = planes.par_chunks_mut(block_size).zip(faces.par_chunks(block_size)).enumerate();
        let unfit_blocks = blocks.filter_map(|(block, (planes, faces))| {
            let mut all_fit = true;
            for (plane, face) in planes.iter_mut().zip(faces) {
                let [a, b, c] = [face.a, face.b, face.c].map(|vertex| positions[vertex as usize]);
                let stored = stored_plane(a, b, c);
                all_fit &= stored.is_some();
                *plane = stored.unwrap_or_default();
            }
            (!all_fit).then_some(block as u32)
        });
        let unfit_blocks = unfit_blocks.collect();
        Self { planes, unfit_blocks }
    }

    /// Whether the planes of all faces of a block fit.
    pub fn block_fits(&self, block: u32) -> bool {
        self.unfit_blocks.binary_search(&block).is_err()
    }
}

impl TopologyAwareMesh {
    /// The planes of its faces. They are worked out anew in each call: who needs them keeps them.
    pub fn face_planes(&self) -> FacePlanes {
        FacePlanes::new(&self.positions, &self.faces)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_unfit_plane_is_told_by_its_block() {
        let positions = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 1.0, 1e-30]];
        let mut faces = vec![Face { a: 0, b: 1, c: 2 }; 200];
        faces[64] = Face { a: 0, b: 1, c: 3 };
        let planes = FacePlanes::new(&positions, &faces);
        assert_eq!(planes.unfit_blocks, [1]);
        assert!(planes.block_fits(0) && !planes.block_fits(1) && planes.block_fits(3));
        assert_eq!((planes.planes[63], planes.planes[64]), ([0.0, 0.0, 1.0, 0.0], [0.0; 4]));
    }
}
