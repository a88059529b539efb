//! What is wrong with a light.

use glam::DVec3;

/// What is wrong with a light.
#[derive(Clone, Copy, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum LightError {
    /// A number is infinite, NaN or too large.
    #[error("the light's {field} is {value}: give a finite number that fits in 32 bits")]
    NotFinite {
        /// Name of the field.
        field: &'static str,
        /// What it holds.
        value: f64,
    },
    /// A number that must not be negative is.
    #[error("the light's {field} is {value}: give 0 or more")]
    Negative {
        /// Name of the field.
        field: &'static str,
        /// What it holds.
        value: f64,
    },
    /// A number that must be positive is not, or is too small.
    #[error("the light's {field} is {value}: give more than 0 (at least 1.2e-38, the smallest normal 32-bit number)")]
    NotPositive {
        /// Name of the field.
        field: &'static str,
        /// What it holds.
        value: f64,
    },
    /// The spot's target is its position.
    #[error("the spot stands on its target {target}: move the target to where the axis shall go")]
    NoAxis {
        /// Position and target.
        target: DVec3,
    },
    /// The direction is zero.
    #[error("the direction towards the light is zero: give any other vector, its length does not matter")]
    NoDirection,
    /// The cone is closed, or wider than a plane can show.
    #[error("the cone angle is {radians} radians: give more than 0 and less than pi (3.14159), 1 is common")]
    ConeAngle {
        /// Full opening angle.
        radians: f64,
    },
    /// The views of a point light are all guard band, or would have less than none.
    #[error("the guard is {guard_ndc} of half a map: give 0 or more and less than 1, as guard_ndc does")]
    Guard {
        /// Width of the guard band, NDC.
        guard_ndc: f64,
    },
    /// The maps of a cascaded light follow an eye, and none is given.
    #[error("the views of a cascaded light depend on the eye: ask cascade_views for them")]
    NeedsEye,
    /// There are no cascades, or too many.
    #[error("there are {count} cascades: give 1 to 8, 4 is common")]
    CascadeCount {
        /// How many.
        count: u32,
    },
    /// A share or a multiple of the cascades is not in its range.
    #[error("the cascades' {field} is {value}: give 0 to {most}")]
    CascadeShare {
        /// Name of the field.
        field: &'static str,
        /// What it holds.
        value: f64,
        /// The most that it may hold.
        most: f64,
    },
    /// The disk of a directional light covers half the sky.
    #[error("the angular radius is {radians} radians: give 0 or more and less than pi / 2, the sun has 0.00465")]
    AngularRadius {
        /// Angular radius.
        radians: f64,
    },
    /// One over the farthest depth is no normal 32-bit number.
    #[error("the light's far is {far}: give at most 8.5e37, since shaders reckon with one over depth")]
    TooFar {
        /// Farthest depth.
        far: f64,
    },
    /// There is no depth between near and far.
    #[error("near is {near} and far is {far}: give a far that is clearly more than near")]
    DepthRange {
        /// Nearest depth.
        near: f64,
        /// Farthest depth.
        far: f64,
    },
}
