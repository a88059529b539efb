//! What is asked of the tracer, and what it answers.

use glam::DVec3;

/// A point of a face, as a raster pass shades it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Receiver {
    /// Where it is, world space. Interpolation in `f32` leaves it near the face: tracing starts at the nearest point
    /// of the face, in `f64`.
    pub position: DVec3,
    /// The face that it lies on, as [`Occluders::first_face`](crate::Occluders::first_face) numbers it.
    pub face: u32,
    /// A point on the side of the face that is looked at, world space: the eye.
    pub seen_from: DVec3,
}

/// How a receiver's face stands to the light, as seen from its looked-at side.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Facing {
    /// The whole light is above the face's plane.
    Towards,
    /// The plane cuts the light; its centre is above it, or on it.
    MostlyTowards,
    /// The plane cuts the light; its centre is below it. Shadow techniques call the receiver dark.
    MostlyAverted,
    /// The whole light is below the plane: it is hidden.
    Averted,
}

/// How much of the light a receiver sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Visibility {
    /// The visible part of the light. Range: 0, dark, to 1, lit.
    pub mean: f64,
    /// Standard error of `mean`, from the spread of the replicates, with a degree of freedom less than these; 0 where
    /// the answer is exact: a light without size, or below the receiver's plane, or with nothing before it.
    ///
    /// Never less than the weight of one sample, 1 / `samples`. So a receiver whose samples all agree, which have no
    /// spread, is not done before something that covers as much of the light as the wanted error would probably have
    /// been met: what is smaller than that may be missed, and moves the mean over many receivers by at most
    /// max f (1 - f)^n = 1 / (e n), a third of the wanted error.
    pub standard_error: f64,
    /// Rays that the mean is over; none where the answer needs none.
    pub samples: u32,
    /// How the face stands to the light.
    pub facing: Facing,
}
