//! Meshes with holes: faces that alpha cuts, as glTF's `alphaMode` `MASK` has them.

mod image;
mod levels;

pub use image::{MaskImage, MaskImageError};
pub use levels::{MaskLevel, halved, mask_level_sizes};

use std::sync::Arc;

use crate::{TopologyAwareMesh, TopologyError};

/// What is cut from the faces of a mesh: all that has less alpha than the cutoff. Alpha is that of the picture times that of
/// the vertices.
#[derive(Clone, Debug, PartialEq)]
pub struct AlphaMask {
    /// Coordinates of each source vertex in the picture, (0, 0) at its upper left corner and (1, 1) at the lower right one.
    pub coordinates: Vec<[f32; 2]>,
    /// Alpha of each source vertex, finite and at least 0; interpolated over faces.
    pub alphas: Vec<f32>,
    /// The picture. Meshes that share it share its memory on the device too.
    pub image: Arc<MaskImage>,
    /// Alpha below which there is nothing; finite. glTF's default: 0.5.
    pub cutoff: f32,
}

/// Triangles with a mask. They have neither edges nor silhouettes: what shadow they throw ends where their picture does, and
/// no mesh knows where that is.
#[derive(Clone, Debug)]
pub struct MaskedMesh {
    mesh: Arc<TopologyAwareMesh>,
    mask: AlphaMask,
}

/// Why a mesh can't have a mask.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum MaskedMeshError {
    /// Its triangles are no mesh.
    #[error(transparent)]
    Topology(#[from] TopologyError),
    /// Its picture is none.
    #[error(transparent)]
    Image(#[from] MaskImageError),
    /// There is something else than one value for each vertex.
    #[error("the mask has {coordinates} coordinates and {alphas} alphas for {vertices} vertices; give each vertex one")]
    Counts {
        /// How many coordinates.
        coordinates: usize,
        /// How many alphas.
        alphas: usize,
        /// How many vertices.
        vertices: usize,
    },
    /// A coordinate or alpha is no finite number, or alpha is negative.
    #[error(
        "vertex {vertex} has coordinates or an alpha that are no finite numbers, or a negative alpha; correct them"
    )]
    Vertex {
        /// The first vertex that has.
        vertex: usize,
    },
    /// The cutoff is no finite number.
    #[error("the cutoff of the mask is {cutoff}; give a finite number, such as 0.5")]
    Cutoff {
        /// The cutoff.
        cutoff: f32,
    },
}

impl MaskedMesh {
    /// Triangles by source vertex, whose positions are copied, and their mask.
    ///
    /// # Errors
    ///
    /// [`MaskedMeshError`] when an index is out of range, a number is not finite, or counts differ.
    pub fn new(positions: &[[f32; 3]], triangles: &[[u32; 3]], mask: AlphaMask) -> Result<Self, MaskedMeshError> {
        let [coordinates, alphas] = [mask.coordinates.len(), mask.alphas.len()];
        if [coordinates, alphas] != [positions.len(); 2] {
            return Err(MaskedMeshError::Counts { coordinates, alphas, vertices: positions.len() });
        }
        let is_good = |(coordinates, alpha): (&[f32; 2], &f32)| {
            coordinates.iter().all(|coordinate| coordinate.is_finite()) && alpha.is_finite() && *alpha >= 0.0
        };
        if let Some(vertex) = mask.coordinates.iter().zip(&mask.alphas).position(|vertex| !is_good(vertex)) {
            return Err(MaskedMeshError::Vertex { vertex });
        }
        if !mask.cutoff.is_finite() {
            return Err(MaskedMeshError::Cutoff { cutoff: mask.cutoff });
        }
        Ok(Self { mesh: Arc::new(TopologyAwareMesh::faces_alone(positions, triangles)?), mask })
    }

    /// The triangles, without any edge.
    pub fn mesh(&self) -> &Arc<TopologyAwareMesh> {
        &self.mesh
    }

    /// What is cut from them.
    pub fn mask(&self) -> &AlphaMask {
        &self.mask
    }

    /// The picture, level by level from itself down to 1 texel. Smaller levels keep the share of texels that the cutoff
    /// leaves, where the alpha of vertices is the largest of the mesh.
    pub fn levels(&self) -> Vec<MaskLevel> {
        let largest = self.largest_alpha();
        let cutoff = if largest > 0.0 { self.mask.cutoff / largest } else { f32::INFINITY };
        self.mask.image.levels(cutoff)
    }

    /// The largest alpha of its vertices.
    pub fn largest_alpha(&self) -> f32 {
        self.mask.alphas.iter().copied().fold(0.0, f32::max)
    }

    /// Whether a point of a face is there, by its weights of the face's corners: the definition that shaders follow where a
    /// texel of the picture is no smaller than one of the shadow map.
    ///
    /// # Panics
    ///
    /// When there is no such face.
    pub fn keeps(&self, face: u32, weights: [f64; 3]) -> bool {
        let face = &self.mesh.faces[face as usize];
        let mut coordinates = [0.0; 2];
        let mut alpha = 0.0;
        for (corner, weight) in [face.a, face.b, face.c].into_iter().zip(weights) {
            let [u, v] = self.mask.coordinates[corner as usize].map(f64::from);
            coordinates = [coordinates[0] + weight * u, coordinates[1] + weight * v];
            alpha += weight * f64::from(self.mask.alphas[corner as usize]);
        }
        alpha * self.mask.image.alpha_at(coordinates) >= f64::from(self.mask.cutoff)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{TextureFilter, TextureWrap};

    const POSITIONS: [[f32; 3]; 3] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

    fn mask() -> AlphaMask {
        let image = MaskImage::new([2, 1], vec![0, 255], [TextureWrap::Clamp; 2], TextureFilter::Nearest);
        AlphaMask {
            coordinates: vec![[0.0, 0.0], [1.0, 0.0], [0.0, 0.0]],
            alphas: vec![1.0, 0.6, 0.0],
            image: Arc::new(image.expect("it is good")),
            cutoff: 0.5,
        }
    }

    #[test]
    fn faces_are_cut_where_alpha_is_low() {
        let mesh = MaskedMesh::new(&POSITIONS, &[[0, 1, 2]], mask()).expect("it is good");
        assert!(mesh.mesh().edges.is_empty() && mesh.mesh().faces.len() == 1);
        assert!(mesh.keeps(0, [0.4, 0.6, 0.0]) && !mesh.keeps(0, [0.6, 0.4, 0.0]));
        // There the picture is whole, and the vertices' alpha is too low.
        assert!(!mesh.keeps(0, [0.0, 0.6, 0.4]));
        assert!(mesh.keeps(0, [0.0, 1.0, 0.0]));
    }

    #[test]
    fn what_does_not_fit_is_refused() {
        let refused = |change: &dyn Fn(&mut AlphaMask), triangles: &[[u32; 3]]| {
            let mut mask = mask();
            change(&mut mask);
            MaskedMesh::new(&POSITIONS, triangles, mask).expect_err("it must be refused")
        };
        let triangles = [[0, 1, 2]];
        let short = refused(&|mask| mask.alphas.truncate(2), &triangles);
        assert_eq!(short, MaskedMeshError::Counts { coordinates: 3, alphas: 2, vertices: 3 });
        let infinite = refused(&|mask| mask.coordinates[1][0] = f32::INFINITY, &triangles);
        assert_eq!(infinite, MaskedMeshError::Vertex { vertex: 1 });
        assert_eq!(refused(&|mask| mask.alphas[2] = -0.5, &triangles), MaskedMeshError::Vertex { vertex: 2 });
        assert!(matches!(refused(&|mask| mask.cutoff = f32::NAN, &triangles), MaskedMeshError::Cutoff { .. }));
        assert!(matches!(refused(&|_| (), &[[0, 1, 3]]), MaskedMeshError::Topology(_)));
    }
}
