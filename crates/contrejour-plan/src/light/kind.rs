//! Shapes of lights.

use glam::DVec3;

use super::CascadeSettings;

/// Shape of a light.
///
/// Every number must be finite and fit in an `f32`, except for the length of `towards_light`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// A cone of light from a point or a small disk.
    Spot {
        /// Position, world space.
        position: DVec3,
        /// Point that the axis goes through, world space. Range: anywhere but `position`.
        target: DVec3,
        /// Full opening angle of the cone; the square shadow map just holds the cone. Range: more than 0 and less
        /// than pi.
        cone_angle: f64,
        /// Radius of the disk that shines, parallel to the image plane, world units. Range: 0 and up.
        radius: f64,
        /// Nearest depth that casts, world units. Range: more than 0.
        near: f64,
        /// Farthest depth that casts and receives, world units. Range: more than `near`, up to 8.5e37.
        far: f64,
    },
    /// Light from a point or a small sphere in all directions. Six views look at it, along the axes of world space; see
    /// [`CubeFace`](crate::CubeFace).
    Point {
        /// Position, world space.
        position: DVec3,
        /// Radius of the sphere that shines, world units. Range: 0 and up. Soft shadows take it for small beside the
        /// blocker's distance; see [`LightOutline`](crate::LightOutline).
        radius: f64,
        /// Nearest depth along the axis of a view from which on all casts, world units. Range: more than 0. What is
        /// nearer by less than the guard of the views casts too; see [`views_with_guard`](crate::views_with_guard).
        near: f64,
        /// Farthest depth along the axis of a view that casts and receives, world units: half the side of the cube that
        /// is shadowed around the light. Range: more than `near`, up to 8.5e37.
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
        /// Half the depth that is shadowed around `center`, world units; what is nearer to the light casts nothing.
        /// Range: more than 0.
        half_depth: f64,
        /// Angular radius of the disk that shines (the sun's is 0.00465). Range: 0 and up, less than pi / 2.
        angular_radius: f64,
    },
    /// Parallel light, like a sun, on all that one eye sees: several maps follow the eye, finer ones near it. Its views
    /// come from [`cascade_views`](crate::cascade_views), which asks for the eye.
    Cascaded {
        /// Direction from the scene towards the light, world space; any length but zero.
        towards_light: DVec3,
        /// Angular radius of the disk that shines (the sun's is 0.00465). Range: 0 and up, less than pi / 2.
        angular_radius: f64,
        /// How many maps there are, and which part of the eye's view each has.
        cascades: CascadeSettings,
    },
}
