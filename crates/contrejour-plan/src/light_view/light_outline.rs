//! What a light looks like from where its shadows fall.

use core::f64::consts::SQRT_2;

use glam::DVec2;

use super::View;

/// The shape that soft edges are as wide as.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightOutline {
    /// A disk parallel to the image plane: soft edges of a depth are equally wide everywhere on the map. Spots and
    /// parallel light.
    Disk,
    /// A sphere, which turns the same disk to every receiver: soft edges of a depth grow towards the rim of the map,
    /// more so the more they run around its middle. Point lights. Disks would turn at the border of two faces: alpha
    /// would jump there by 0.06 on average, and by up to 0.4. Smoothies, the filters of percentage-closer soft shadows and
    /// those of moments follow it.
    Sphere,
}

/// The least share that a soft edge's width leaves of 1, as it is taken. A shader's constant too.
const LEAST_GROWTH: f64 = 1.0 / 16.0;

impl View {
    /// From a point of an edge's image to the rim of its soft edge, as a multiple of the width that a disk's would
    /// have.
    ///
    /// `place_ndc` is the point, `outward` the unit normal of the edge's image, away from the blocker. To be multiplied
    /// by the smoothie width at the edge's depth, given or from the light's size, clamped as it is for a disk. The
    /// result is not at a right angle to the edge, but the rim is a line parallel to it, sqrt(1 + d^2) away where the
    /// edge's own line passes the middle at the distance d in units of depth 1.
    ///
    /// The sphere is seen from the image plane's point p at depth 1 at a slant, as the ellipse with the matrix I + p
    /// p^T; (g + (p . g) p) / sqrt(1 + (p . g)^2) is where that has the normal g. Exact for small spheres.
    pub fn rim_offset(&self, place_ndc: DVec2, outward: DVec2) -> DVec2 {
        let place = self.leaning(place_ndc);
        let along = place.dot(outward);
        (outward + along * place) / along.hypot(1.0)
    }

    /// How far a point around a corner is, as a multiple of the width that a disk's soft edge would have: 1 on the rim.
    /// `offset_ndc` leads there from the corner at `place_ndc`. A corner's wedge reaches from the
    /// [`rim_offset`](Self::rim_offset) of the one edge to that of the other, and alpha is this over the width.
    pub fn rim_distance(&self, place_ndc: DVec2, offset_ndc: DVec2) -> f64 {
        let place = self.leaning(place_ndc);
        let along = place.dot(offset_ndc);
        // The matrix's inverse, I - p p^T / (1 + p^2).
        (offset_ndc.length_squared() - along * along / (1.0 + place.length_squared())).max(0.0).sqrt()
    }

    /// A bound of how wide soft edges are that reach into the map, where a disk's are `width_ndc` wide. Those of a sphere
    /// that is nearly as large as the blocker's depth could come from anywhere, and are cut off: from 15/16 of it on.
    pub(super) fn widest_ndc(&self, width_ndc: f64) -> f64 {
        // A line whose soft edge of width w meets the map passes the middle within sqrt(2) + w, so that
        // w <= width (1 + side (sqrt(2) + w)).
        let side = self.sphere_half_side();
        width_ndc * (1.0 + SQRT_2 * side) / (1.0 - width_ndc * side).max(LEAST_GROWTH)
    }

    /// A place on the image plane at depth 1, and the middle for a disk, which looks alike from everywhere.
    fn leaning(&self, place_ndc: DVec2) -> DVec2 {
        place_ndc * self.sphere_half_side()
    }

    /// Half the side of the image plane at depth 1 for a sphere, 0 for a disk.
    pub(super) fn sphere_half_side(&self) -> f64 {
        match self.light_outline {
            LightOutline::Disk => 0.0,
            LightOutline::Sphere => self.half_side,
        }
    }
}

#[cfg(test)]
mod tests;
