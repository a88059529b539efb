//! What can be wrong with what is asked.

use glam::DVec3;

/// Why [`Occluders`](crate::Occluders) cannot be built.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OccluderError {
    /// A triangle names a vertex that its mesh does not have.
    #[error("triangle {triangle} of mesh {mesh} names vertex {vertex}, but the mesh has {vertices}: mend its indices")]
    NoSuchVertex {
        /// Index of the mesh.
        mesh: usize,
        /// Index of the triangle in it.
        triangle: usize,
        /// What it names.
        vertex: u32,
        /// How many there are.
        vertices: usize,
    },
    /// A corner is infinite or NaN in the world.
    #[error(
        "vertex {vertex} of mesh {mesh} is at {position_world} in the world: its position and the mesh's transform \
         must be finite"
    )]
    NotFinite {
        /// Index of the mesh.
        mesh: usize,
        /// Index of the vertex in it.
        vertex: u32,
        /// Where it is.
        position_world: DVec3,
    },
    /// Faces are numbered in 32 bits.
    #[error("the meshes have {faces} faces, more than 4294967295: trace them in parts")]
    TooManyFaces {
        /// How many there are.
        faces: usize,
    },
}

/// Why [`trace`](crate::trace()) cannot start.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TraceError {
    /// A number of the light is infinite, NaN or out of its range.
    #[error("the light's {field} is {value}: give {range}")]
    Light {
        /// Name of the field.
        field: &'static str,
        /// What it holds.
        value: f64,
        /// What it may hold.
        range: &'static str,
    },
    /// A number of the options is out of its range.
    #[error("{field} is {value}: give {range}")]
    Options {
        /// Name of the field.
        field: &'static str,
        /// What it holds.
        value: f64,
        /// What it may hold.
        range: &'static str,
    },
    /// A receiver's position or eye is infinite or NaN.
    #[error("receiver {receiver} at {position}, seen from {seen_from}, is not finite: leave pixels without a face out")]
    ReceiverNotFinite {
        /// Index of the receiver.
        receiver: usize,
        /// Where it is.
        position: DVec3,
        /// From where it is seen.
        seen_from: DVec3,
    },
    /// A receiver names a face that is not there.
    #[error("receiver {receiver} lies on face {face}, but there are {faces}: number them as first_face says")]
    NoSuchFace {
        /// Index of the receiver.
        receiver: usize,
        /// What it names.
        face: u32,
        /// How many there are.
        faces: usize,
    },
    /// A receiver lies on a face without area, which has no plane.
    #[error("receiver {receiver} lies on face {face}, which has no area: leave it out (see Occluders::has_area)")]
    FaceWithoutArea {
        /// Index of the receiver.
        receiver: usize,
        /// Its face.
        face: u32,
    },
    /// A receiver is nowhere near its face.
    #[error(
        "receiver {receiver} is {distance} away from its face {face}, more than rounding explains ({allowed}): \
         give positions in the world of the occluders and face numbers as first_face says"
    )]
    OffFace {
        /// Index of the receiver.
        receiver: usize,
        /// Its face.
        face: u32,
        /// How far it is from it, world units.
        distance: f64,
        /// How far it may be, world units.
        allowed: f64,
    },
}
