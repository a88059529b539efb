//! Cameras and lights as a file brings them.

use glam::DVec3;

/// A camera in perspective that stands in a file's world.
#[derive(Clone, Debug, PartialEq)]
pub struct FileCamera {
    /// Name in the file, of its node before its own; may be empty.
    pub name: String,
    /// Where it is, world space.
    pub eye: DVec3,
    /// Where it looks; unit length.
    pub forward: DVec3,
    /// Which way is up; unit length, and not along `forward`.
    pub up: DVec3,
    /// Full vertical opening angle. Unit: radians. Range: more than 0 and less than pi.
    pub fov_y: f64,
    /// Nearest depth that it sees, world units. Range: more than 0.
    pub near: f64,
    /// Farthest depth that it sees, world units; `None` where it sees any. Range: more than `near`.
    pub far: Option<f64>,
}

/// A light that stands in a file's world.
#[derive(Clone, Debug, PartialEq)]
pub struct FileLight {
    /// Name in the file, of its node before its own; may be empty.
    pub name: String,
    /// Where it is and where it shines.
    pub kind: FileLightKind,
    /// Linear colour, by which the intensity is multiplied. Range: 0 and up.
    pub color: [f32; 3],
    /// Unit: candela; lux of a directional light. World units are metres. Range: 0 and up.
    pub intensity: f64,
    /// Distance at which its light ends, world units; `None` where it never does. Range: more than 0.
    pub range: Option<f64>,
}

/// Where a light of a file is and where it shines, world space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FileLightKind {
    /// From very far away.
    Directional {
        /// Where it shines; unit length.
        direction: DVec3,
    },
    /// In all directions.
    Point {
        /// Where it is.
        position: DVec3,
    },
    /// In a cone.
    Spot {
        /// Where it is.
        position: DVec3,
        /// The cone's axis, away from the light; unit length.
        direction: DVec3,
        /// Angle from the axis up to which it is equally bright. Unit: radians. Range: 0 to less than the outer one.
        inner_half_angle: f64,
        /// Angle from the axis at which its light ends. Unit: radians. Range: more than 0, up to pi / 2.
        outer_half_angle: f64,
    },
}
