//! Lights as the caller gives them.

use glam::DVec3;

/// A light that casts a shadow.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Light {
    /// Where it is and where it shines.
    pub kind: LightKind,
    /// Linear colour times intensity. Unit: radiance of a white surface that faces it. Range: 0 and up.
    pub color: [f32; 3],
}

/// Shape of a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// A cone of light from a point or a small disk.
    Spot {
        /// Position, world space.
        position: DVec3,
        /// Point that the axis goes through, world space.
        target: DVec3,
        /// Full opening angle of the cone. Range: more than 0 and less than pi.
        cone_angle: f64,
        /// Radius of the disk that shines, world units. Range: 0 and up.
        radius: f64,
        /// Nearest depth that casts, world units. Range: more than 0.
        near: f64,
        /// Farthest depth that casts and receives, world units. Range: more than `near`.
        far: f64,
    },
    /// Parallel light, like a sun.
    Directional {
        /// Direction from the scene towards the light, world space; any length but zero.
        towards_light: DVec3,
        /// Centre of what is to be shadowed, world space.
        center: DVec3,
        /// Half the side of the square that is shadowed around `center`, world units. Range: more than 0.
        half_extent: f64,
        /// Half the depth that is shadowed around `center`, world units. Range: more than 0.
        half_depth: f64,
        /// Angular radius of the disk that shines. Range: 0 to pi / 2.
        angular_radius: f64,
    },
}
