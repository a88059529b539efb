//! What a stream takes, against what else would draw the mesh.

use contrejour_layout::{Face, FaceNeighbours};

use super::{TamForm, TamPrecision, TamStream};
use crate::TopologyReport;

/// Position, normal and texture coordinates, as the baselines of Valient and Bujnak (2005) have them: so their 1.53 and
/// 0.77 times are nearly 144 and 72 bytes against three such vertices.
const VERTEX_BYTES: f64 = 32.0;

/// Three indices of 32 bits.
const INDEX_BYTES: f64 = 12.0;

/// The bytes of a stream, and their share of two ways to draw the mesh without one.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct TamMemory {
    /// Bytes of one face that is in the stream.
    pub face_bytes: usize,
    /// Bytes of the stream.
    pub bytes: usize,
    /// Of a mesh with three vertices of its own for each face, each of 32 bytes.
    pub of_unindexed: f64,
    /// Of a mesh with indices, of 32 bytes a used vertex of the source and 12 a face.
    pub of_indexed: f64,
}

impl TamStream {
    /// What it takes in one form, against the whole mesh that a report is of. Shares of a mesh without faces are 0.
    pub fn memory(&self, form: TamForm, precision: TamPrecision, mesh: &TopologyReport) -> TamMemory {
        let face_bytes = form.face_bytes(precision);
        TamMemory::new(face_bytes, face_bytes * self.faces.len(), mesh)
    }
}

impl TamMemory {
    /// What a mesh takes in the form of [`face_neighbours`](crate::face_neighbours): the corners of each face and what is
    /// across its edges, as indices, and the positions once.
    pub fn of_neighbours(mesh: &TopologyReport) -> Self {
        let face_bytes = size_of::<Face>() + size_of::<FaceNeighbours>();
        let positions = size_of::<[f32; 3]>() * mesh.vertices as usize;
        Self::new(face_bytes, face_bytes * mesh.faces as usize + positions, mesh)
    }

    fn new(face_bytes: usize, bytes: usize, mesh: &TopologyReport) -> Self {
        let faces = f64::from(mesh.faces);
        let vertices = f64::from(mesh.vertices - mesh.unused_vertices.count);
        let share = |all: f64| if all > 0.0 { bytes as f64 / all } else { 0.0 };
        Self {
            face_bytes,
            bytes,
            of_unindexed: share(3.0 * VERTEX_BYTES * faces),
            of_indexed: share(VERTEX_BYTES * vertices + INDEX_BYTES * faces),
        }
    }
}
