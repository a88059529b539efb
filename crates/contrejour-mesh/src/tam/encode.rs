//! The bytes of a stream.

use std::iter::repeat_n;
use std::ops::Range;

use contrejour_layout::{HALF_STREAM_FACE_WORDS, STREAM_FACE_WORDS};
use half::f16;
use rayon::prelude::*;

use super::{TamFace, TamStream};

/// How the faces of a stream lie in memory.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TamForm {
    /// A vertex buffer of three items a face: each its own position, the corners of the face and the three normals; of
    /// 16-bit floats three more fill 48 bytes. As Valient and Bujnak (2005) have it.
    Items,
    /// A storage buffer of one record a face: corners and normals. The vertex stage reads face `vertex_index / 3` and
    /// takes corner `vertex_index % 3` of it, so what three items have in common is there once.
    Faces,
}

/// The floats of a stream.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum TamPrecision {
    /// 32-bit floats.
    Full,
    /// 16-bit floats: coordinates are off by up to 2^-11 of themselves, or 2^-25 where that is more, and so are the
    /// components of normals. So faces that the light grazes may count for the other side.
    Half,
}

/// Why a stream has no such bytes.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
pub enum TamError {
    /// A coordinate is too large for 16-bit floats.
    #[error(
        "face {face} has a corner at {coordinate:e}, and 16-bit floats end at 65504: give a smaller scale or an origin amid \
         the mesh"
    )]
    BeyondHalf {
        /// The face in the mesh.
        face: u32,
        /// The coordinate as it is stored.
        coordinate: f32,
    },
}

/// Numbers in one item of a stream, without what fills it.
const ITEM_NUMBERS: usize = 21;

/// Six times four 16-bit floats.
const HALF_ITEM_BYTES: usize = 48;

impl TamForm {
    /// Bytes of one face.
    pub const fn face_bytes(self, precision: TamPrecision) -> usize {
        match (self, precision) {
            (Self::Items, TamPrecision::Full) => 3 * 4 * ITEM_NUMBERS,
            (Self::Items, TamPrecision::Half) => 3 * HALF_ITEM_BYTES,
            (Self::Faces, TamPrecision::Full) => 4 * STREAM_FACE_WORDS as usize,
            (Self::Faces, TamPrecision::Half) => 4 * HALF_STREAM_FACE_WORDS as usize,
        }
    }
}

impl TamStream {
    /// Its bytes, as a device reads them: little-endian.
    ///
    /// # Errors
    ///
    /// [`TamError`] where a coordinate is too large for 16-bit floats.
    pub fn bytes(&self, form: TamForm, precision: TamPrecision) -> Result<Vec<u8>, TamError> {
        if precision == TamPrecision::Half {
            self.check_halves()?;
        }
        let numbers = self.faces.par_iter().flat_map_iter(|face| numbers(face, form, precision));
        Ok(match precision {
            TamPrecision::Full => bytemuck::cast_slice(&numbers.collect::<Vec<f32>>()).to_vec(),
            TamPrecision::Half => bytemuck::cast_slice(&numbers.map(f16::from_f32).collect::<Vec<f16>>()).to_vec(),
        })
    }

    /// The [records](TamForm::Faces) of some faces of the mesh, each in its place: those that are not in the stream are zeros,
    /// which have no edge in any silhouette.
    ///
    /// # Errors
    ///
    /// As [`bytes`](Self::bytes).
    pub fn records_in_place(&self, face_ids: Range<u32>, precision: TamPrecision) -> Result<Vec<u8>, TamError> {
        let bytes = self.bytes(TamForm::Faces, precision)?;
        let face_bytes = TamForm::Faces.face_bytes(precision);
        let mut placed = vec![0; face_ids.len() * face_bytes];
        for (record, id) in bytes.chunks_exact(face_bytes).zip(&self.face_ids) {
            if face_ids.contains(id) {
                let first = (id - face_ids.start) as usize * face_bytes;
                placed[first..first + face_bytes].copy_from_slice(record);
            }
        }
        Ok(placed)
    }

    fn check_halves(&self) -> Result<(), TamError> {
        let too_large = |coordinate: &&f32| !f16::from_f32(**coordinate).is_finite();
        let found = self.faces.par_iter().zip(&self.face_ids).find_map_first(|(face, &id)| {
            let coordinate = face.corners.as_flattened().iter().find(too_large)?;
            Some(TamError::BeyondHalf { face: id, coordinate: *coordinate })
        });
        found.map_or(Ok(()), Err)
    }
}

/// The numbers of a face, in their order.
fn numbers(face: &TamFace, form: TamForm, precision: TamPrecision) -> impl Iterator<Item = f32> {
    let own = move |item: usize| (form == TamForm::Items).then(|| face.corners[item]).into_iter().flatten();
    let shared = || face.corners.iter().chain(&face.neighbour_normals).flatten().copied();
    let (records, filling) = match (form, precision) {
        (TamForm::Items, TamPrecision::Full) => (3, 0),
        (TamForm::Items, TamPrecision::Half) => (3, HALF_ITEM_BYTES / size_of::<f16>() - ITEM_NUMBERS),
        (TamForm::Faces, _) => (1, 0),
    };
    (0..records).flat_map(move |item| own(item).chain(shared()).chain(repeat_n(0.0, filling)))
}
