//! From a light to the square cameras that it looks through.

use glam::dcamera::rh::proj::directx::{orthographic, perspective};
use glam::dcamera::rh::view::look_to_mat4;
use glam::{DMat4, DVec3, DVec4};

use super::LightOutline;
use super::cube_views::cube_views;
use super::power_of_two::exponent_of;
use crate::{Light, LightError, LightKind};

/// Directions whose y is more than this look up or down: the image plane's up is then an axis other than y.
const STEEP: f64 = 0.99;

/// How a view brings the world to its image plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Projection {
    /// Through a point: `q(z) = -1 / z`.
    Perspective,
    /// Along parallels: `q(z) = z`.
    Orthographic,
}

/// What becomes of casters between the light and a view's nearest depth.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CastersInFront {
    /// They cast nothing. So are those of spots, point lights and a single map of parallel light.
    Clipped,
    /// They cast. Only cascades, which are orthographic, do so.
    ///
    /// Where a clip z below 0 would be clipped, it becomes 0, fragment by fragment: an image that is pressed flat. Linear
    /// depth stays what it is, less than the nearest depth and maybe negative: shadow map and quads are made from it, and
    /// neither is clipped at or moved to the nearest depth. What is more than 65504 times the farthest depth in front is
    /// taken to be there. Moments and hardware depth have no more than the nearest depth: percentage-closer soft
    /// shadows and variance shadow maps take a penumbra from in front for that of a caster there.
    Pancaked,
}

/// A square camera that a light looks through.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// Perspective or orthographic.
    pub projection: Projection,
    /// Light clip space from world space. In a perspective view clip w is the linear depth; in an orthographic one
    /// w is 1 and clip z is `(depth - near) / (far - near)`.
    pub light_clip_from_world: DMat4,
    /// The homogeneous light in world space: position and 1, or the direction towards the light and 0. It is as long as
    /// given, but for lengths beyond 2^-500..2^500, which are brought near 1 by a power of two.
    pub light_world: DVec4,
    /// Unit direction of the axis in world space, away from the light.
    pub axis_world: DVec3,
    /// Nearest depth, world units. More than 0 in a perspective view, 0 in an orthographic one, 0 or less in a cascade,
    /// where depths below 0 are those of casters alone.
    pub near_depth: f64,
    /// Farthest depth, world units.
    pub far_depth: f64,
    /// Half the side of the image plane in world units: at depth 1 (perspective) or at any depth (orthographic).
    pub half_side: f64,
    /// Size of the light on the image plane, NDC per unit of q: the half penumbra of a blocker at depth b on a
    /// receiver at depth r is `light_size * (q(r) - q(b))`.
    pub light_size: f64,
    /// What the light looks like: whether soft edges are equally wide all over the map.
    pub light_outline: LightOutline,
    /// What becomes of casters that are nearer than `near_depth`.
    pub casters_in_front: CastersInFront,
}

/// The views of a light: one for a spot and for a directional light, six for a point light, in the order of
/// [`CubeFace::ALL`](crate::CubeFace::ALL). Those end where their neighbours begin: look-ups at their borders need
/// [`views_with_guard`].
///
/// # Errors
///
/// The light has a field that is out of its range, or is cascaded: then see [`cascade_views`](crate::cascade_views).
pub fn views(light: &Light) -> Result<Vec<View>, LightError> {
    views_with_guard(light, 0.0)
}

/// The views of a light, where a point light's are widened so that a band of `guard_ndc` along each side of the map
/// shows what its neighbours show. Unit: NDC of the widened view. Range: 0 and up, less than 1;
/// [`guard_ndc`](crate::guard_ndc()) is what shadow settings ask for. Lights of a single view have no neighbours and
/// stay as they are.
///
/// The square of a face is then `1 - guard_ndc` of its map, and its nearest depth as much of the light's `near`.
///
/// # Errors
///
/// As [`views`] has, or the guard leaves nothing of a map.
pub fn views_with_guard(light: &Light, guard_ndc: f64) -> Result<Vec<View>, LightError> {
    light.validate()?;
    let view = match light.kind {
        LightKind::Point { position, radius, near, far } => {
            return cube_views(position, radius, [near, far], guard_ndc);
        }
        LightKind::Cascaded { .. } => return Err(LightError::NeedsEye),
        LightKind::Spot { position, target, cone_angle, radius, near, far } => {
            let axis_world = unit(target - position);
            let half_side = (cone_angle / 2.0).tan();
            View {
                projection: Projection::Perspective,
                light_clip_from_world: perspective(cone_angle, 1.0, near, far) * look_along(position, axis_world),
                light_world: position.extend(1.0),
                axis_world,
                near_depth: near,
                far_depth: far,
                half_side,
                light_size: radius / half_side,
                light_outline: LightOutline::Disk,
                casters_in_front: CastersInFront::Clipped,
            }
        }
        LightKind::Directional { towards_light, center, half_extent, half_depth, angular_radius } => {
            let axis_world = -unit(towards_light);
            let far_depth = 2.0 * half_depth;
            let light_clip_from_light =
                orthographic(-half_extent, half_extent, -half_extent, half_extent, 0.0, far_depth);
            View {
                projection: Projection::Orthographic,
                light_clip_from_world: light_clip_from_light * look_along(center - axis_world * half_depth, axis_world),
                light_world: without_extremes(towards_light).extend(0.0),
                axis_world,
                near_depth: 0.0,
                far_depth,
                half_side: half_extent,
                light_size: angular_radius.tan() / half_extent,
                light_outline: LightOutline::Disk,
                casters_in_front: CastersInFront::Clipped,
            }
        }
    };
    Ok(vec![view])
}

impl View {
    /// What is linear on the image plane for a linear depth.
    pub fn q_of_depth(&self, depth: f64) -> f64 {
        match self.projection {
            Projection::Perspective => -1.0 / depth,
            Projection::Orthographic => depth,
        }
    }

    /// The largest q that a receiver can have: 0 in a perspective view, the farthest depth in an orthographic one.
    pub fn q_max(&self) -> f64 {
        match self.projection {
            Projection::Perspective => 0.0,
            Projection::Orthographic => self.far_depth,
        }
    }

    /// NDC z is `q * ndc_scale + ndc_offset`.
    pub fn ndc_scale(&self) -> f64 {
        let range = self.far_depth - self.near_depth;
        match self.projection {
            Projection::Perspective => self.far_depth * (self.near_depth / range),
            Projection::Orthographic => 1.0 / range,
        }
    }

    /// See [`ndc_scale`](Self::ndc_scale).
    pub fn ndc_offset(&self) -> f64 {
        let range = self.far_depth - self.near_depth;
        match self.projection {
            Projection::Perspective => self.far_depth / range,
            Projection::Orthographic => -self.near_depth / range,
        }
    }

    /// World size of a texel at depth 1 (perspective) or at any depth (orthographic).
    pub fn texel_world(&self, map_size: u32) -> f64 {
        2.0 * self.half_side / f64::from(map_size)
    }

    /// Unit vector, or position, of the light with its 1 or 0.
    pub(crate) fn unit_light_world(&self) -> DVec4 {
        match self.projection {
            Projection::Perspective => self.light_world,
            Projection::Orthographic => (-self.axis_world).extend(0.0),
        }
    }
}

/// Unit vector of any vector but zero; the largest component goes first, so that squares neither overflow nor vanish.
pub(super) fn unit(direction: DVec3) -> DVec3 {
    (direction / direction.abs().max_element()).normalize()
}

/// A direction that 64-bit floats can multiply by any matrix that casts.
fn without_extremes(direction: DVec3) -> DVec3 {
    let exponent = exponent_of(direction.abs().max_element());
    if exponent.abs() < 500 {
        return direction;
    }
    // Below the normal numbers twice, since the power itself must be one.
    let scaled = direction * 2.0_f64.powi(-exponent.clamp(-1022, 1022));
    scaled * 2.0_f64.powi(-exponent_of(scaled.abs().max_element()))
}

/// Light space from world space: looks from `eye` along the unit vector `axis`.
pub(super) fn look_along(eye: DVec3, axis: DVec3) -> DMat4 {
    let up = if axis.y.abs() > STEEP { DVec3::Z } else { DVec3::Y };
    look_to_mat4(eye, axis, up)
}

#[cfg(test)]
mod tests;
