//! Orthographic views that move by whole texels.

use glam::{DMat4, DVec3, DVec4};

use super::LightOutline;
use super::cascade_slices::Sphere;
use super::view::{CastersInFront, Projection, View, look_along, unit};

/// Parallel light and the map that it falls on.
#[derive(Clone, Copy, Debug)]
pub(super) struct SnappedMap {
    pub towards_light: DVec3,
    pub angular_radius: f64,
    /// Texels along a side, at least 4.
    pub map_size: u32,
    /// Width of the band around the sphere, NDC, 0 to 0.5.
    pub guard_ndc: f64,
    /// How far in front of the map's cube casters have their place in the depth range, world units.
    pub caster_margin: f64,
}

impl SnappedMap {
    /// The view of a cube around a sphere, whose middle lies on a grid of whole texels in light space: where the sphere
    /// moves, the view moves by whole texels along x and y and by as much in depth, and all else stays the same to the
    /// bit. So the same points of the world fall on the same points of texels, and nothing flickers.
    ///
    /// Depth is 0 at the cube's side towards the light.
    pub fn view(&self, sphere: &Sphere) -> View {
        let axis_world = -unit(self.towards_light);
        let light_from_world = look_along(DVec3::ZERO, axis_world);
        let texels = f64::from(self.map_size);
        // The grid moves the middle by half a texel at most.
        let half_side = sphere.radius / (1.0 - self.guard_ndc - 1.0 / texels);
        let texel = 2.0 * half_side / texels;
        let middle = (light_from_world.transform_vector3(sphere.center_world) / texel).round();
        let margin_texels = (self.caster_margin / texel).ceil();
        let range_texels = texels + margin_texels;

        // Offsets are ratios of whole numbers, each rounded once.
        let row = |axis: usize, scale: f64, offset: f64| (scale * light_from_world.row(axis)).with_w(offset);
        let clip_z_offset = (middle.z + 0.5 * texels + margin_texels) / range_texels;
        let rows = DMat4::from_cols(
            row(0, half_side.recip(), -2.0 * middle.x / texels),
            row(1, half_side.recip(), -2.0 * middle.y / texels),
            row(2, -(range_texels * texel).recip(), clip_z_offset),
            DVec4::W,
        );
        View {
            projection: Projection::Orthographic,
            light_clip_from_world: rows.transpose(),
            light_world: self.towards_light.extend(0.0),
            axis_world,
            near_depth: -margin_texels * texel,
            far_depth: 2.0 * half_side,
            half_side,
            light_size: self.angular_radius.tan() / half_side,
            light_outline: LightOutline::Disk,
            casters_in_front: CastersInFront::Pancaked,
        }
    }
}

#[cfg(test)]
mod tests;
