//! Topology-aware vertex streams (Valient and Bujnak 2005): each face brings what a vertex stage needs to know of its
//! neighbours, so that a face alone tells which of its edges are in the silhouette.

mod encode;
mod face_neighbours;
mod memory;
mod neighbours;

pub use encode::{TamError, TamForm, TamPrecision};
pub use face_neighbours::{edge_fans, face_neighbours, face_neighbours_in_pairs};
pub use memory::TamMemory;

use rayon::prelude::*;

use crate::TopologyAwareMesh;
use crate::planes::unit_normal;
use neighbours::{Pairs, has_area, neighbour_normals};

/// One face and the normals of the faces beside it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TamFace {
    /// Its corners.
    pub corners: [[f32; 3]; 3],
    /// Across the edge from each corner to the next: the normal of the face there, as it is wound with this one.
    ///
    /// The edge is in the silhouette where the light is in front of one of the two faces alone. Its length says who draws the
    /// edge then:
    ///
    /// - 1: the one of the two that is lit.
    /// - 2: this face, also while it is unlit. The other one is wound the wrong way, or knows the edge by another name.
    /// - 4: this face, and whatever the light. There is no face across, so this is the negated normal of the face here; a light
    ///   in its plane leaves rounding to tell the sides.
    /// - 0: nobody. The edge is never in the silhouette.
    pub neighbour_normals: [[f32; 3]; 3],
}

/// How the positions of a stream are stored: less `origin`, times `scale`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TamOptions {
    /// A point in object space; zeros by default.
    pub origin: [f32; 3],
    /// Positive, 1 by default. A power of two that keeps all coordinates normal loses no digits; 16-bit floats end at
    /// 65 504 and lose digits below 2^-14.
    pub scale: f32,
}

impl Default for TamOptions {
    fn default() -> Self {
        Self { origin: [0.0; 3], scale: 1.0 }
    }
}

/// The faces of a mesh that can have silhouette edges, each with the normals of its neighbours.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TamStream {
    /// Those faces, in the order of the mesh.
    pub faces: Vec<TamFace>,
    /// For each of them its id in the mesh.
    pub face_ids: Vec<u32>,
    /// Faces that were left out since none of their edges can ever be in a silhouette. Those of a mesh that deforms stay.
    pub never_silhouette_faces: u32,
    /// Faces that were left out since they have no area, or name a vertex twice. Their neighbours know each other.
    pub faces_without_area: u32,
    /// Edges that may be drawn though they are no outline, which has all its faces on one side.
    ///
    /// The faces of an edge of three and more are asked in pairs, of two that run along it in opposite ways where there
    /// are such, and that are not the two sides of one. Pairs that do not lie in the same planes, and an odd
    /// face, may lie on different sides, which a vertex stage can't know. So it is beside a face without area that has no sign
    /// to take: such an edge is drawn whatever the light.
    pub overdrawn_edges: u32,
}

impl TamStream {
    /// The stream of a mesh, worked out on every thread of the current rayon pool.
    pub fn new(mesh: &TopologyAwareMesh, options: &TamOptions) -> Self {
        let has_area = has_area(mesh);
        let stored = |position: [f32; 3]| -> [f32; 3] {
            std::array::from_fn(|axis| (position[axis] - options.origin[axis]) * options.scale)
        };
        let pairs = Pairs::new(mesh);
        let normals: Vec<_> = mesh.faces.par_iter().map(|face| unit_normal(mesh.corners(face))).collect();
        let (face_ids, faces): (Vec<u32>, Vec<TamFace>) = (0..mesh.faces.len() as u32)
            .into_par_iter()
            .filter(|&face_id| has_area[face_id as usize])
            .filter_map(|face_id| {
                let neighbour_normals = neighbour_normals(mesh, face_id, &normals, &pairs)?;
                let corners = mesh.corners(&mesh.faces[face_id as usize]).map(stored);
                Some((face_id, TamFace { corners, neighbour_normals }))
            })
            .unzip();
        let with_area = has_area.iter().filter(|has_area| **has_area).count();
        Self {
            never_silhouette_faces: (with_area - faces.len()) as u32,
            faces_without_area: (mesh.faces.len() - with_area) as u32,
            overdrawn_edges: neighbours::overdrawn_edges(mesh),
            faces,
            face_ids,
        }
    }
}

#[cfg(test)]
mod tests;
